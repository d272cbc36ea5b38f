//! Copying, cutting, pasting and doubling what is chosen, and the keys for it.

use super::Stage;
use crate::browser;
use crate::desk::{Desk, Dialog, Pasted, ProgramPart, Put, Selected};
use crate::graph::words;
use crate::keys::PressedKey;
use crate::later::PasteTarget;
use behaviour::{Helper, Place};
use editor::keys::{GraphChord, graph_chord};
use leptos::prelude::*;
use protocol::Role;
use std::collections::BTreeSet;
use web_sys::KeyboardEvent;

fn helpers(desk: &Desk) -> Vec<Helper> {
    desk.library.helpers.with_untracked(|all| all.iter().map(|(_, helper)| helper.clone()).collect())
}

/// Returns what is chosen as a part of a program, and which of it is in that. If it cannot be copied, says why.
fn chosen_part(desk: &Desk) -> Option<(ProgramPart, BTreeSet<Selected>)> {
    let chosen = desk.document.chosen();
    let part = desk.document.part(&chosen, &helpers(desk));
    if !part.is_empty() {
        let held = chosen.into_iter().filter(|one| part.holds(one)).collect();
        return Some((part, held));
    }
    if !chosen.is_empty() {
        desk.say(words::copied_with_stream(), false);
    }
    None
}

/// Copies what is chosen; which of it was copied.
pub(super) fn copy(desk: &Desk) -> BTreeSet<Selected> {
    let Some((part, held)) = chosen_part(desk) else { return BTreeSet::new() };
    // A menu may not read the clipboard: it pastes what was copied here.
    desk.document.copied.set(Some(part.text()));
    if browser::copy(&part.text()) {
        desk.say(words::copied(), false);
    }
    held
}

/// Copies what is chosen and removes that much of it.
fn cut(desk: &Desk) {
    let copied = copy(desk);
    if !copied.is_empty() {
        desk.document.remove_several(&copied);
    }
}

/// Pastes what was copied in this page.
fn paste_copied(desk: &Desk, stage: Option<&dyn PasteTarget>) {
    match desk.document.copied.get_untracked() {
        Some(text) => drop(paste(desk, stage, &text)),
        None => desk.say(words::nothing_copied(), false),
    }
}

/// Puts a part in; on the canvas it is brought into view.
fn put(desk: &Desk, stage: Option<&dyn PasteTarget>, part: ProgramPart, at: Put) {
    let reveal = stage.map(PasteTarget::reveal);
    desk.document.put_in(part, at, &helpers(desk), move || reveal.into_iter().for_each(|reveal| reveal()));
}

/// A second one of what is chosen, beside it.
pub(super) fn duplicate(desk: &Desk, stage: Option<&dyn PasteTarget>) {
    if let Some((part, _)) = chosen_part(desk) {
        put(desk, stage, part, Put::Beside);
    }
}

/// Pastes a part of a program under the pointer, and beside what was copied where there is no canvas; offers to open a
/// whole program. Returns true if it was one of them.
pub(crate) fn paste(desk: &Desk, stage: Option<&dyn PasteTarget>, text: &str) -> bool {
    let Some(part) = ProgramPart::read(text, crate::json::read) else {
        let whole = Pasted::read(text);
        let is_whole = whole.is_some();
        whole.into_iter().for_each(|whole| desk.dialog.set(Some(Dialog::OpenPasted(whole))));
        return is_whole;
    };
    let at = stage.map_or(Put::Beside, |stage| Put::At(stage.paste_place()));
    put(desk, stage, part, at);
    true
}

impl PasteTarget for Stage {
    /// Returns the place under the pointer, else in the middle of what is seen.
    fn paste_place(&self) -> Place {
        let (middle, view) = (self.size.get_untracked(), self.view.get_untracked());
        self.pointer.get_untracked().unwrap_or_else(|| view.to_canvas((middle.0 / 2.0, middle.1 / 3.0)))
    }

    fn reveal(&self) -> Box<dyn FnOnce()> {
        let stage = self.clone();
        Box::new(move || stage.reveal_chosen())
    }
}

/// Keys with Control or Command on the graph, or on the list in its place; whether it was one.
pub(crate) fn chord(event: &KeyboardEvent, desk: &Desk, stage: Option<&dyn PasteTarget>) -> bool {
    let may = untrack(|| desk.may(Role::Editor));
    match graph_chord(&event.pressed(), event.shift_key(), may) {
        Some(GraphChord::ChooseAll) => desk.document.choose_all(),
        Some(GraphChord::Copy) => drop(copy(desk)),
        Some(GraphChord::Cut) => cut(desk),
        // A key that is really pressed pastes by the browser's own event.
        Some(GraphChord::Paste) if event.is_trusted() => return false,
        Some(GraphChord::Paste) => paste_copied(desk, stage),
        Some(GraphChord::Duplicate) => duplicate(desk, stage),
        Some(GraphChord::Ungroup) => desk.document.ungroup(&desk.document.chosen()),
        Some(GraphChord::Group) => desk.document.make_group(&desk.document.chosen()),
        None => return false,
    }
    true
}
