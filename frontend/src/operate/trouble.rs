//! The trouble that there is, in large words with what to do, in the place of the title. One thing at a time: the worst first.

use super::OperateShared;
use crate::desk::LinkState;
use crate::icons::Icon;
use crate::operate::words;
use leptos::prelude::*;
use phrase::Phrase;
use protocol::RunPhase;
use robot::Health;

/// So long nothing was heard until it is said large, in seconds; a shorter silence is told beside the robot.
const LOST_S: u32 = 6;
/// At this charge a robot may sit down by itself at any moment, in percent.
const EMPTY_PERCENT: u8 = 7;

/// The troubles that there can be.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Matter {
    /// The server was not heard for so many seconds.
    NoServer(u32),
    /// The server does not reach the robot; with the reason.
    NoRobot(Phrase),
    /// Another body answers at its address.
    Stranger,
    /// It lies where it fell.
    Fell,
    /// The robot interrupted the program; with the reason.
    Interrupted(Phrase),
    /// The program ended by itself; with the reason.
    Ended(Phrase),
    /// Somebody else pressed Stop; which run, and who.
    Stopped(u64, String),
    /// The charge of the battery, which is nearly empty.
    Empty(u8),
}

impl OperateShared {
    /// The worst that is the matter now. Reactive.
    pub(super) fn trouble(self) -> Option<Matter> {
        let desk = self.desk.desk();
        let unheard = desk.unheard.get();
        if let Some(seconds) = unheard.filter(|seconds| *seconds >= LOST_S || desk.online.get() == LinkState::Offline) {
            return Some(Matter::NoServer(seconds));
        }
        match desk.robots.health() {
            Health::Lost(why) => return Some(Matter::NoRobot(why)),
            Health::Stranger(_) => return Some(Matter::Stranger),
            _ => {}
        }
        let chosen = desk.robots.chosen.read();
        let condition = chosen.as_ref().map(|robot| robot.condition.clone()).unwrap_or_default();
        if condition.fallen == Some(true) {
            return Some(Matter::Fell);
        }
        match self.last().map(|run| (run.run, run.phase)) {
            Some((_, RunPhase::Paused(why))) => return Some(Matter::Interrupted(why)),
            Some((run, RunPhase::Faulted(why))) if self.read.get() != run => return Some(Matter::Ended(why)),
            _ => {}
        }
        if let Some((run, by)) = self.stopped_by_other() {
            return Some(Matter::Stopped(run, by));
        }
        let empty = condition.battery.filter(|percent| *percent <= EMPTY_PERCENT && condition.plugged != Some(true));
        empty.map(Matter::Empty)
    }

    /// Says what to do at the body of the robot that does not stop, in the words of its own kind. Reactive.
    fn by_body(self) -> String {
        let desk = self.desk.desk();
        let chosen = desk.robots.chosen.read();
        let words = chosen.as_ref().map(|robot| robot.by_body.clone()).unwrap_or_default();
        if words.is_empty() { words::take_its_power().to_owned() } else { words::shown(&words) }
    }
}

/// The words about it: its title, a sentence, and what to do, step by step.
struct TroubleWords {
    icon: &'static str,
    title: String,
    lead: String,
    steps: Vec<String>,
}

/// Reactive.
fn says(op: OperateShared, matter: &Matter) -> TroubleWords {
    let runs = op.other_runs().is_some() || op.last().is_some_and(|run| run.phase == RunPhase::Running);
    let if_it_goes_on = words::if_it_goes_on(&op.by_body());
    let moving = |otherwise: &'static str| if runs { words::goes_on_by_itself() } else { otherwise }.to_owned();
    let says = |icon, title: String, lead: String, steps: Vec<String>| TroubleWords { icon, title, lead, steps };
    match matter {
        Matter::NoServer(seconds) => says(
            "offline",
            words::no_connection_for(*seconds),
            moving(words::nothing_was_running()),
            vec![words::press_stop_own_way().to_owned(), if_it_goes_on],
        ),
        Matter::NoRobot(why) => says(
            "offline",
            words::robot_is_lost(&op.desk.desk().robots.name()),
            words::lost_because(why),
            vec![words::stop_when_it_is_back().to_owned(), if_it_goes_on, words::look_at_its_network().to_owned()],
        ),
        Matter::Stranger => says(
            "warn",
            words::another_robot_answers().to_owned(),
            words::nothing_is_done_with_it().to_owned(),
            vec![words::say_which_on_page().to_owned()],
        ),
        Matter::Fell => says(
            "fall",
            words::it_fell().to_owned(),
            words::look_for_damage().to_owned(),
            vec![words::stand_it_up().to_owned(), words::then_start(op.is_paused())],
        ),
        Matter::Interrupted(why) => says(
            "warn",
            words::it_was_interrupted().to_owned(),
            words::because(why),
            vec![words::then_start(true), words::or_stop().to_owned()],
        ),
        Matter::Ended(why) => says(
            "warn",
            words::program_ended().to_owned(),
            words::because(why),
            vec![words::start_again().to_owned(), words::tell_who_made_it().to_owned()],
        ),
        Matter::Stopped(_, by) => says(
            "stop",
            words::somebody_stopped(by),
            words::holds_still().to_owned(),
            vec![words::ask_them_why(by), words::start_again().to_owned()],
        ),
        Matter::Empty(percent) => says(
            "battery",
            words::battery_is_low(*percent),
            words::may_sit_down().to_owned(),
            vec![words::plug_it_in().to_owned()],
        ),
    }
}

/// The card.
#[component]
pub(super) fn Trouble(op: OperateShared) -> impl IntoView {
    let matter = Memo::new(move |_| op.trouble());
    // Of a silence only the seconds change, which are seen and not said.
    let kind = Memo::new(move |_| matter.get().map(|matter| std::mem::discriminant(&matter)));
    let ended = Memo::new(move |_| {
        op.last().map(|run| run.run).filter(|_| matches!(*matter.read(), Some(Matter::Stopped(..) | Matter::Ended(_))))
    });
    let card = move || {
        kind.get()?;
        let matter_now = matter.get_untracked()?;
        let TroubleWords { icon, lead, steps, .. } = untrack(|| says(op, &matter_now));
        let title = move || matter.get().map(|matter| says(op, &matter).title);
        let said = untrack(title).unwrap_or_default();
        let steps = steps.into_iter().map(|step| view! { <li>{step}</li> }).collect_view();
        Some(view! {
            <p class="sr" role="alert">{said}</p>
            <h1><Icon name=icon /><span>{title}</span></h1>
            <p>{lead}</p>
            <ol>{steps}</ol>
            <Show when=move || ended.get().is_some()>
                <button class="button" type="button" on:click=move |_| op.read.set(ended.get_untracked().unwrap_or(0))>
                    {words::i_have_read_it()}
                </button>
            </Show>
        })
    };
    view! { <section class="op-trouble" hidden=move || kind.get().is_none() aria-label=words::what_is_wrong()>{card}</section> }
}
