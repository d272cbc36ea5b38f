//! Start, which asks once for the participant's code and what is kept, and the place of Stop. What is asked stands beside the
//! button and never at its place, so that a double tap starts nothing.

use super::OperateShared;
use super::marking::MarkButton;
use crate::browser::{self, Drawer};
use crate::desk::LinkState;
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::link::NoAnswer;
use crate::operate::words;
use crate::robots::tab_to_stop;
use leptos::prelude::*;
use protocol::{CODE_MAX_CHARS, RecordedSession, Records, Role, RunPhase, request};
use robot::Health;
use web_sys::SubmitEvent;

/// The key of the last codes in this browser, parted by blanks, newest first.
const CODES: &str = "rrp.codes";
const CODES_MAX: usize = 3;
/// Start rests for so long after its answer, in milliseconds: by then the run is told.
const SETTLE_MS: i32 = 1_000;
/// The key that says that only marks and actions were wanted last.
const MARKS_ONLY: &str = "rrp.marks-only";

/// Marking on a phone, Start, and the gap where Stop stands.
#[component]
pub(super) fn Foot(op: OperateShared) -> impl IntoView {
    let quiet = Memo::new(move |_| op.is_quiet());
    let runs = Memo::new(move |_| op.run().is_some());
    let paused = Memo::new(move |_| op.is_paused());
    let blocked = Memo::new(move |_| runs.get() || op.starts.get() || op.why_not_start().is_some());
    let word = move || match (runs.get(), quiet.get()) {
        (true, true) => words::was_running(),
        (true, false) => words::running(),
        (false, _) if paused.get() => words::go_on(),
        (false, _) => words::start_asks(),
    };
    let press = move |_| {
        // A run that goes on is recorded on, with the code and the choice of its Start.
        match untrack(|| op.last()).filter(|run| matches!(run.phase, RunPhase::Paused(_))) {
            Some(run) => {
                let record = run.recording.is_some();
                let participant = run.recording.and_then(|recorded| recorded.participant);
                op.start(RecordedSession { participant, session: None, records: records_chosen() }, record);
            }
            None => op.asks.update(|asks| *asks = !*asks),
        }
    };
    let button = NodeRef::new();
    tab_to_stop(button);
    view! {
        <div class="op-foot right">
            <MarkButton op class="op-foot-mark" word=String::new()><Icon name="flag" />{words::mark()}</MarkButton>
            <button class="start op-start" node_ref=button type="button" aria-pressed=move || (runs.get() && !quiet.get()).to_string()
                aria-expanded=move || (!runs.get() && !paused.get()).then(|| op.asks.get().to_string())
                disabled=move || blocked.get() on:click=press>
                <Show when=move || !(runs.get() && quiet.get())><Icon name="play" /></Show>
                <span>{word}</span>
            </button>
            <div class="op-stop-gap" aria-hidden="true"></div>
        </div>
    }
}

/// The questions before Start.
#[component]
pub(super) fn Card(op: OperateShared) -> impl IntoView {
    let shown = Memo::new(move |_| op.asks.get() && op.run().is_none() && op.why_not_start().is_none());
    Effect::new(move |_| {
        if op.run().is_some() {
            op.asks.set(false);
        }
    });
    Effect::new(move |before: Option<bool>| {
        let shown = shown.get();
        if shown {
            focus::place(FocusPlace::ParticipantCode);
        } else if before == Some(true) {
            op.uncovered.set(browser::today_ms());
        }
        shown
    });
    view! { <Show when=move || shown.get()><Asked op /></Show> }
}

#[component]
fn Asked(op: OperateShared) -> impl IntoView {
    let codes = codes();
    let code = RwSignal::new(codes.first().cloned().unwrap_or_default());
    let kept = RwSignal::new(records_chosen());
    let wrong = Memo::new(move |_| !is_code(&code.read()));
    let name = move || words::start_this(&op.desk.desk().document.name.get());
    let send = move |event: SubmitEvent| {
        event.prevent_default();
        if wrong.get_untracked() {
            return;
        }
        let (code, records) = (code.get_untracked(), kept.get_untracked());
        keep(&code, records);
        let participant = Some(code).filter(|code| !code.is_empty());
        op.asks.set(false);
        op.start(RecordedSession { participant, session: None, records }, true);
    };
    let chip = move |text: String| {
        let (value, same) = (text.clone(), text.clone());
        let label = if text.is_empty() { words::no_code().to_owned() } else { text };
        view! {
            <button class="button op-code" type="button" aria-pressed=move || (*code.read() == same).to_string()
                on:click=move |_| code.set(value.clone())>{label}</button>
        }
    };
    let chips: Vec<String> = codes.into_iter().chain([String::new()]).collect();
    view! {
        <div class="op-veil" aria-hidden="true"></div>
        <section class="op-card" role="dialog" aria-labelledby="op-card-title" on:keydown=move |event| { escape::ends(&event, || op.asks.set(false)); }>
            <form on:submit=send>
                <div class="op-card-head">
                    <h2 id="op-card-title">{name}</h2>
                    <button class="tool icon" type="button" aria-label=words::close() title=words::close() on:click=move |_| op.asks.set(false)>
                        <Icon name="close" />
                    </button>
                </div>
                <div class="op-card-body">
                    <label class="op-code-label" for="op-code">{words::participant_code()}<small>{words::code_not_name()}</small></label>
                    <input id="op-code" class="input" type="text" autocomplete="off" autocapitalize="characters" spellcheck="false"
                        maxlength=CODE_MAX_CHARS.to_string() aria-invalid=move || wrong.get().to_string()
                        prop:value=move || code.get() on:input:target=move |event| code.set(event.target().value().trim().to_owned()) />
                    <div class="op-codes">{chips.into_iter().map(chip).collect_view()}</div>
                    <p class="op-why" role="status">{move || wrong.get().then(words::code_has_signs)}</p>
                    <Kept kept />
                    <p class="op-once">{words::asked_once()}</p>
                </div>
                <div class="op-card-feet">
                    <button class="button" type="button" on:click=move |_| op.asks.set(false)>{words::do_not_start()}</button>
                    <button class="start op-go" type="submit" disabled=move || wrong.get()><Icon name="play" />{words::start()}</button>
                </div>
            </form>
        </section>
    }
}

