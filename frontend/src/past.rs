//! *Over time*: what a run sensed and did, as lanes over one axis of time, with a cursor that everything else follows. It looks at
//! a recording that is kept, or at the last minutes of what runs now.
//!
//! It is a piece of the code of its own, which fetches its sheet (`frontend/src/past/past.css`) itself. What is looked at is a
//! `lanes::Viewer`; here it is drawn, filled from the server, and told what hands and keys do.

mod asking;
mod clock;
mod compare;
mod compare_changes;
mod compare_counts;
mod compare_taken;
mod compare_view;
mod filling;
mod following;
mod hands;
mod head;
mod keys;
mod marks;
mod media;
mod others;
mod painting;
mod rows;
mod signs;
mod table;
mod telling;
mod then;
mod why;
mod words;

use crate::browser;
use crate::desk::{LinkState, OpenPast};
use crate::focus::{self, FocusPlace};
use crate::parts::{DeskHold, hold};
use behaviour::Id;
use lanes::{Density, LaneAct, Viewer};
use leptos::html;
use leptos::leptos_dom::helpers::IntervalHandle;
use leptos::prelude::*;
use media::{COARSE, IN_PLACE, LOW, NARROW, holds, when_changed, while_holds};
use protocol::{OpenedPast, PastOf};
use std::sync::Arc;
use wasm_bindgen::JsCast;

/// The sheet of this panel.
const SHEET: &str = "/past.css";
/// The time between two steps of playing for who wants little motion, in milliseconds.
const CALM_STEP_MS: f64 = 1_000.0;
/// The longest time that one step of playing takes up, in milliseconds: a page that was away does not jump.
const STEP_MAX_MS: f64 = 250.0;
/// The state that the parts of the panel share.
#[derive(Clone, Copy)]
struct PastShared {
    desk: DeskHold,
    /// The past that is looked at, once that is known.
    of: StoredValue<Option<PastOf>>,
    /// All that is to be seen of it, once it is open.
    opened: RwSignal<Option<Arc<OpenedPast>>>,
    /// Why it is not shown, or the last thing that was not answered.
    trouble: RwSignal<Option<String>>,
    viewer: RwSignal<Viewer>,
    /// The width of the lanes, in pixels.
    width: RwSignal<f64>,
    /// True while the values of the chosen lane are shown as a table, and not only read out.
    shows_table: RwSignal<bool>,
    /// True while the marks are listed beside the lanes.
    shows_marks: RwSignal<bool>,
    /// True while they are listed at the left, in the place of the list of senses.
    marks_left: RwSignal<bool>,
    compare: compare::CompareState,
    asked: StoredValue<asking::AskedLanes>,
    /// Looks every second at a run that goes on.
    looking: StoredValue<Option<IntervalHandle>>,
    then: then::ThenState,
    telling: telling::TellState,
    following: following::FollowState,
}

/// A question for reasons about a moment that is not on the graph yet.
#[derive(Clone)]
enum ReasonWanted {
    /// *Why?* of what is chosen.
    Why,
    /// *Why not …* of this action.
    WhyNot(Id),
}

/// The panel, as a view.
pub(crate) fn past() -> AnyView {
    let desk = hold();
    let past = PastShared {
        desk,
        of: StoredValue::new(None),
        opened: RwSignal::new(None),
        trouble: RwSignal::new(None),
        viewer: RwSignal::new(Viewer::recorded(0.0, 0.0)),
        width: RwSignal::new(0.0),
        shows_table: RwSignal::new(false),
        shows_marks: RwSignal::new(false),
        marks_left: RwSignal::new(false),
        compare: compare::CompareState::new(),
        asked: StoredValue::default(),
        looking: StoredValue::new(None),
        then: then::ThenState::new(),
        telling: telling::TellState::new(),
        following: following::FollowState::new(),
    };
    let density = RwSignal::new(density());
    let root = NodeRef::<html::Section>::new();
    let hides_graph = hides_graph(past);
    Effect::new(move |_| {
        let density = density.get();
        past.viewer.update(|viewer| viewer.set_density(density));
    });
    past.begin();
    past.play_on();
    past.fetch_what_is_seen();
    past.follow_moment();
    past.follow_subject();
    past.compare_when_changed();
    past.tell_moments();
    past.go_along();
    Effect::new(move |_| {
        if let Some(root) = root.get() {
            focus::focus(&root);
        }
    });
    for query in [NARROW, COARSE] {
        when_changed(query, move || {
            density.try_set(self::density());
        });
    }
    on_cleanup(move || {
        if let Some(looking) = past.looking.try_get_value().flatten() {
            looking.clear();
        }
    });
    let is_there = move || past.opened.read().is_some();
    view! {
        <link rel="stylesheet" href=SHEET />
        <section
            class="past"
            class:past-narrow=move || density.get() == Density::Narrow
            class:past-folded=move || past.then.is_folded.get()
            class:past-old=move || past.compare.is_old.get()
            class:past-with-table=move || past.shows_table.get()
            node_ref=root
            tabindex="-1"
            role=move || hides_graph.get().then_some("main")
            aria-label=words::over_time()
            on:keydown=move |event| keys::key(&event, past)
        >
            <head::Head past />
            <others::Others past />
            <compare_view::CompareLine past />
            <p class="past-note" role="status">{move || past.note()}</p>
            <Show when=is_there>
                <div class="past-body">
                    <marks::MarksBeside past />
                    <rows::Lanes past />
                    <compare_changes::Changes past />
                    <table::Table past />
                </div>
            </Show>
            <then::Then past />
            <marks::MarksAtLeft past />
        </section>
    }
    .into_any()
}

