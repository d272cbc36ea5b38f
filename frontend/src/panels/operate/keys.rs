//! The keys of this page: 1 to 9 press tiles, M marks, N writes the note of the newest mark. A key that is held counts once.

use super::OperateShared;
use crate::keys::PressedKey;
use crate::panels::buttons::is_plain;
use crate::panels::focus;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::Element;

/// Listens for as long as the page lives.
pub(super) fn listen(op: OperateShared) {
    let handle = window_event_listener(leptos::ev::keydown, move |event| {
        // A held Enter presses a button once, as a finger does.
        let on_button = || {
            let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
            target.is_some_and(|target| target.closest("button").is_ok_and(|button| button.is_some()))
        };
        if event.repeat() && event.pressed() == "Enter" && on_button() {
            event.prevent_default();
        }
        if !is_plain(&event) || op.asks.get_untracked() {
            return;
        }
        let key = event.pressed().to_lowercase();
        let heard = match key.as_str() {
            "m" => {
                untrack(|| op.mark(""));
                true
            }
            "n" => write_note(op),
            _ => match key.parse::<usize>() {
                Ok(number @ 1..) => untrack(|| op.press(number)),
                _ => false,
            },
        };
        if heard {
            event.prevent_default();
        }
    });
    on_cleanup(move || handle.remove());
}

/// Opens the note of the newest mark, which gets the keyboard; whether there is one.
fn write_note(op: OperateShared) -> bool {
    let is_one = op.open_note();
    if is_one {
        focus::soon(0, "#op-note", focus::focus);
    }
    is_one
}
