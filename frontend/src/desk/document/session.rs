//! A place where somebody types outside a dialog. While the keyboard is there, what it changes is locked; what is typed is
//! a change of what was there when they began, so that nobody overwrites unseen what others saved meanwhile.

use super::Document;
use super::editing::Editing;
use crate::words;
use behaviour::{Accepted, Change, Id, Record, RecordId, Refusal};
use leptos::prelude::*;
use protocol::{Refused, Role};
use std::sync::{Arc, Mutex, PoisonError};

/// One place where somebody types, about one record. A copy is the same place.
#[derive(Clone)]
pub(crate) struct EditSession {
    document: Document,
    record: RecordId,
    begun: Arc<Mutex<Option<KeyboardStay>>>,
}

/// From when the keyboard comes until it leaves.
#[derive(Clone)]
struct KeyboardStay {
    behaviour: Id,
    /// The editor that holds the lock.
    number: u32,
    /// True if it was opened here; one that was open already ends elsewhere.
    is_own: bool,
    /// The record when it began, for when another editor took the place of this one.
    seen: Option<Record>,
}

impl Document {
    /// A place where this record is typed into.
    pub(crate) fn session(&self, record: RecordId) -> EditSession {
        EditSession { document: self.clone(), record, begun: Arc::default() }
    }

    /// Says that somebody else is editing a record; `what` is what people call it. Returns true if so. Not reactive.
    pub(crate) fn says_busy(&self, record: &RecordId, what: &str) -> bool {
        let editor = untrack(|| self.editor_of(record));
        let busy = editor.map(|editor| Refusal::Locked { what: what.to_owned(), by: editor.name });
        let is_busy = busy.is_some();
        busy.into_iter().for_each(|no| self.tab.say_no(&Refused::Change(no)));
        is_busy
    }

    /// A change of one's own waits or is saved: whoever goes on typing saw it.
    pub(super) fn seen_now(&self, to: &Id, change: &Change) {
        self.change_editing(|now| {
            if let Some(after) = now.made_by(change).filter(|_| now.behaviour == *to) {
                now.seen = after.cloned();
            }
        });
    }

    /// A change of one's own was not made: whoever goes on typing sees what is there.
    pub(super) fn seen_again(&self, change: &Change) {
        let is_about = self.edited(|now| now.made_by(change).is_some()) == Some(true);
        if let Some(record) = self.edited(|now| now.record.clone()).filter(|_| is_about) {
            let there = self.state().record(&record);
            self.change_editing(|now| now.seen = there);
        }
    }

    /// A change was saved: of one's own nothing is said; who else changed what is typed into here is named.
    pub(super) fn told_while_typing(&self, to: &Id, accepted: &Accepted) {
        let change = &accepted.change;
        let is_mine = self.state().queue.all().any(|waiting| waiting.change.op == change.op);
        if is_mine {
            return self.seen_now(to, change);
        }
        let is_told = |now: &Editing| {
            let after = now.made_by(change).filter(|_| now.behaviour == *to && !now.only_reads())?;
            (after != now.seen.as_ref()).then(|| after.is_none())
        };
        if let Some(removed) = self.edited(is_told).flatten() {
            let name = self.called(change);
            let said = if removed { words::removed_while_typing(&name) } else { words::changed_while_typing(&name) };
            self.tab.say(&said, true);
        }
    }
}

impl Document {
    /// The program is here again after the link broke, and was at this revision before: who changed meanwhile what is typed
    /// into here is named, as if it had been heard.
    pub(super) fn told_what_was_missed(&self, of: &Id, known: u64) {
        let record =
            self.edited(|now| (now.behaviour == *of).then(|| (now.record.clone(), now.seen.clone()))).flatten();
        let Some((record, seen)) = record else { return };
        if self.with_confirmed(|whole| whole.records.get(&record).cloned()) == seen {
            return;
        }
        let (document, of) = (self.clone(), of.clone());
        self.look_back(of.clone(), known, move |log| {
            let touches = |accepted: &&Accepted| accepted.change.edits.iter().any(|edit| edit.id == record);
            if let Some(last) = log.iter().rev().find(touches) {
                document.told_while_typing(&of, last);
            }
        });
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
        let document = &self.document;
        let Some(behaviour) = document.open.get_untracked() else { return };
        let seen = document.state().record(&self.record);
        if self.is_begun() || seen.is_none() || document.tab.refusal(Role::Editor).is_some() {
            return;
        }
        let writes_here = |now: &Editing| now.behaviour == behaviour && now.record == self.record && !now.reads();
        let open = document.edited(|now| writes_here(now).then_some(now.number)).flatten();
        let is_own = open.is_none();
        let number = open.unwrap_or_else(|| document.open_editor(self.record.clone()));
        if !is_own {
            document.change_editing(|now| now.seen.clone_from(&seen));
        }
        self.put(Some(KeyboardStay { behaviour, number, is_own, seen }));
    }

    /// The keyboard left: others may edit it.
    pub(crate) fn end(&self) {
        let begun = self.begun();
        self.put(None);
        if let Some(begun) = begun.filter(|begun| begun.is_own) {
            self.document.close_editor(begun.number);
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
        let Some(begun) = self.begun() else { return self.document.state().record(&self.record) };
        let seen = self.document.edited(|now| (now.number == begun.number).then(|| now.seen.clone())).flatten();
        seen.unwrap_or(begun.seen)
    }
}
