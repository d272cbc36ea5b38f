//! The server's messages about the open behaviour.

use super::{Document, DocumentEvent};
use crate::desk::tab::{Gone, set_if_new};
use crate::words;
use behaviour::{Accepted, Grant, Id, LockEvent, Problem};
use leptos::prelude::*;
use protocol::{LockShown, Person, Refused};

impl Document {
    /// A change was saved; whoever made it here is told.
    pub(in crate::desk) fn hear_accepted(&self, to: &Id, accepted: &Accepted) {
        self.input(|editor| editor.hear_accepted(to, accepted));
    }

    /// The next change was made, by whomever.
    pub(super) fn made(&self, accepted: Accepted) {
        self.compare_again();
        self.happened(DocumentEvent::Made(accepted));
    }

    /// The server said yes or no to a change of this tab.
    pub(in crate::desk) fn answered(&self, op: &Id, answer: Result<(), Refused>) {
        self.input(|editor| editor.answered(op, answer));
    }

    /// Remembers who removed what, for whoever has it open in a dialog.
    pub(in crate::desk) fn note_removed(&self, accepted: &Accepted) {
        self.input(|editor| editor.note_removed(accepted));
    }

    pub(in crate::desk) fn hear_ping(&self, open: Option<(Id, u64)>) {
        self.input(|editor| editor.hear_ping(open));
    }

    /// The server says whether it can save.
    pub(in crate::desk) fn hear_store(&self, away: Option<phrase::Phrase>) {
        self.input(|editor| editor.hear_store(away));
    }

    /// A lock was given unasked.
    pub(in crate::desk) fn hear_grant(&self, grant: &Grant) {
        self.input(|editor| editor.hear_grant(grant));
    }

    /// Everyone is told who is editing what.
    pub(in crate::desk) fn hear_locks(&self, of: &Id, locks: Vec<LockShown>) {
        self.input(|editor| editor.hear_locks(of, locks));
    }

    /// Something happened to a lock that is held or wanted here.
    pub(in crate::desk) fn hear_lock_event(&self, of: &Id, now_ms: u64, event: &LockEvent) {
        self.input(|editor| editor.hear_lock_event(of, now_ms, event));
    }

    pub(in crate::desk) fn hear_fingerprint(&self, of: &Id, fingerprint: u32) {
        if self.is_open(of) {
            set_if_new(&self.fingerprint, fingerprint);
        }
    }

    pub(in crate::desk) fn hear_problems(&self, of: &Id, problems: Vec<Problem>) {
        if self.is_open(of) {
            set_if_new(&self.problems, problems);
        }
    }

    pub(in crate::desk) fn hear_people(&self, of: &Id, people: Vec<Person>) {
        self.input(|editor| editor.hear_people(of, people));
    }

    /// A program was moved to the bin.
    pub(in crate::desk) fn removed(&self, id: &Id, by: &str) {
        if !self.is_wanted(id) {
            return;
        }
        let name = self.name.get_untracked();
        let mine = self.tab.removing.with_untracked(|removing| removing.as_ref() == Some(id));
        self.close_program();
        self.input(|editor| editor.forget_waiting(id));
        if !mine {
            let gone = Gone { id: id.clone(), name };
            self.tab.say_gone(&words::program_removed_by(by, &gone.name), gone);
        }
    }
}
