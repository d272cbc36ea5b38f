//! The operator's page, made for a tablet at arm's length: what the robot does now in large words, nine tiles to press, marks,
//! Start, and the one Stop. Nothing is edited here.
//!
//! It is a piece of the code of its own, which fetches its sheet (`frontend/src/operate/operate.css`) itself.

mod clock;
mod edit_tiles;
mod head;
mod hearing;
mod keys;
mod lanes;
mod marking;
mod marks;
mod now;
mod pad;
mod press;
mod quiet;
mod seen;
mod starting;
mod tiles;
mod trouble;
mod verdict;
mod words;

use crate::browser;
use crate::parts::{DeskHold, hold, mark_usable};
use behaviour::Id;
pub(crate) use edit_tiles::EditTiles;
use leptos::prelude::*;
use protocol::{OPERATE_PATH, RunPhase, RunState, STOP_BUTTON};
use std::collections::VecDeque;

/// The sheet of this page.
const SHEET: &str = "/operate.css";
/// The class of the document while this page is shown.
const CLASS: &str = "operates";
/// The period after which everything that depends on the time is told anew, in milliseconds.
const TICK_MS: i32 = 250;
/// A tile takes no tap for so long after what lay over it went, in milliseconds.
const UNCOVERED_MS: f64 = 500.0;

/// The state that the parts of the page share.
#[derive(Clone, Copy)]
struct OperateShared {
    desk: DeskHold,
    /// The time since 1970 by this computer's clock, in milliseconds, renewed four times a second.
    now: RwSignal<f64>,
    /// The run whose time is known, and when it began by this computer's clock.
    began: RwSignal<Option<(u64, f64)>>,
    /// The nine tiles.
    pad: Memo<Vec<pad::PadTile>>,
    /// The outcome of the newest press of each tile.
    presses: RwSignal<Vec<press::PressedTile>>,
    /// The presses of everybody within the last two minutes.
    seen: RwSignal<VecDeque<seen::SeenPress>>,
    /// The marks of the run.
    marks: marks::SessionMarks,
    /// The long press on something that marks, and what it asks.
    verdict: verdict::VerdictAsked,
    /// True while what is asked at Start is open.
    asks: RwSignal<bool>,
    /// True from a press of Start until the run is told.
    starts: RwSignal<bool>,
    /// The moment at which what lay over the tiles went, by this computer's clock.
    uncovered: RwSignal<f64>,
    /// The run whose end somebody has read of.
    read: RwSignal<u64>,
}

/// The operator's page, as a view.
pub(crate) fn operate() -> AnyView {
    let desk = hold();
    let op = OperateShared {
        desk,
        now: RwSignal::new(browser::today_ms()),
        began: RwSignal::new(None),
        pad: pad::pad(desk),
        presses: RwSignal::default(),
        seen: RwSignal::default(),
        marks: marks::SessionMarks::new(),
        verdict: verdict::VerdictAsked::new(),
        asks: RwSignal::new(false),
        starts: RwSignal::new(false),
        uncovered: RwSignal::new(0.0),
        read: RwSignal::new(0),
    };
    // The page lives as long as the tab: these go on until it is closed.
    browser::every(TICK_MS, move || {
        op.now.try_set(browser::today_ms());
    });
    hearing::overhear(op);
    keys::listen(op);
    marks::waiting::when_back(op);
    quiet::stay_awake(op);
    look_at_asked(op);
    follow_what_runs(op);
    forget_own_stops(op);
    dress();
    mark_usable(desk);
    let dressed = RwSignal::new(false);
    view! {
        <link rel="stylesheet" href=SHEET on:load=move |_| dressed.set(true) on:error=move |_| dressed.set(true) />
        <div class="op" class:op-bare=move || !dressed.get() class:op-quiet=move || op.is_quiet()>
            <head::Head op />
            <main class="op-main" tabindex="0" aria-label=words::operate_name()>
                <now::Now op />
                <lanes::Lanes op />
                <tiles::Tiles op />
            </main>
            <aside class="op-side" aria-label=words::robot()>
                <seen::Room op />
                <marking::Marking op />
                <starting::Foot op />
            </aside>
            <starting::Card op />
            <quiet::Said op />
        </div>
    }
    .into_any()
}

/// The page's form of Stop stands elsewhere here, and says its keys.
fn dress() {
    if let Some(body) = browser::window().and_then(|window| window.document()?.body()) {
        let _ = body.class_list().add_1(CLASS);
    }
}

