//! A place where somebody types outside a dialog. While the keyboard is there, what it changes is locked; what is typed is
//! a change of what was there when they began, so that nobody overwrites unseen what others saved meanwhile.

use super::Document;
use behaviour::{Record, RecordId, Refusal};
use editor::KeyboardStay;
use leptos::prelude::*;
use protocol::Refused;
use std::sync::{Arc, Mutex, PoisonError};

/// One place where somebody types, about one record. A copy is the same place.
#[derive(Clone)]
pub(crate) struct EditSession {
    document: Document,
    record: RecordId,
    begun: Arc<Mutex<Option<KeyboardStay>>>,
}

impl Document {
    /// A place where this record is typed into.
    pub(crate) fn session(&self, record: RecordId) -> EditSession {
        EditSession { document: self.clone(), record, begun: Arc::default() }
    }

    /// Says that somebody else is editing a record; `what` is what people call it. Returns true if so. Not reactive.
    pub(crate) fn says_busy(&self, record: &RecordId, what: &str) -> bool {
        let editor = untrack(|| self.editor_of(record));
        let busy = editor.map(|editor| Refusal::Locked { what: what.into(), by: editor.name });
        let is_busy = busy.is_some();
        busy.into_iter().for_each(|no| self.tab.say_no(&Refused::Change(no)));
        is_busy
    }
}

impl EditSession {
    fn begun(&self) -> Option<KeyboardStay> {
        self.begun.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn put(&self, begun: Option<KeyboardStay>) {
        *self.begun.lock().unwrap_or_else(PoisonError::into_inner) = begun;
    }

    /// True if somebody types here now.
    pub(crate) fn is_begun(&self) -> bool {
        self.begun().is_some()
    }

    /// The keyboard came: what is typed into is locked, if it is there and nobody else is editing it.
    pub(crate) fn begin(&self) {
        if !self.is_begun() {
            self.put(self.document.input(|editor| editor.begin_typing(&self.record)));
        }
    }

    /// The keyboard left: others may edit it.
    pub(crate) fn end(&self) {
        let begun = self.begun();
        self.put(None);
        if let Some(begun) = begun {
            self.document.input(|editor| editor.end_typing(&begun));
        }
    }

    /// Something was typed.
    pub(crate) fn typing(&self) {
        self.begin();
        self.document.typing();
    }

    /// True if the program in which somebody began to type is still the open one.
    pub(crate) fn is_here(&self) -> bool {
        self.begun().is_none_or(|begun| self.document.is_open(&begun.behaviour))
    }

    /// The record as whoever types has seen it; as it is where nobody types.
    pub(crate) fn seen(&self) -> Option<Record> {
        let state = self.document.state();
        self.begun().map_or_else(|| state.editor.shown(&self.record), |begun| state.editor.seen(&begun))
    }
}
