//! The keyboard on the list in place of the graph: what can be done with the graph there, but walking and zooming.

use crate::desk::{Desk, Dialog, Selected};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::graph::edit;
use crate::keys::PressedKey;
use crate::later::SecondPiece;
use editor::keys::EscapeUse;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent};

/// Hears a key on the list or in it. A row that has the keyboard is pressed by Enter as any button; as a command, Enter
/// edits what is selected.
pub(super) fn key(event: &KeyboardEvent, desk: &Desk, piece: &SecondPiece) {
    let Some(target) = event.target().and_then(|target| target.dyn_into::<Element>().ok()) else { return };
    let own = target.closest("input, textarea, select, [role=menu], .told, .control-inline").ok().flatten().is_some();
    if own || event.alt_key() {
        return;
    }
    if event.ctrl_key() || event.meta_key() {
        if piece.now().is_some_and(|rest| (rest.chord)(event, desk, None)) {
            event.prevent_default();
        }
        return;
    }
    let chosen = desk.document.selected.get_untracked();
    let several = desk.document.several.with_untracked(|several| !several.is_empty());
    match (event.pressed().as_str(), chosen) {
        ("Enter", Some(chosen)) if !event.is_trusted() => edit(desk, &chosen),
        ("F2", Some(Selected::Stream(id))) => desk.dialog.set(Some(Dialog::EditStream(id))),
        ("Delete" | "Backspace", _) if several => desk.document.remove_several(&desk.document.chosen()),
        ("Delete" | "Backspace", Some(chosen)) => remove(desk, &chosen),
        _ => return deselect(event, desk),
    }
    event.prevent_default();
}

/// Escape chooses nothing any more, which is nothing to take back.
fn deselect(event: &KeyboardEvent, desk: &Desk) {
    escape::may_end(event, || desk.document.escape() == EscapeUse::EndFollowing);
}

/// Removes something; in the middle of a way its button asks how.
fn remove(desk: &Desk, what: &Selected) {
    match what {
        Selected::Stream(id) if desk.document.healed_by(id).is_some() => {
            focus::press_of(desk, what, FocusPlace::RemoveRow)
        }
        Selected::Stream(_) | Selected::Connector(_) | Selected::Note(_) | Selected::Group(_) => {
            desk.document.remove(what)
        }
    }
}
