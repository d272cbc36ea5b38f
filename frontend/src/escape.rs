//! Escape, as everything on the page hears it: what uses it says so, as the second of two that nothing used is Stop.

use crate::keys::PressedKey;
use web_sys::KeyboardEvent;

/// Takes something back where this is Escape; whether it was.
pub(crate) fn ends(event: &KeyboardEvent, take_back: impl FnOnce()) -> bool {
    may_end(event, || {
        take_back();
        true
    })
}

/// Hears Escape, which nothing used yet: `take_back` says whether there was something to close, to clear or to take back.
/// Then neither does the browser anything more with it, nor does `static/stop.js` take it for the first of two. While
/// several keys are one letter, it takes that back.
pub(crate) fn may_end(event: &KeyboardEvent, take_back: impl FnOnce() -> bool) -> bool {
    let is_free = event.pressed() == "Escape";
    let is_used = is_free && !event.default_prevented() && take_back();
    if is_used {
        event.prevent_default();
    }
    is_used
}
