//! The robot box: lamp, name, Start, the gap where Stop stands, and one line about what runs.

use super::buttons::Buttons;
use super::condition::Lights;
use super::recordings::{RecordRow, Recordings};
use super::to_stop::tab_to_stop;
use crate::desk::{Dialog, LinkState};
use crate::icons::Icon;
use crate::later::Later;
use crate::parts::{DeskHold, hold};
use crate::robots::picker::{RobotPicker, lamp_words};
use crate::robots::words;
use behaviour::{Id, StreamKind};
use leptos::prelude::*;
use protocol::{Role, RunPhase, RunState, STOP_BUTTON};
use robot::Health;

/// The robot box.
#[component]
pub(crate) fn RobotBox() -> impl IntoView {
    view! {
        <section class="robot" aria-label=words::robot()>
            <Head />
            <div class="start-row"><Start /></div>
            <Line />
            <Asked />
            <Lights />
            <Buttons />
            <Together />
            <RecordRow />
            <Recordings />
        </section>
    }
}

/// All programs that run, once one that is not open does.
#[component]
fn Together() -> impl IntoView {
    let desk = hold();
    let others = Memo::new(move |_| {
        let open = desk.desk().document.open.get();
        desk.desk().robots.all_running().iter().any(|run| Some(&run.behaviour) != open.as_ref())
    });
    move || others.get().then(|| view! { <Later show=|rest| (rest.running)() /> })
}

#[component]
fn Head() -> impl IntoView {
    let desk = hold();
    let title = move || lamp_now(desk).1;
    view! {
        <div class="robot-head">
            <span class="lamp" role="img" data-health=move || lamp_now(desk).0 title=title aria-label=title></span>
            <h2>{words::robot()}</h2>
            <Fails />
            <RobotPicker />
        </div>
    }
}

/// That something fails, as the way to what and why; said once when it begins.
#[component]
fn Fails() -> impl IntoView {
    let desk = hold();
    let count =
        Memo::new(move |_| if desk.desk().unheard.read().is_some() { 0 } else { desk.desk().robots.fails_now() });
    let newest = Memo::new(move |_| {
        let newest = desk.desk().robots.failing.read().first().map(|failing| failing.connector.clone());
        newest.filter(|_| count.get() > 0)
    });
    // Read, not only tracked: what nobody reads is never computed, and so never changes. The counts go on unsaid.
    let said = move || {
        newest.get()?;
        let newest = desk.desk().robots.failing.with_untracked(|failing| failing.first().cloned())?;
        Some(words::begins_to_fail(&newest.name, &newest.why))
    };
    view! {
        <Show when=move || { count.get() > 0 }>
            <button class="link fails" type="button" on:click=move |_| desk.desk().dialog.set(Some(Dialog::Problems))>
                {move || words::parts_fail(count.get())}
            </button>
        </Show>
        <span class="sr" role="status">{said}</span>
    }
}

/// What is true of the lamp now: a silent server says nothing about the robot. Reactive.
fn lamp_now(desk: DeskHold) -> (&'static str, String) {
    let desk = desk.desk();
    if let Some(seconds) = desk.unheard.get() {
        return ("unheard", words::last_heard(seconds));
    }
    let health = desk.robots.health();
    match (&health, desk.robots.fails_now()) {
        (Health::Ready | Health::Degraded(_), fails @ 1..) => ("fails", words::parts_fail(fails)),
        _ => lamp_words(&health),
    }
}

/// Which robot is meant, while another one answers.
#[component]
fn Asked() -> impl IntoView {
    let desk = hold();
    let strange = Memo::new(move |_| {
        desk.desk().unheard.read().is_none() && matches!(desk.desk().robots.health(), Health::Stranger(_))
    });
    view! {
        <Show when=move || strange.get()>
            <Later show=|rest| (rest.stranger)() />
        </Show>
    }
}

#[component]
fn Start() -> impl IntoView {
    let desk = hold();
    let runs = Memo::new(move |_| desk.desk().robots.running().is_some());
    let unheard = Memo::new(move |_| desk.desk().unheard.read().is_some());
    let blocked = Memo::new(move |_| unheard.get() || (!runs.get() && why_not(desk).is_some()));
    let paused = Memo::new(move |_| matches!(last_phase(desk), Some(RunPhase::Paused(_))));
    let word = move || match (runs.get(), unheard.get()) {
        (true, true) => words::was_running(),
        (true, false) => words::running(),
        (false, _) if paused.get() => words::go_on(),
        (false, _) if desk.desk().is_then() => words::start_now(),
        (false, _) => words::start(),
    };
    let press = move |_| match desk.desk().robots.running() {
        None => desk.desk().robots.start(),
        Some(run) if untrack(|| desk.desk().robots.runs_older(&run)) => desk.desk().robots.apply(),
        Some(_) => {}
    };
    let button = NodeRef::new();
    tab_to_stop(button);
    view! {
        <button
            class="start"
            node_ref=button
            type="button"
            aria-pressed=move || (runs.get() && !unheard.get()).to_string()
            aria-describedby="robot-line"
            disabled=move || blocked.get()
            on:click=press
        >
            <Show when=move || !(runs.get() && unheard.get())><Icon name="play" /></Show>
            <span>{word}</span>
        </button>
    }
}

