//! Notes beside the graph: written, and where each stands.

use super::{Document, NoteSignals};
use crate::desk::tab::{new_id, set_if_new};
use behaviour::{Id, Note, Place, Record, RecordId};
use editor::Editor;
use leptos::prelude::*;

impl Document {
    /// The signals of one note, none when it is gone.
    pub(crate) fn note_signals(&self, id: &Id) -> Option<NoteSignals> {
        self.state().notes.get(id).cloned()
    }

    /// A new note with its place; gives its id.
    pub(crate) fn add_note(&self, text: &str, at: Place) -> Id {
        self.input(|editor| editor.add_note(new_id(), text, at))
    }

    /// Another text of a note; `seen` is what its author saw when they began.
    pub(crate) fn edit_note(&self, id: &Id, seen: Note, text: &str) {
        self.input(|editor| editor.edit_note(new_id(), id, seen, text));
    }

    /// Removes a note that nothing is left of, if it is still as its author saw it.
    pub(crate) fn remove_note(&self, id: &Id, seen: Note) {
        self.input(|editor| editor.remove_note(new_id(), id, seen));
    }

    pub(super) fn refresh_note(&self, key: &RecordId) {
        let now = self.state().editor.shown(key);
        let known = self.note_signals(&key.id);
        match (now, known) {
            (Some(Record::Note(note)), Some(signals)) => set_if_new(&signals.record, note),
            (Some(Record::Note(note)), None) => {
                let state = &mut *self.state();
                let place = state.editor.note_place(&key.id);
                let signals = NoteSignals { record: ArcRwSignal::new(note), place: ArcRwSignal::new(place) };
                state.notes.insert(key.id.clone(), signals);
            }
            (_, Some(_)) => drop(self.state().notes.remove(&key.id)),
            (_, None) => {}
        }
    }

    pub(super) fn refresh_note_order(&self) {
        let ids = self.state().notes.keys().cloned().collect();
        set_if_new(&self.note_ids, ids);
    }

    /// Returns the place of a new note that nobody places.
    pub(crate) fn place_for_note(&self) -> Place {
        self.input(Editor::place_for_note)
    }
}
