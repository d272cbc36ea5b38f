//! Refused changes that wait for their author, as the page shows them, and what their author decides.

use super::{Document, UnsavedMark};
use crate::desk::tab::new_id;
use behaviour::labels;
use behaviour::{Behaviour, Id, RecordId};
use editor::Conflict;
use leptos::prelude::*;
use phrase::Phrase;
use protocol::Refused;

impl Document {
    /// Refused changes of the open program that wait for a decision. Reactive.
    pub(crate) fn conflicts_here(&self) -> Vec<Conflict> {
        let Some(open) = self.open.get() else { return Vec::new() };
        let all = self.conflicts.get().into_iter();
        all.filter(|conflict| conflict.behaviour == open && conflict.retry.is_none()).collect()
    }

    /// Those of them that their author can decide about now. Reactive.
    fn undecided(&self) -> impl Iterator<Item = Conflict> + use<> {
        self.conflicts_here().into_iter().filter(|conflict| !conflict.locked)
    }

    /// One of them by the name of the change, also while it is put on top. Reactive.
    pub(crate) fn conflict(&self, op: &Id) -> Option<Conflict> {
        self.conflicts.get().into_iter().find(|conflict| conflict.mine.op == *op)
    }

    /// The open behaviour as the server has it. Reactive.
    pub(crate) fn as_saved(&self) -> Behaviour {
        self.revision.track();
        self.with_confirmed(Behaviour::clone)
    }

    /// The refused change that waits about a record. Reactive.
    pub(crate) fn conflict_about(&self, id: &Id) -> Option<Conflict> {
        self.undecided().find(|conflict| conflict.about.id == *id)
    }

    /// The next refused change that was not shown yet. Reactive.
    pub(crate) fn next_conflict(&self) -> Option<Id> {
        let next = self.undecided().find(|conflict| !conflict.shown);
        next.map(|conflict| conflict.mine.op)
    }

    /// It is shown now; put off, it only waits.
    pub(crate) fn conflict_shown(&self, op: &Id) {
        self.input(|editor| editor.conflict_shown(op));
    }

    /// Puts one's own on top of what there is now; `on_no` hears why that cannot be.
    pub(crate) fn keep_mine(&self, op: &Id, on_no: impl FnOnce(Refused) + 'static) {
        let top = new_id();
        self.on_answer(&top, Box::new(|answer| answer.map_or_else(on_no, drop)));
        self.input(|editor| editor.keep_mine(op, top));
    }

    /// Drops one's own change; the one that others saved stays.
    pub(crate) fn drop_conflict(&self, op: &Id) {
        self.input(|editor| editor.drop_conflict(op));
    }

    /// Brings back what somebody removed under an open editor; `then` hears whether it is there again.
    pub(crate) fn bring_back(&self, record: RecordId, then: impl FnOnce(Result<(), Refused>) + 'static) {
        let start = self.change(labels::bring_back(""));
        self.on_answer(&start.op, Box::new(then));
        self.input(|editor| editor.bring_back(record, start));
    }

    /// Finds out who changed something last, and when; `then` hears nothing if that is too long ago.
    pub(crate) fn find_last_change(&self, record: RecordId, then: impl FnOnce(String, f64) + 'static) {
        let number = self.on_last_change(Box::new(then));
        self.input(|editor| editor.find_last_change(record, number));
    }

    /// Finds out who removed something, if it was not heard here.
    pub(crate) fn find_remover(&self, id: Id) {
        self.input(|editor| editor.find_remover(id));
    }

    /// Returns the mark of a record: that its change waits to be sent, or to be decided about. Reactive.
    pub(crate) fn mark_of(&self, record: &RecordId) -> Option<UnsavedMark> {
        if self.conflict_about(&record.id).is_some() {
            return Some(UnsavedMark::Undecided);
        }
        self.waits.with(|waits| waits.contains(record)).then_some(UnsavedMark::Waits)
    }

    /// Returns the words for the changes that wait to be sent, oldest first; and whether each is of the open program.
    /// Not reactive.
    pub(crate) fn waiting(&self) -> Vec<(Phrase, bool)> {
        let state = self.state();
        let all = state.editor.queue().all();
        all.map(|waiting| (waiting.change.label.clone(), state.editor.is_wanted(&waiting.behaviour))).collect()
    }
}

/// Returns the key under which the unsaved text about something is kept.
pub(crate) fn draft_key(about: &Id) -> String {
    format!("rrp.draft.{about}")
}
