//! The keys of this page: 1 to 9 press tiles, 0 says no to one that asks, M marks, N writes the note of the newest mark. A key
//! that is held counts once; of one that marks it asks for the verdict.

use super::OperateShared;
use crate::browser;
use crate::focus::{self, FocusPlace};
use crate::keys::PressedKey;
use crate::robots::is_plain;
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
                let made = op.made_by(|| untrack(|| op.mark("", browser::today_ms())));
                op.key_down(made);
                true
            }
            "0" => op.say_no(None),
            "n" => write_note(op),
            _ => match key.parse::<usize>() {
                Ok(number @ 1..) => press_tile(op, number),
                _ => false,
            },
        };
        if heard {
            event.prevent_default();
        }
    });
    let up = window_event_listener(leptos::ev::keyup, move |_| op.let_go());
    let away = window_event_listener(leptos::ev::blur, move |_| op.let_go());
    on_cleanup(move || [handle, up, away].map(WindowListenerHandle::remove).into_iter().collect());
}

/// Presses a tile, and asks for the verdict of what it marks if its key stays down; whether there is one.
fn press_tile(op: OperateShared, number: usize) -> bool {
    let before = op.open_span_of(number);
    let mut is_one = false;
    let made = op.made_by(|| is_one = untrack(|| op.press(number, browser::today_ms())));
    if is_one && op.is_word(number) {
        op.key_down(before.or(made));
    }
    is_one
}

/// Opens the note of the newest mark, which gets the keyboard; whether there is one.
fn write_note(op: OperateShared) -> bool {
    let is_one = op.open_note();
    if is_one {
        focus::place(FocusPlace::MarkNote);
    }
    is_one
}
