//! Refused changes on their way into the hands of their authors: one after another, in the order in which they were refused,
//! as the later one of two was made on top of the earlier. Meanwhile the queue has them, and keeps them over a reload.

use crate::Editor;
use crate::conflict::{is_late, is_shown_beside, only_moves_tiles, since_seen};
use crate::effect::{Announcement, Effect, Look};
use crate::queue::{LateChange, SendMode, WaitingChange};
use behaviour::{Accepted, Change, Id, Pad, Record, RecordId, Refusal, without_late_followers};
use protocol::{LIBRARY, Refused};

impl Editor {
    /// A change came too late. If only otherwises were late that follow what it edits, it goes without them. Else it is
    /// found out who was first; then it is shown beside theirs, or it is said who it was.
    pub(crate) fn came_late(&mut self, mut waiting: WaitingChange, no: Refusal) {
        if self.is_open(&waiting.behaviour) {
            let whole = waiting.change.edits.len();
            waiting.change = without_late_followers(&self.confirmed, waiting.change);
            if waiting.change.edits.len() < whole && !is_late(&waiting.change, &self.confirmed) {
                let was = waiting.change.op.clone();
                let again = Change { op: self.next_id(), ..waiting.change };
                self.rename(&was, &again.op);
                return self.propose(again);
            }
        }
        self.queue.keep_late(waiting, no);
        self.look_who_was_first();
    }

    /// A change touches a record that somebody is editing. Returns true if that is told, and false if the change waits.
    pub(crate) fn came_under_lock(&mut self, waiting: WaitingChange, no: Refusal) -> bool {
        if !self.queue.late().is_empty() && waiting.way == SendMode::Propose {
            self.queue.keep_late(waiting, no);
            return false;
        }
        self.wait_or_tell(waiting, no)
    }

    fn wait_or_tell(&mut self, waiting: WaitingChange, no: Refusal) -> bool {
        let op = waiting.change.op.clone();
        let told = self.waits_for_lock(waiting).is_some();
        if told {
            self.tell(&op, Err(Refused::Change(no)));
        } else {
            self.tell_nobody(&op);
        }
        told
    }

    /// Goes on with the first refused change, if that is not under way: the log says who was before it.
    fn look_who_was_first(&mut self) {
        while !self.looks_who_was_first
            && let Some(LateChange { waiting, no }) = self.queue.late().front().cloned()
        {
            if let Refusal::Locked { .. } = no {
                self.queue.take_late(&waiting.change.op);
                self.wait_or_tell(waiting, no);
                self.effect(Effect::KeepQueue);
                continue;
            }
            self.looks_who_was_first = true;
            self.look_back(waiting.behaviour, waiting.revision, Look::WasFirst(waiting.change.op));
        }
    }

    /// The log was read as far as it can be: the first refused change is given to its author, and the next one is looked at.
    pub(crate) fn found_who_was_first(&mut self, op: &Id, log: Vec<Accepted>) {
        self.looks_who_was_first = false;
        // The program of the change may be gone by now.
        if let Some(LateChange { waiting, no }) = self.queue.take_late(op) {
            self.give_to_author(&waiting, no, log);
        }
        self.effect(Effect::KeepQueue);
        self.look_who_was_first();
    }

    /// A refused change is shown beside what was first, or it is said who that was.
    fn give_to_author(&mut self, waiting: &WaitingChange, no: Refusal, log: Vec<Accepted>) {
        if let Some(merged) = self.beside_other_tiles(waiting) {
            self.rename(&waiting.change.op, &merged.op);
            return self.propose(merged);
        }
        let theirs = since_seen(log, &waiting.change);
        let op = waiting.change.op.clone();
        let may_be_kept = waiting.behaviour.as_str() != LIBRARY
            && is_shown_beside(&waiting.change, &no)
            && !self.only_moves_tiles(&waiting.change);
        if may_be_kept && self.keeps(waiting, &theirs) {
            return self.tell_nobody(&op);
        }
        self.tell(&op, Err(Refused::Change(no.clone())));
        if let (Refusal::Stale(what), Some(last)) = (no, theirs.last()) {
            let saver = self.saver(&last.change);
            self.say(Announcement::WasFirst(saver, what));
        }
    }

    /// True if a change only puts tiles in other places, which is small enough to be made anew.
    pub(crate) fn only_moves_tiles(&self, change: &Change) -> bool {
        let is_decided = self.conflicts.iter().any(|conflict| conflict.retry.as_ref() == Some(&change.op));
        !is_decided && only_moves_tiles(change, || (self.usual_pad)(&self.confirmed))
    }

    /// Returns the change of tiles anew beside what others made of other tiles meanwhile; none if both changed the same one.
    fn beside_other_tiles(&mut self, waiting: &WaitingChange) -> Option<Change> {
        let is_meant = waiting.way == SendMode::Propose && self.is_open(&waiting.behaviour);
        let [edit] = waiting.change.edits.as_slice() else { return None };
        let (Some(Record::Pad(mine)), Some(theirs), true) = (&edit.after, self.confirmed.pad(), is_meant) else {
            return None;
        };
        let seen = match &edit.before {
            Some(Record::Pad(seen)) => seen.clone(),
            _ => (self.usual_pad)(&self.confirmed),
        };
        let merged = Pad::merged(&seen, mine, theirs)?;
        let start = Change { op: self.next_id(), edits: Vec::new(), ..waiting.change.clone() };
        Some(start.put(&self.confirmed, RecordId::pad(), Record::Pad(merged)))
    }

    /// A change goes on under another name.
    fn rename(&mut self, was: &Id, now: &Id) {
        let mut all = (*self.conflicts).clone();
        if let Some(conflict) = all.iter_mut().find(|conflict| conflict.retry.as_ref() == Some(was)) {
            conflict.retry = Some(now.clone());
            self.set_conflicts(all);
        }
        self.goes_on_as(was, now);
    }
}
