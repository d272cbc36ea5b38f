//! Beside the picture: touching the robot, what else may happen, a fresh start, what the robot says and what it shows.

use crate::desk::Desk;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::live::short_value;
use crate::parts::{MayNot, Menu, MenuItem, hold, may_operate};
use crate::robots::words;
use behaviour::Value;
use leptos::prelude::*;
use protocol::{Role, RunPhase};
use robot::{SceneEdit, Touchable};
use web_sys::KeyboardEvent;

/// How far at the left of the robot somebody claps, in metres.
const CLAP_ASIDE_M: f32 = 1.0;
/// How full a battery is that is nearly empty, in percent.
const LOW_PERCENT: u8 = 15;
/// The person with a button of their own.
const PERSON: &str = "person";

/// The buttons under the room.
#[component]
pub(super) fn Tools() -> impl IntoView {
    let desk = hold();
    let is_here = |person: &robot::ScenePerson| person.present && person.id == PERSON;
    let present = Memo::new(move |_| desk.desk().robots.scene.read().people.iter().any(is_here));
    let walk = move |_| {
        let edit = SceneEdit::SetPresent { id: PERSON.to_owned(), present: !present.get_untracked() };
        desk.desk().robots.scene_edit(edit);
    };
    let part = RwSignal::new(Touchable::HeadMiddle);
    view! {
        <div class="room-tools">
            <Touch part />
            <button class="button small" type="button" disabled=move || !may_operate(desk) on:click=walk>
                <Icon name="user" />
                {move || if present.get() { words::person_out() } else { words::person_in() }}
            </button>
            <button class="button small" type="button" title=words::reset_room() aria-label=words::reset_room() disabled=move || !may_operate(desk)
                on:click=move |_| desk.desk().robots.scene_edit(SceneEdit::Reset)>
                <Icon name="reset" />
                {words::reset()}
            </button>
            <More part />
        </div>
        <MayNot least=Role::Operator />
    }
}

/// What else may happen in the room, and where Touch touches.
#[component]
fn More(part: RwSignal<Touchable>) -> impl IntoView {
    let desk = hold();
    let does = move |edit: SceneEdit| Callback::new(move |()| desk.desk().robots.scene_edit(edit.clone()));
    let items = move || {
        let scene = desk.desk().robots.scene.get_untracked();
        let others = scene.people.iter().filter(|person| person.id != PERSON);
        let mut all: Vec<(String, SceneEdit)> = Vec::new();
        let mut comes = |name: &str, id: &str, present: bool| {
            let label = if present { words::goes_out(name) } else { words::comes_in(name) };
            all.push((label, SceneEdit::SetPresent { id: id.to_owned(), present: !present }));
        };
        others.for_each(|person| comes(words::another_person(), &person.id, person.present));
        scene.obstacles.iter().for_each(|one| comes(&words::box_named(&one.color), &one.id, one.present));
        scene.landmarks.iter().for_each(|mark| comes(&words::mark_named(mark.number), &mark.id, mark.present));
        let [x, y, heading] = scene.body.base;
        let at = [x - heading.sin() * CLAP_ASIDE_M, y + heading.cos() * CLAP_ASIDE_M, 1.0];
        all.push((words::clap().to_owned(), SceneEdit::Noise { at }));
        let plugged = scene.body.plugged;
        let cable = if plugged { words::unplug() } else { words::plug() };
        all.push((cable.to_owned(), SceneEdit::Plug { plugged: !plugged }));
        all.push((words::battery_low().to_owned(), SceneEdit::SetBattery { percent: LOW_PERCENT }));
        all.push((words::minute_passes().to_owned(), SceneEdit::PassTime { minutes: 1 }));
        all.push((words::hour_passes().to_owned(), SceneEdit::PassTime { minutes: 60 }));
        let falls = if scene.body.fallen {
            (words::help_up().to_owned(), SceneEdit::HelpUp)
        } else {
            (words::push().to_owned(), SceneEdit::Push)
        };
        all.push(falls);
        let all = all.into_iter().map(|(label, edit)| view! { <MenuItem label icon="" choose=does(edit) /> });
        let parts = Touchable::ALL.map(|one| {
            let chosen = part.get() == one;
            view! { <MenuItem label=words::touch_part(one) icon="touch" chosen choose=Callback::new(move |()| part.set(one)) /> }
        });
        (all.collect_view(), view! { <div class="menu-rule" role="separator"></div> }, parts.into_iter().collect_view())
    };
    let label = Signal::stored(words::more_in_room().to_owned());
    view! {
        <Menu label icon="chevron" alone=true class="room-more" disabled=Signal::derive(move || !may_operate(desk))>{items()}</Menu>
    }
}

/// Touches the robot for as long as it is pressed.
#[component]
fn Touch(part: RwSignal<Touchable>) -> impl IntoView {
    let desk = hold();
    let down = RwSignal::new(false);
    // What was touched is let go, whatever was chosen meanwhile.
    let touched = RwSignal::new(Touchable::HeadMiddle);
    let press = move |now: bool| {
        if down.get_untracked() != now {
            down.set(now);
            if now {
                touched.set(part.get_untracked());
            }
            desk.desk().robots.scene_edit(SceneEdit::Touch { part: touched.get_untracked(), down: now });
        }
    };
    let is_press = |event: &KeyboardEvent| matches!(event.pressed().as_str(), " " | "Enter");
    view! {
        <button
            class="button small"
            type="button"
            title=move || words::touch_part(part.get())
            aria-label=move || words::touch_part(part.get())
            aria-pressed=move || down.get().to_string()
            disabled=move || !may_operate(desk)
            on:pointerdown=move |_| press(true)
            on:pointerup=move |_| press(false)
            on:pointerleave=move |_| press(false)
            on:pointercancel=move |_| press(false)
            on:blur=move |_| press(false)
            on:contextmenu=|event| event.prevent_default()
            on:keydown=move |event| if is_press(&event) { press(true) }
            on:keyup=move |event| if is_press(&event) { press(false) }
        >
            <Icon name="touch" />
            {words::touch()}
        </button>
    }
}

