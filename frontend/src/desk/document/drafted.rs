//! The record that is turned or typed and not saved yet, for whoever shows what would come of it.

use super::{Document, Saving};
use behaviour::labels;
use behaviour::{Change, Record, RecordId};
use editor::unsaved;
use leptos::prelude::*;

impl Document {
    /// A record is turned or typed and would be saved like this.
    pub(crate) fn draft(&self, id: RecordId, record: Record) {
        self.drafted.set(Some((id, record)));
    }

    /// A record is saved, or left as it was.
    pub(crate) fn forget_draft(&self, id: &RecordId) {
        if self.drafted.with_untracked(|draft| draft.as_ref().is_some_and(|(of, _)| of == id)) {
            self.drafted.set(None);
        }
    }

    /// True if something of the open behaviour is not saved yet. Reactive.
    pub(crate) fn is_unsaved(&self) -> bool {
        self.drafted.read().is_some() || *self.saving.read() != Saving::Saved
    }

    /// All of the open behaviour that is not saved yet, as one change: what waits to be sent, and what is turned or typed.
    pub(crate) fn unsaved(&self) -> Option<Change> {
        if untrack(|| !self.is_unsaved()) {
            return None;
        }
        let (now, draft, start) = (self.behaviour(), self.drafted.get_untracked(), self.change(labels::edit("")));
        let change = self.with_confirmed(|saved| unsaved(saved, &now, draft, start));
        (!change.edits.is_empty()).then_some(change)
    }
}