/// Looks at the robot that the address names.
fn look_at_asked(op: OperateShared) {
    let path = browser::window().and_then(|window| window.location().pathname().ok()).unwrap_or_default();
    let named = path.strip_prefix(OPERATE_PATH).and_then(|rest| Id::new(rest.trim_matches('/')).ok());
    let Some(named) = named else { return };
    Effect::new(move |done: Option<bool>| {
        let desk = op.desk.desk();
        let is_there = desk.robots.all.read().iter().any(|robot| robot.robot == named);
        if is_there && done != Some(true) {
            untrack(|| desk.robots.choose(&named));
        }
        is_there || done == Some(true)
    });
}

/// Opens the program that runs on the robot, where somebody comes while one does, and whenever none is open.
fn follow_what_runs(op: OperateShared) {
    Effect::new(move |came: Option<bool>| {
        let desk = op.desk.desk();
        let running = desk.robots.runs_here().into_iter().rfind(|run| run.phase == RunPhase::Running);
        let open = desk.document.open.get();
        let first = came != Some(true);
        if let Some(run) = running.filter(|run| (first || open.is_none()) && open.as_ref() != Some(&run.behaviour)) {
            untrack(|| desk.document.open_program(&run.behaviour));
        }
        came == Some(true) || desk.robots.chosen.read().is_some()
    });
    // The list to choose from is told where nothing is open, and asked for where something is.
    Effect::new(move |_| {
        if op.desk.desk().me.read().is_some() {
            untrack(|| op.desk.desk().library.list_programs());
        }
    });
}

/// Remembers what is no news: a run that ended before somebody came here, or by the Stop of this page.
fn forget_own_stops(op: OperateShared) {
    let ran = StoredValue::new(0);
    Effect::new(move |_| {
        let Some(last) = op.last() else { return };
        match last.phase {
            RunPhase::Running | RunPhase::Paused(_) => ran.set_value(last.run),
            RunPhase::Faulted(_) | RunPhase::Stopped(_) => {
                let own = last.phase == RunPhase::Stopped(STOP_BUTTON.to_owned()) && stop_was_pressed();
                if own || ran.get_value() != last.run {
                    op.read.set(last.run);
                }
            }
        }
    });
}

/// True while the page's Stop says what became of a press.
fn stop_was_pressed() -> bool {
    let form = crate::focus::by_id("stop-form").and_then(|form| form.get_attribute("data-state"));
    form.is_some_and(|state| !state.is_empty())
}

impl OperateShared {
    /// True while nothing that is known of the robot is sure: the server is silent, or its link to the robot is lost. Reactive.
    fn is_quiet(self) -> bool {
        self.desk.desk().unheard.read().is_some()
    }

    /// The run of the open program on the robot, if it runs there. Reactive.
    fn run(self) -> Option<RunState> {
        self.desk.desk().robots.running()
    }

    /// The last run of the open program on the robot, be it over or not. Reactive.
    fn last(self) -> Option<RunState> {
        let desk = self.desk.desk();
        let open = desk.document.open.get()?;
        desk.robots.runs_here().into_iter().rfind(|run| run.behaviour == open)
    }

    /// True for a moment after what lay over the tiles went: the second tap of two is for none of them. Not reactive.
    fn is_just_uncovered(self) -> bool {
        browser::today_ms() - self.uncovered.get_untracked() < UNCOVERED_MS
    }

    /// Another program that runs on the robot, while the open one does not. Reactive.
    fn other_runs(self) -> Option<String> {
        let desk = self.desk.desk();
        let open = desk.document.open.get();
        let all = desk.robots.runs_here();
        let other =
            all.into_iter().rfind(|run| run.phase == RunPhase::Running && Some(&run.behaviour) != open.as_ref());
        other.map(|run| run.name).filter(|_| self.run().is_none())
    }

    /// True if the last run goes on where it was when somebody presses *Continue*. Reactive.
    fn is_paused(self) -> bool {
        self.last().is_some_and(|run| matches!(run.phase, RunPhase::Paused(_)))
    }

    /// The person who stopped the last run, if that was somebody else and nobody has read of it here. Whoever says not who they are is
    /// [`STOP_BUTTON`]. Reactive.
    fn stopped_by_other(self) -> Option<(u64, String)> {
        let last = self.last()?;
        let RunPhase::Stopped(by) = last.phase else { return None };
        let mine = self.desk.desk().me.with(|me| me.as_ref().is_some_and(|me| me.name == by));
        (!mine && self.read.get() != last.run).then_some((last.run, by))
    }
}
