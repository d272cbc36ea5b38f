//! The keys of the panel. Escape is none of them: Esc Esc is Stop.

use super::{PastShared, target};
use crate::keys::PressedKey;
use lanes::LaneAct;
use leptos::prelude::ReadUntracked;
use web_sys::KeyboardEvent;

/// Does what a key says, unless it is for the field or the button that has the keyboard.
pub(super) fn key(event: &KeyboardEvent, past: PastShared) {
    if event.ctrl_key() || event.meta_key() || event.alt_key() || event.default_prevented() {
        return;
    }
    let at = |selector: &str| {
        let target = target(event).and_then(|target| target.closest(selector).ok().flatten());
        target.is_some()
    };
    let pressed = event.pressed();
    if at("select, input") || (at("button") && matches!(pressed.as_str(), " " | "Enter")) {
        return;
    }
    let shift = event.shift_key();
    let act = match pressed.as_str() {
        " " => LaneAct::Play,
        "ArrowLeft" if shift => LaneAct::Second(false),
        "ArrowRight" if shift => LaneAct::Second(true),
        "ArrowLeft" => LaneAct::Value(false),
        "ArrowRight" => LaneAct::Value(true),
        "ArrowUp" => LaneAct::NextLane(false),
        "ArrowDown" => LaneAct::NextLane(true),
        "[" => LaneAct::NextMark(false),
        "]" => LaneAct::NextMark(true),
        "Home" => LaneAct::Home,
        "End" => LaneAct::End,
        "+" | "=" => LaneAct::ZoomHere(0.5),
        "-" => LaneAct::ZoomHere(2.0),
        "w" | "W" => {
            past.ask_why();
            event.prevent_default();
            return;
        }
        "b" | "B" => {
            if past.opened.read_untracked().is_some() {
                past.toggle_compare();
                event.prevent_default();
            }
            return;
        }
        "l" | "L" => {
            super::head::to_add_lane();
            event.prevent_default();
            return;
        }
        _ => return,
    };
    event.prevent_default();
    past.act(act);
}
