//! Saying something to the simulated robot.

use crate::parts::{hold, may_operate};
use crate::robots::words;
use leptos::prelude::*;
use robot::{SPOKEN_MAX_CHARS, SceneEdit};

/// A line to type in what somebody in the room says.
#[component]
pub(super) fn Speak() -> impl IntoView {
    let desk = hold();
    let text = RwSignal::new(String::new());
    let say = move |event: leptos::ev::SubmitEvent| {
        event.prevent_default();
        let words = text.get_untracked().trim().to_owned();
        if !words.is_empty() {
            desk.desk().robots.scene_edit(SceneEdit::Speak { words });
            text.set(String::new());
        }
    };
    view! {
        <form class="room-tools speak" autocomplete="off" on:submit=say>
            <input
                class="input"
                type="text"
                aria-label=words::speak_to_it()
                placeholder=words::speak_to_it()
                maxlength=SPOKEN_MAX_CHARS.to_string()
                disabled=move || !may_operate(desk)
                prop:value=move || text.get()
                on:input:target=move |event| text.set(event.target().value())
            />
            <button class="button small" type="submit" disabled=move || !may_operate(desk)>{words::speak()}</button>
        </form>
    }
}