/// The parts of a run that are kept.
#[component]
pub(super) fn Kept(kept: RwSignal<Records>) -> impl IntoView {
    let one = move |records: Records, label: &'static str, says: &'static str| {
        view! {
            <label class="op-choice">
                <input type="radio" name="op-kept" prop:checked=move || kept.get() == records on:change=move |_| kept.set(records) />
                <span><b>{label}</b><small>{says}</small></span>
            </label>
        }
    };
    view! {
        <fieldset class="op-kept">
            <legend>{words::what_is_kept()}</legend>
            {one(Records::All, words::record_readings(), words::record_readings_says())}
            {one(Records::Marks, words::marks_only(), words::marks_only_says())}
        </fieldset>
    }
}

/// Letters, digits and three signs, as the server takes them. Pure.
fn is_code(code: &str) -> bool {
    code.chars().all(|sign| sign.is_ascii_alphanumeric() || "-_.".contains(sign))
}

/// The parts of a run that were chosen last in this browser.
fn records_chosen() -> Records {
    if Drawer::Browser.get(MARKS_ONLY).is_some() { Records::Marks } else { Records::All }
}

/// The codes of the last runs here.
fn codes() -> Vec<String> {
    let kept = Drawer::Browser.get(CODES).unwrap_or_default();
    kept.split(' ').filter(|code| !code.is_empty() && is_code(code)).take(CODES_MAX).map(str::to_owned).collect()
}

fn keep(code: &str, records: Records) {
    if !code.is_empty() {
        let mut all = codes();
        all.retain(|known| known != code);
        all.insert(0, code.to_owned());
        all.truncate(CODES_MAX);
        Drawer::Browser.put(CODES, &all.join(" "));
    }
    if records == Records::Marks { Drawer::Browser.put(MARKS_ONLY, "1") } else { Drawer::Browser.drop(MARKS_ONLY) }
}

impl OperateShared {
    /// Starts the open program, or lets it go on. Never later than now: without a link nothing is asked.
    fn start(self, session: RecordedSession, record: bool) {
        let desk = self.desk.desk();
        let (Some(behaviour), robot) = (desk.document.open.get_untracked(), desk.robots.chosen_id()) else { return };
        // A second press before the run is told would begin it anew.
        if self.starts.get_untracked() {
            return;
        }
        self.starts.set(true);
        let told = desk.clone();
        desk.look_up(request::Start { behaviour, robot, record, session }, move |answer| {
            browser::after(SETTLE_MS, move || {
                self.starts.try_set(false);
            });
            match answer {
                Ok(_) => {}
                Err(NoAnswer::Refused(no)) => told.say_no(&no),
                Err(NoAnswer::Unreachable) => told.say(words::not_known_if_done(), true),
            }
        });
    }

    /// Why Start has to wait. Reactive.
    pub(super) fn why_not_start(self) -> Option<String> {
        let desk = self.desk.desk();
        if let Some(why) = desk.may_not(Role::Operator) {
            return Some(why.to_owned());
        }
        if desk.document.open.read().is_none() {
            return Some(words::open_first().to_owned());
        }
        if desk.online.get() != LinkState::Online || desk.unheard.read().is_some() {
            return Some(words::starts_when_online().to_owned());
        }
        match desk.robots.health() {
            Health::Lost(why) => return Some(words::robot_lost(&why)),
            Health::Connecting => return Some(words::health_connecting().to_owned()),
            Health::Stranger(_) => return Some(words::say_which_first().to_owned()),
            _ => {}
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
}

#[cfg(test)]
mod tests {
    use super::is_code;

    #[test]
    fn a_code_is_no_name() {
        assert!(is_code("") && is_code("P-07") && is_code("a_1.b"));
        assert!(!is_code("Aiko Tanaka") && !is_code("愛子") && !is_code("P/07"));
    }
}
