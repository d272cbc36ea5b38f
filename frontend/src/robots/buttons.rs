//! The buttons of the open program: an operator presses them while it runs, or the keys 1 to 9.

use crate::keys::PressedKey;
use crate::parts::{hold, may_operate};
use crate::robots::words;
use behaviour::{Id, StreamKind, Value};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent};

/// The first so many have a key.
const KEYS: usize = 9;

/// One for each button that the program senses; none if it senses none.
#[component]
pub(crate) fn Buttons() -> impl IntoView {
    let desk = hold();
    let all = Memo::new(move |_| {
        let document = &desk.desk().document;
        document.stream_ids.get().into_iter().filter_map(|id| Some((id.clone(), label(desk, &id)?))).collect::<Vec<_>>()
    });
    let runs = Memo::new(move |_| desk.desk().robots.running().is_some());
    let may_press = move || runs.get() && may_operate(desk);
    let press = move |id: &Id| desk.desk().robots.stimulate(id, Value::Bool(true), || ());
    let handle = window_event_listener(leptos::ev::keydown, move |event| {
        let which = number_of(&event).filter(|_| desk.desk().dialog.with_untracked(Option::is_none));
        let pressed = which.and_then(|which| Some(all.get_untracked().get(which - 1)?.0.clone()));
        if let Some(id) = pressed.filter(|_| untrack(may_press)) {
            press(&id);
            event.prevent_default();
        }
    });
    on_cleanup(move || handle.remove());
    let button = move |(at, (id, label)): (usize, (Id, String))| {
        let key = (at < KEYS).then(|| (at + 1).to_string());
        let shown = key.clone().map(|key| view! { <kbd aria-hidden="true">{key}</kbd> });
        view! {
            <button class="button" type="button" aria-keyshortcuts=key disabled=move || !may_press() on:click=move |_| press(&id)>
                {shown}
                {label}
            </button>
        }
    };
    view! {
        <Show when=move || !all.read().is_empty()>
            <div class="program-buttons" role="group" aria-label=words::buttons()>
                {move || all.get().into_iter().enumerate().map(button).collect_view()}
            </div>
        </Show>
    }
}

/// True for a key that is pressed alone, neither held down nor typed into a field.
pub(crate) fn is_plain(event: &KeyboardEvent) -> bool {
    let field = "input, textarea, select, [contenteditable]";
    let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    let writes = target.is_some_and(|target| target.closest(field).is_ok_and(|field| field.is_some()));
    !(event.ctrl_key() || event.alt_key() || event.meta_key() || event.repeat() || event.default_prevented() || writes)
}

/// The number of the button whose key was pressed.
fn number_of(event: &KeyboardEvent) -> Option<usize> {
    let which = event.pressed().parse::<usize>().ok().filter(|_| is_plain(event))?;
    (1..=KEYS).contains(&which).then_some(which)
}

/// What stands on the button that a stream senses, if it is one. Reactive.
fn label(desk: crate::parts::DeskHold, id: &Id) -> Option<String> {
    let stream = desk.desk().document.stream(id)?;
    let stream = stream.record.read();
    let device = robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok()?;
    device.button_words(&stream.params).as_ref().map(words::shown)
}
