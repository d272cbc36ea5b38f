//! Locks on this page: who else is editing what, and the lock of what is edited here.

use super::Document;
use behaviour::{Id, RecordId};
use editor::Editor;
use leptos::prelude::*;

/// Somebody else who is editing something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct OtherEditor {
    pub(crate) name: String,
    /// The number of the colour, of the eight for people.
    pub(crate) color: u8,
}

impl Document {
    /// Returns what others are editing, each with who does. Reactive.
    pub(crate) fn edited_by_others(&self) -> Vec<(RecordId, OtherEditor)> {
        let me = self.tab.me.with(|me| me.as_ref().map(|me| me.client.clone()));
        let people = self.people.get();
        let color =
            |client: &Id| people.iter().find(|person| person.client == *client).map_or(0, |person| person.color);
        let locks = self.locks.get().into_iter().filter(|lock| Some(&lock.client) != me.as_ref());
        let records = locks.flat_map(|lock| {
            let editor = OtherEditor { color: color(&lock.client) % 8, name: lock.name };
            lock.records.into_iter().map(move |record| (record, editor.clone()))
        });
        records.collect()
    }

    /// Returns the other person who is editing a record. Reactive.
    pub(crate) fn editor_of(&self, record: &RecordId) -> Option<OtherEditor> {
        self.edited_by_others().into_iter().find(|(edited, _)| edited == record).map(|(_, editor)| editor)
    }

    /// An editor is opened here: its lock is asked for. Answers with the number that ends it.
    pub(crate) fn open_editor(&self, record: RecordId) -> u32 {
        self.input(|editor| editor.open_editor(record))
    }

    /// An editor was closed: what it locked is free.
    pub(crate) fn close_editor(&self, number: u32) {
        self.input(|editor| editor.close_editor(number));
    }

    /// Asks for the lock of what is edited here.
    pub(crate) fn take_lock(&self) {
        self.input(Editor::take_lock);
    }

    /// Somebody types in the editor here; told at most once a second.
    pub(crate) fn typing(&self) {
        self.input(Editor::typing);
    }

    /// Takes it from whoever is editing, who keeps what they wrote.
    pub(crate) fn take_over(&self) {
        self.input(Editor::take_over);
    }

    /// Asks whoever is editing to let this person edit.
    pub(crate) fn ask_for(&self) {
        self.input(Editor::ask_for);
    }

    /// One no longer wants what was asked for.
    pub(crate) fn ask_no_more(&self) {
        self.input(Editor::ask_no_more);
    }

    /// Says to who asks that they may edit, or that they may not yet.
    pub(crate) fn hand_over(&self, yes: bool) {
        self.input(|editor| editor.hand_over(yes));
    }

    /// Moves the clock of what is counted down beside an editor.
    pub(in crate::desk) fn tick_lock(&self) {
        self.input(Editor::tick);
    }
}
