//! Beside the picture: touching the head, the person, a fresh start, what the robot says and what it shows.

use crate::icons::Icon;
use crate::panels::hold::hold;
use crate::panels::may::{MayNot, may_operate};
use crate::words;
use leptos::prelude::*;
use protocol::Role;
use robot::SceneEdit;
use web_sys::KeyboardEvent;

/// The only person there is.
const PERSON: &str = "person";

/// The buttons under the room.
#[component]
pub(super) fn Tools() -> impl IntoView {
    let desk = hold();
    let present = Memo::new(move |_| desk.desk().robots.scene.read().people.iter().any(|person| person.present));
    let walk = move |_| {
        let edit = SceneEdit::SetPresent { id: PERSON.to_owned(), present: !present.get_untracked() };
        desk.desk().robots.scene_edit(edit);
    };
    view! {
        <div class="room-tools">
            <TouchHead />
            <button class="button small" type="button" disabled=move || !may_operate(desk) on:click=walk>
                <Icon name="user" />
                {move || if present.get() { words::person_out() } else { words::person_in() }}
            </button>
            <button class="button small" type="button" title=words::reset_room() aria-label=words::reset_room() disabled=move || !may_operate(desk)
                on:click=move |_| desk.desk().robots.scene_edit(SceneEdit::Reset)>
                <Icon name="reset" />
                {words::reset()}
            </button>
        </div>
        <MayNot least=Role::Operator />
    }
}

/// Touches the head for as long as it is pressed.
#[component]
fn TouchHead() -> impl IntoView {
    let desk = hold();
    let down = RwSignal::new(false);
    let press = move |now: bool| {
        if down.get_untracked() != now {
            down.set(now);
            desk.desk().robots.scene_edit(SceneEdit::TouchHead { down: now });
        }
    };
    let is_press = |event: &KeyboardEvent| matches!(event.key().as_str(), " " | "Enter");
    view! {
        <button
            class="button small"
            type="button"
            title=words::touch_head()
            aria-label=words::touch_head()
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

/// The texts that the robot was told to show.
#[component]
pub(super) fn Printed() -> impl IntoView {
    let desk = hold();
    let lines = Memo::new(move |_| desk.desk().robots.scene.read().body.printed.clone());
    let shown = move || lines.get().into_iter().rev().map(|line| view! { <li>{line}</li> }).collect_view();
    view! {
        <Show when=move || !lines.read().is_empty()>
            <ol class="printed" aria-label=words::printed()>{shown}</ol>
        </Show>
    }
}