/// Why Start has to wait. Reactive.
fn why_not(desk: DeskHold) -> Option<String> {
    let desk = desk.desk();
    if let Some(why) = desk.may_not(Role::Operator) {
        return Some(why.to_owned());
    }
    if desk.document.open.read().is_none() {
        return Some(words::open_first().to_owned());
    }
    if desk.online.get() != LinkState::Online {
        return Some(words::starts_when_online().to_owned());
    }
    if let Health::Lost(why) = &desk.robots.health() {
        return Some(words::robot_lost(why));
    }
    if let Health::Stranger(_) = &desk.robots.health() {
        return Some(words::say_which_first().to_owned());
    }
    if let Some(other) = desk.robots.chosen.read().as_ref().and_then(|robot| robot.same_as.as_ref()) {
        return Some(words::same_as(other));
    }
    if desk.document.stream_ids.read().is_empty() {
        return Some(words::nothing_to_run().to_owned());
    }
    let problems = desk.document.problems.get();
    problems.iter().find(|problem| problem.blocks).map(words::cannot_start)
}

#[component]
fn Line() -> impl IntoView {
    let desk = hold();
    let run = Memo::new(move |_| desk.desk().robots.running());
    let running = Memo::new(move |_| run.read().as_ref().map(|run| run.revision));
    let older = Memo::new(move |_| run.get().filter(|run| desk.desk().robots.runs_older(run)).map(|run| run.revision));
    let blocked = Memo::new(move |_| why_not(desk));
    let text = move || match (running.get(), older.get()) {
        (Some(_), Some(runs)) => words::running_older(runs, desk.desk().document.revision.get()),
        (Some(_), None) => words::runs_this().to_owned(),
        (None, _) => blocked.get().or_else(|| last_words(desk)).unwrap_or_else(|| starts(desk)),
    };
    let revoked = Memo::new(move |_| run.get().filter(|run| run.revoked).map(|run| (run.behaviour, run.by)));
    let unheard = move || desk.desk().unheard.get();
    let heard = Memo::new(move |_| unheard().is_none());
    let may_move = move || if running.get().is_some() { words::may_still_move().to_owned() } else { text() };
    let can_apply = move || older.get().is_some() && blocked.get().is_none() && heard.get();
    let bad = move || {
        heard.get()
            && running.get().is_none()
            && last_phase(desk).is_some_and(|phase| !matches!(phase, RunPhase::Stopped(_)))
    };
    // Only a robot that is lost, or that stops by itself, interrupts what is being said.
    let urgent = move || bad() || matches!(desk.desk().robots.health(), Health::Lost(_) | Health::Stranger(_));
    let live = move || if urgent() { "assertive" } else { "polite" };
    // The seconds are seen and not said: nobody wants to hear them count.
    view! {
        <p class="robot-line" class:bad=bad id="robot-line" role="status" aria-live=live>
            <b aria-hidden="true">{move || unheard().map(words::last_heard)}</b>
            " "
            {move || if heard.get() { text() } else { may_move() }}
            {move || revoked.get().map(revoked_starter)}
            <Show when=can_apply>
                <Later show=|rest| (rest.apply)() />
            </Show>
        </p>
    }
}

/// That who pressed Start may not be here any more, and what ends what they began.
fn revoked_starter((behaviour, by): (Id, String)) -> impl IntoView {
    let desk = hold();
    let stop = move |_| desk.desk().robots.stop_one(&behaviour);
    view! {
        " · "
        {words::started_by_revoked(&by)}
        " "
        <button class="link" type="button" on:click=stop>{words::stop_it()}</button>
    }
}

/// What Start runs, and on which robot. Reactive.
fn starts(desk: DeskHold) -> String {
    let document = &desk.desk().document;
    let acts = |id: &Id| document.stream(id).is_some_and(|stream| stream.record.read().kind == StreamKind::Actuator);
    if !document.stream_ids.read().iter().any(acts) {
        return words::only_watches().to_owned();
    }
    words::starts_on(&desk.desk().robots.name(), desk.desk().document.revision.get())
}

/// How the last run of this program ended, or what else runs. Reactive.
fn last_words(desk: DeskHold) -> Option<String> {
    match last_phase(desk) {
        Some(RunPhase::Paused(why)) => return Some(words::paused(&why)),
        Some(RunPhase::Faulted(why)) => return Some(words::ended(&why)),
        Some(RunPhase::Stopped(by)) if is_somebody_else(desk, &by) => return Some(words::stopped_by(&by)),
        Some(RunPhase::Running | RunPhase::Stopped(_)) | None => {}
    }
    let runs = desk.desk().robots.runs_here();
    let other = runs.into_iter().rfind(|run| run.phase == RunPhase::Running);
    other.map(|run| words::other_runs(&run.name))
}

/// Whether somebody who said who they are, and is not oneself, pressed Stop. Reactive.
fn is_somebody_else(desk: DeskHold, by: &str) -> bool {
    by != STOP_BUTTON && desk.desk().me.with(|me| me.as_ref().is_none_or(|me| me.name != by))
}

/// How the last run of this program is, or ended. Reactive.
fn last_phase(desk: DeskHold) -> Option<RunPhase> {
    let desk = desk.desk();
    let open = desk.document.open.get()?;
    let last: RunState = desk.robots.runs_here().into_iter().rfind(|run| run.behaviour == open)?;
    Some(last.phase)
}
