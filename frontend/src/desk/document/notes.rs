//! Notes beside the graph: written, and where each stands.

use super::{Document, DocumentState, NoteSignals, Selected, build, several};
use crate::browser;
use crate::desk::tab::{new_id, set_if_new};
use crate::layout;
use behaviour::labels;
use behaviour::{Id, Kind, Note, Place, Record, RecordId};
use leptos::prelude::*;
use phrase::Phrase;

/// The distance to the left of the graph at which a note stands that nobody placed, and below the one before.
const APART: (f64, f64) = (320.0, 140.0);

impl Document {
    /// The signals of one note, none when it is gone.
    pub(crate) fn note_signals(&self, id: &Id) -> Option<NoteSignals> {
        self.state().notes.get(id).cloned()
    }

    /// A new note with its place; gives its id.
    pub(crate) fn add_note(&self, text: &str, at: Place) -> Id {
        let (id, behaviour) = (new_id(), self.behaviour());
        let change = self.change(labels::add(Phrase::word("note"))).put(
            &behaviour,
            RecordId::new(Kind::Note, &id),
            self.written(text),
        );
        let place = Record::Place(layout::snapped(at));
        self.propose(change.put(&behaviour, RecordId::new(Kind::Place, &id), place));
        id
    }

    /// Another text of a note; `seen` is what its author saw when they began.
    pub(crate) fn edit_note(&self, id: &Id, seen: Note, text: &str) {
        let change = self.change(labels::edit(Phrase::word("note")));
        let change = change.put(&self.behaviour(), RecordId::new(Kind::Note, id), self.written(text));
        self.propose(build::as_seen(change, Kind::Note, id, Record::Note(seen)));
    }

    /// Removes a note that nothing is left of, if it is still as its author saw it.
    pub(crate) fn remove_note(&self, id: &Id, seen: Note) {
        let change = several::without(
            &self.behaviour(),
            self.change(labels::remove(Phrase::word("note"))),
            &[Selected::Note(id.clone())].into(),
        );
        self.propose(build::as_seen(change, Kind::Note, id, Record::Note(seen)));
    }

    /// Returns the note as it is written here and now.
    fn written(&self, text: &str) -> Record {
        Record::Note(Note { text: text.to_owned(), by: self.tab.my_name(), at_ms: browser::today_ms() as u64 })
    }

    pub(super) fn refresh_note(&self, key: &RecordId) {
        let now = self.state().record(key);
        let known = self.note_signals(&key.id);
        match (now, known) {
            (Some(Record::Note(note)), Some(signals)) => set_if_new(&signals.record, note),
            (Some(Record::Note(note)), None) => {
                let place = self.note_place(&key.id);
                let signals = NoteSignals { record: ArcRwSignal::new(note), place: ArcRwSignal::new(place) };
                self.state().notes.insert(key.id.clone(), signals);
            }
            (_, Some(_)) => {
                self.state().notes.remove(&key.id);
                self.deselect_gone(&key.id);
            }
            (_, None) => {}
        }
    }

    pub(super) fn refresh_note_order(&self) {
        let ids = self.state().notes.keys().cloned().collect();
        set_if_new(&self.note_ids, ids);
    }

    /// Returns the place of a note; one that nobody placed stands left of the graph.
    pub(super) fn note_place(&self, id: &Id) -> Place {
        let mut state = self.state();
        if let Some(place) = state.saved_place(id) {
            return place;
        }
        if let Some(place) = state.fallback.get(id) {
            return *place;
        }
        let before = state.notes.keys().filter(|note| state.fallback.contains_key(note)).count();
        let place = state.left_of_graph(before);
        state.fallback.insert(id.clone(), place);
        place
    }

    /// Returns the place of a new note that nobody places: left of the graph, below the notes that are there.
    pub(crate) fn place_for_note(&self) -> Place {
        let state = self.state();
        state.left_of_graph(state.notes.len())
    }
}

impl DocumentState {
    fn left_of_graph(&self, row: usize) -> Place {
        let streams = self.streams.values().map(|signals| signals.place.get_untracked());
        let corner = streams.reduce(|one, other| Place { x: one.x.min(other.x), y: one.y.min(other.y) });
        let corner = corner.unwrap_or(Place { x: 0.0, y: 0.0 });
        layout::snapped(Place { x: corner.x - APART.0, y: corner.y + row as f64 * APART.1 })
    }
}