/// The room that lanes have in this window.
fn density() -> Density {
    match () {
        () if holds(NARROW) => Density::Narrow,
        () if holds(COARSE) => Density::Coarse,
        () => Density::Fine,
    }
}

/// Closes the panel; the keyboard goes back to the graph.
fn close(past: PastShared) {
    past.desk.desk().looks_with.set(None);
    past.desk.desk().past.set(None);
    if let Some(window) = browser::window()
        && let (Ok(history), Ok(hash)) = (window.history(), window.location().hash())
    {
        let _ = history.replace_state_with_url(&wasm_bindgen::JsValue::NULL, "", Some(&format!("/{hash}")));
    }
    FocusPlace::Graph.take();
}

impl PastShared {
    /// True once the panel is gone; then nothing of it may be touched.
    fn is_gone(self) -> bool {
        self.viewer.is_disposed()
    }

    /// Does what a hand or a key does. Whoever moves the cursor looks by themselves from then on.
    fn act(self, act: LaneAct) {
        let before = self.viewer.with_untracked(Viewer::cursor);
        self.viewer.update(|viewer| viewer.act(act));
        let moves = |viewer: &Viewer| viewer.cursor() != before || viewer.plays() || viewer.follows();
        if self.viewer.with_untracked(moves) {
            self.look_alone();
        }
    }

    /// Begins to look at what was asked for.
    fn begin(self) {
        // Whoever comes by the address is here before the server has greeted; a link that broke comes back.
        Effect::new(move |was_online: Option<bool>| {
            let is_online = self.desk.desk().online.get() == LinkState::Online;
            if is_online && self.opened.with_untracked(Option::is_none) {
                untrack(|| self.open_wanted());
            } else if is_online && was_online == Some(false) {
                untrack(|| self.ask_again());
            }
            is_online
        });
        // Another stream may be asked for while the panel is open.
        Effect::new(move |before: Option<Option<OpenPast>>| {
            let now = self.desk.desk().past.get();
            if before.is_some_and(|before| before != now) && matches!(now, Some(OpenPast::Running(_))) {
                match untrack(|| self.running()) {
                    Some(run) if self.of.get_value().as_ref() != Some(&run) => self.open(Some(run)),
                    _ => self.add_wanted(),
                }
            }
            now
        });
    }

    /// Opens what was asked for.
    fn open_wanted(self) {
        match self.desk.desk().past.get_untracked() {
            Some(OpenPast::Address) => self.open(asked_by_address().map(PastOf::Recording)),
            Some(OpenPast::Running(_)) => self.open(self.running()),
            // Going along with them opens it.
            Some(OpenPast::Theirs) | None => {}
        }
    }

    /// Returns what runs here now. Not reactive.
    fn running(self) -> Option<PastOf> {
        untrack(|| self.desk.desk().robots.running()).map(|run| PastOf::Run(run.run))
    }

    /// Why nothing is shown, or what is not as it was. Reactive.
    fn note(self) -> Option<String> {
        if let Some(trouble) = self.trouble.get() {
            return Some(trouble);
        }
        let opened = self.opened.get();
        let Some(opened) = opened else { return Some(words::past_comes().to_owned()) };
        if opened.streams.iter().all(|stream| stream.count == 0) {
            return Some(words::past_is_empty().to_owned());
        }
        if opened.cut {
            return Some(words::past_is_cut().to_owned());
        }
        let differs = opened.differs_ms.map(|ms| ms.saturating_sub(opened.from_ms) as f64);
        differs.map(|ms| words::differs_from(&clock::time(&opened, ms, false)))
    }

    /// Moves the cursor while it plays, once for each picture that the browser draws.
    fn play_on(self) {
        let plays = Memo::new(move |_| self.viewer.read().plays());
        Effect::new(move |_| {
            if plays.get() {
                step(self, browser::now_ms());
            }
        });
    }
}

/// Draws the next picture of playing, and goes on for as long as it plays.
fn step(past: PastShared, last: f64) {
    browser::next_frame(move || {
        if past.is_gone() || !past.viewer.read_untracked().plays() {
            return;
        }
        let now = browser::now_ms();
        let rests = browser::is_calm() && now - last < CALM_STEP_MS;
        if !rests {
            let longest = if browser::is_calm() { 2.0 * CALM_STEP_MS } else { STEP_MAX_MS };
            past.act(LaneAct::Pass((now - last).min(longest)));
        }
        step(past, if rests { last } else { now });
    });
}

/// The name of the recording's file that the address asks for.
fn asked_by_address() -> Option<String> {
    let search = browser::search();
    let mut parts = search.strip_prefix('?')?.split('&');
    let name = parts.find_map(|part| part.strip_prefix(crate::desk::PAST_QUERY))?;
    js_sys::decode_uri_component(name).ok()?.as_string()
}

/// The element that an event is about.
fn target(event: &web_sys::Event) -> Option<web_sys::Element> {
    event.target()?.dyn_into().ok()
}

/// True while this stands in the place of the graph. While something is compared the graph is in view too, but on a low window.
fn hides_graph(past: PastShared) -> Memo<bool> {
    let [in_place, is_low] = [IN_PLACE, LOW].map(while_holds);
    let is_beside = move || past.then.is_folded.get() || past.compare.is_on.get() && !is_low.get();
    Memo::new(move |_| in_place.get() && !is_beside())
}
