//! The robot box: lamp, name, Start, the gap where Stop stands, and one line about what runs.

use super::hold::{Hold, hold};
use super::recordings::{RecordRow, Recordings};
use super::robots::RobotPicker;
use super::running::Running;
use crate::desk::LinkState;
use crate::icons::Icon;
use crate::words;
use leptos::prelude::*;
use protocol::{RunPhase, RunState};
use robot::Health;

/// The robot box.
#[component]
pub(crate) fn RobotBox() -> impl IntoView {
    view! {
        <section class="robot" aria-label=words::robot()>
            <Head />
            <div class="start-row"><Start /></div>
            <Line />
            <Running />
            <RecordRow />
            <Recordings />
        </section>
    }
}

#[component]
fn Head() -> impl IntoView {
    let desk = hold();
    let health = move || desk.desk().health();
    let title = move || lamp_words(&health()).1;
    view! {
        <div class="robot-head">
            <span class="lamp" role="img" data-health=move || lamp_words(&health()).0 title=title aria-label=title></span>
            <h2>{words::robot()}</h2>
            <RobotPicker />
        </div>
    }
}

/// The look of the lamp, and what it says.
pub(super) fn lamp_words(health: &Health) -> (&'static str, String) {
    match health {
        Health::Connecting => ("connecting", words::health_connecting().to_owned()),
        Health::Ready => ("ready", words::robot_ready().to_owned()),
        Health::Degraded(why) => ("limited", format!("{}: {why}", words::health_limited())),
        Health::Lost(why) => ("lost", format!("{}: {why}", words::health_lost())),
        Health::Safe => ("safe", words::robot_safe().to_owned()),
    }
}

#[component]
fn Start() -> impl IntoView {
    let desk = hold();
    let runs = Memo::new(move |_| desk.desk().running().is_some());
    let blocked = Memo::new(move |_| !runs.get() && why_not(desk).is_some());
    let press = move |_| match desk.desk().running() {
        None => desk.desk().start(),
        Some(run) if untrack(|| desk.desk().runs_older(&run)) => desk.desk().apply(),
        Some(_) => {}
    };
    view! {
        <button
            class="start"
            type="button"
            aria-pressed=move || runs.get().to_string()
            aria-describedby="robot-line"
            disabled=move || blocked.get()
            on:click=press
        >
            <Icon name="play" />
            <span>{move || if runs.get() { words::running() } else { words::start() }}</span>
        </button>
    }
}

/// Why Start has to wait. Reactive.
fn why_not(desk: Hold) -> Option<String> {
    let desk = desk.desk();
    if desk.open.read().is_none() {
        return Some(words::open_first().to_owned());
    }
    if desk.online.get() != LinkState::Online {
        return Some(words::starts_when_online().to_owned());
    }
    if let Health::Lost(why) = &desk.health() {
        return Some(words::robot_lost(why.trim_end_matches('.')));
    }
    let problems = desk.problems.get();
    problems.iter().find(|problem| problem.blocks).map(|problem| words::cannot_start(&problem.to_string()))
}

#[component]
fn Line() -> impl IntoView {
    let desk = hold();
    let run = Memo::new(move |_| desk.desk().running());
    let running = Memo::new(move |_| run.read().as_ref().map(|run| run.revision));
    let older = Memo::new(move |_| run.get().filter(|run| desk.desk().runs_older(run)).map(|run| run.revision));
    let blocked = Memo::new(move |_| why_not(desk));
    let text = move || match (running.get(), older.get()) {
        (Some(_), Some(runs)) => words::running_older(runs, desk.desk().revision.get()),
        (Some(revision), None) => words::running_here(revision),
        (None, _) => blocked.get().or_else(|| last_words(desk)).unwrap_or_default(),
    };
    let can_apply = move || older.get().is_some() && blocked.get().is_none();
    let bad = move || running.get().is_none() && faulted(desk).is_some();
    view! {
        <p class="robot-line" class:bad=bad id="robot-line" role="status" hidden=move || text().is_empty()>
            {text}
            <Show when=can_apply>
                " · "
                <button class="link" type="button" on:click=move |_| desk.desk().apply()>{words::apply()}</button>
            </Show>
        </p>
    }
}

/// How the last run of this program ended, or what else runs. Reactive.
fn last_words(desk: Hold) -> Option<String> {
    if let Some(why) = faulted(desk) {
        return Some(words::ended(&why));
    }
    let runs = desk.desk().runs_here();
    let other = runs.into_iter().rfind(|run| run.phase == RunPhase::Running);
    other.map(|run| words::other_runs(&run.name))
}

fn faulted(desk: Hold) -> Option<String> {
    let desk = desk.desk();
    let open = desk.open.get()?;
    let last: RunState = desk.runs_here().into_iter().rfind(|run| run.behaviour == open)?;
    if let RunPhase::Faulted(why) = last.phase { Some(why.trim_end_matches('.').to_owned()) } else { None }
}