/// What the robot says, or else follows, under it.
#[component]
pub(super) fn Bubble() -> impl IntoView {
    let desk = hold();
    let text = Memo::new(move |_| {
        let desk = desk.desk();
        let body = &desk.robots.scene.read().body;
        let tracking = (!body.tracking.is_empty()).then(|| words::follows(&body.tracking));
        if body.saying.is_empty() { tracking } else { Some(words::saying(&body.saying)) }
    });
    let words = move || text.get().unwrap_or_default();
    view! {
        <div role="status">
            <Show when=move || text.read().is_some()>
                <p class="bubble" title=words><span>{words}</span></p>
            </Show>
        </div>
    }
}

/// What the robot was told to show, newest first: each with its unit, its program and its time. What was shown for programs
/// that ended goes as soon as another one starts.
#[component]
fn Printed() -> impl IntoView {
    let desk = hold();
    let lines = Memo::new(move |_| {
        let desk = desk.desk();
        let runs = desk.robots.runs_here();
        let printed = desk.robots.scene.with(|scene| scene.body.printed.clone());
        shown_still(printed, &runs.iter().map(|run| (run.run, run.phase == RunPhase::Running)).collect::<Vec<_>>())
    });
    let now = Memo::new(move |_| desk.desk().robots.scene.with(|scene| scene.at_ms / 1_000));
    let row = move |printed: robot::Printed| {
        let name = desk.desk().robots.runs_here().into_iter().find(|run| run.run == printed.by.run).map(|run| run.name);
        let value = printed_value(&desk.desk(), &printed);
        let seconds = printed.at_ms / 1_000;
        let ago = move || words::printed_ago(now.get().saturating_sub(seconds));
        view! { <li><b>{value}</b> <span class="faint">{name.map(|name| format!("{name} · "))}{ago}</span></li> }
    };
    let shown = move || lines.get().into_iter().rev().map(row).collect_view();
    view! {
        <Show when=move || !lines.read().is_empty()>
            <ol class="printed" tabindex="0" aria-label=words::printed()>{shown}</ol>
        </Show>
    }
}

/// Shows what the robot was told to show, as a view.
pub(crate) fn printed() -> AnyView {
    view! { <Printed /> }.into_any()
}

/// What was printed by what runs; while nothing runs, by what ran last. `runs` are those that are known, each with whether it
/// runs.
fn shown_still(printed: Vec<robot::Printed>, runs: &[(u64, bool)]) -> Vec<robot::Printed> {
    let some_run = runs.iter().any(|(_, runs)| *runs);
    let last = runs.iter().map(|(run, _)| *run).max();
    let stays = |by: u64| {
        let runs_still = runs.iter().any(|(run, runs)| *run == by && *runs);
        if some_run { runs_still } else { last.is_none_or(|last| last == by) }
    };
    printed.into_iter().filter(|one| stays(one.by.run)).collect()
}

/// A printed value as values are written, with the unit of what leads to its action where the program is open.
fn printed_value(desk: &Desk, printed: &robot::Printed) -> String {
    let value = match printed.text.parse::<f64>() {
        Ok(number) if number.is_finite() => short_value(&Value::Float(number)),
        Ok(_) | Err(_) => return printed.text.clone(),
    };
    let ids = desk.document.connector_ids.get_untracked();
    let source = ids.iter().find_map(|id| {
        let record = desk.document.connector(id)?.record;
        record.with_untracked(|one| (one.output == printed.by.stream).then(|| one.inputs.first().cloned()).flatten())
    });
    match source.map(|id| untrack(|| desk.document.unit(&id))).filter(|unit| !unit.is_empty()) {
        Some(unit) => format!("{value}\u{a0}{unit}"),
        None => value,
    }
}

#[cfg(test)]
mod tests {
    use super::shown_still;
    use behaviour::Id;
    use robot::{Printed, Use};

    #[test]
    fn what_ended_programs_printed_goes_when_another_starts() {
        let printed: Vec<Printed> = [1, 1, 2]
            .map(|run| Printed { by: Use { run, stream: Id::new("p").unwrap() }, at_ms: 0, text: run.to_string() })
            .into();
        let shown = |runs: &[(u64, bool)]| -> String {
            shown_still(printed.clone(), runs).into_iter().map(|one| one.text).collect()
        };
        assert_eq!(shown(&[(1, false), (2, true)]), "2");
        assert_eq!(shown(&[(1, true), (2, true)]), "112");
        assert_eq!(shown(&[(1, false), (2, false)]), "2", "what ran last stays to be read");
        assert_eq!(shown(&[(1, false), (2, false), (3, true)]), "", "another program began");
        assert_eq!(shown(&[]), "112");
    }
}
