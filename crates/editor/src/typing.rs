//! Typing into a record outside a dialog. While the keyboard is there, what it changes is locked; what is typed is a change
//! of what was there when it came, so that nobody overwrites unseen what others saved meanwhile.

use crate::Editor;
use crate::editing::Editing;
use crate::effect::{Announcement, Look};
use behaviour::{Accepted, Change, Id, Record, RecordId};

/// From when the keyboard comes until it leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyboardStay {
    /// The program.
    pub behaviour: Id,
    /// The editor that holds the lock.
    number: u32,
    /// True if it was opened for this stay; one that was open already ends elsewhere.
    is_own: bool,
    /// The record when it began, for when another editor took the place of this one.
    seen: Option<Record>,
}

impl Editor {
    /// The keyboard came: what is typed into is locked, if it is there and nobody else is editing it.
    pub fn begin_typing(&mut self, record: &RecordId) -> Option<KeyboardStay> {
        let behaviour = (*self.open).clone()?;
        let seen = self.record(record);
        if seen.is_none() || self.me.refused.is_some() {
            return None;
        }
        let writes_here = |now: &Editing| now.behaviour == behaviour && now.record == *record && !now.reads();
        let open = self.edited(|now| writes_here(now).then_some(now.number)).flatten();
        let is_own = open.is_none();
        let number = open.unwrap_or_else(|| self.open_editor(record.clone()));
        if !is_own {
            self.change_editing(|now| now.seen.clone_from(&seen));
        }
        Some(KeyboardStay { behaviour, number, is_own, seen })
    }

    /// The keyboard left: others may edit it.
    pub fn end_typing(&mut self, stay: &KeyboardStay) {
        if stay.is_own {
            self.close_editor(stay.number);
        }
    }

    /// Returns the record as whoever types has seen it.
    #[must_use]
    pub fn seen(&self, stay: &KeyboardStay) -> Option<Record> {
        let seen = self.edited(|now| (now.number == stay.number).then(|| now.seen.clone())).flatten();
        seen.unwrap_or_else(|| stay.seen.clone())
    }

    /// A change of one's own waits or is saved: whoever goes on typing saw it.
    pub(crate) fn seen_now(&mut self, to: &Id, change: &Change) {
        self.change_editing(|now| {
            if let Some(after) = now.made_by(change).filter(|_| now.behaviour == *to) {
                now.seen = after.cloned();
            }
        });
    }

    /// A change of one's own was not made: whoever goes on typing sees what is there.
    pub(crate) fn seen_again(&mut self, change: &Change) {
        let about = self.edited(|now| now.made_by(change).map(|_| now.record.clone())).flatten();
        if let Some(record) = about {
            let there = self.record(&record);
            self.change_editing(|now| now.seen = there);
        }
    }

    /// A change was saved: of one's own nothing is said; who else changed what is typed into here is named.
    pub(crate) fn told_while_typing(&mut self, to: &Id, accepted: &Accepted) {
        let change = &accepted.change;
        if self.queue.all().any(|waiting| waiting.change.op == change.op) {
            return self.seen_now(to, change);
        }
        let is_told = |now: &Editing| {
            let after = now.made_by(change).filter(|_| now.behaviour == *to && !now.only_reads())?;
            (after != now.seen.as_ref()).then(|| after.is_none())
        };
        if let Some(removed) = self.edited(is_told).flatten() {
            let saver = self.saver(change);
            self.say(if removed {
                Announcement::RemovedWhileTyping(saver)
            } else {
                Announcement::ChangedWhileTyping(saver)
            });
        }
    }

    /// The program is here again after the link broke, and was at this revision before: who changed meanwhile what is typed
    /// into here is named, as if it had been heard.
    pub(crate) fn told_what_was_missed(&mut self, of: &Id, known: u64) {
        let typed = self.edited(|now| (now.behaviour == *of).then(|| (now.record.clone(), now.seen.clone()))).flatten();
        let Some((record, seen)) = typed else { return };
        if self.confirmed.records.get(&record) != seen.as_ref() {
            self.look_back(of.clone(), known, Look::WhileAway(record));
        }
    }
}
