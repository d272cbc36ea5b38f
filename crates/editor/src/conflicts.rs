//! Refused changes that wait for their author: found out who was first, kept over reloads, marked, decided.

use crate::Editor;
use crate::conflict::{CONFLICTS_MAX, Conflict, between, brought_back, is_worth_keeping};
use crate::effect::{AlarmPurpose, Announcement, Effect, LogReader, Look, Purpose};
use crate::queue::{SendMode, WaitingChange};
use behaviour::{Accepted, Behaviour, Change, FillFrom, Id, Kind, RecordId, Refusal};
use protocol::{Refused, answer, request};
use std::collections::BTreeSet;

/// The number of changes back in which it is looked who was first.
const LOOK_BACK: u64 = 100;
/// The time until a change is proposed again that an unknown lock kept out.
const FREE_MS: i32 = 2_000;
/// The most pages of the log that are read for that.
const PAGES_MAX: u32 = 8;

impl Editor {
    /// Reads what was saved since some time before a revision, as far as it can be found out.
    pub(crate) fn look_back(&mut self, behaviour: Id, revision: u64, look: Look) {
        let reader = LogReader { behaviour, found: Vec::new(), pages: PAGES_MAX, look };
        self.read_log(reader, revision.saturating_sub(LOOK_BACK));
    }

    fn read_log(&mut self, reader: LogReader, revision: u64) {
        let request = request::Since { behaviour: reader.behaviour.clone(), revision };
        self.ask(request, Purpose::Log(Box::new(reader)));
    }

    /// A page of the log came, or none: it is read on, or what was found is used.
    pub(crate) fn log_answered(&mut self, mut reader: LogReader, newer: Option<answer::Newer>) {
        if let Some(answer::Newer::Missed(answer::Missed { changes, more, .. })) = newer {
            let last = changes.last().map(|last| last.revision);
            reader.found.extend(changes);
            if let Some(last) = last
                && more
                && reader.pages > 1
            {
                reader.pages -= 1;
                return self.read_log(reader, last);
            }
        }
        let LogReader { behaviour, found, look, .. } = reader;
        match look {
            Look::WasFirst(op) => self.found_who_was_first(&op, found),
            Look::WhileAway(record) => {
                if let Some(last) = last_of(&found, &record) {
                    self.told_while_typing(&behaviour, last);
                }
            }
            Look::BringBack(record, start) => self.bring_back_found(&record, *start, &found),
            Look::LastChange(record, number) => {
                let last = last_of(&found, &record).map(|last| (self.saver(&last.change), last.change.at_ms));
                self.effect(Effect::LastChange(number, last));
            }
            Look::Remover(id) => {
                let removes = |accepted: &&Accepted| {
                    let mut edits = accepted.change.edits.iter();
                    edits.any(|edit| edit.after.is_none() && edit.id.id == id && edit.id.kind != Kind::Place)
                };
                if let Some(removal) = found.iter().rev().find(removes) {
                    self.note_removed(removal);
                }
            }
        }
    }

    /// Keeps a refused change for its author; false if there is no room or nothing to decide.
    pub(crate) fn keeps(&mut self, waiting: &WaitingChange, theirs: &[Accepted]) -> bool {
        if !self.is_open(&waiting.behaviour) {
            return self.keeps_elsewhere(waiting, theirs);
        }
        let mut all = (*self.conflicts).clone();
        if let Some(known) = all.iter_mut().find(|known| known.retry.as_ref() == Some(&waiting.change.op)) {
            (known.retry, known.again, known.theirs) = (None, !known.locked, theirs.to_vec());
            // The author decides from now on about a change that only waited.
            if std::mem::take(&mut known.locked) {
                (known.mine.edits, known.shown) = (waiting.change.edits.clone(), false);
                self.effect(Effect::Decide(Box::new(known.clone())));
            }
        } else if let Some(known) = all.iter_mut().find(|known| known.retry.is_none() && known.meets(&waiting.change)) {
            known.join(waiting.change.clone());
        } else if all.len() < CONFLICTS_MAX {
            let Some(new) = self.conflict_of(waiting, theirs) else { return false };
            let empty = self.change("");
            if new.on_top(&self.confirmed, empty, self.follow).edits.is_empty() {
                return true;
            }
            self.effect(Effect::Decide(Box::new(new.clone())));
            all.push(new);
        } else {
            return false;
        }
        self.set_conflicts(all);
        true
    }

    /// A refused change beside what is there now.
    fn conflict_of(&self, waiting: &WaitingChange, theirs: &[Accepted]) -> Option<Conflict> {
        let nothing = Behaviour::default();
        let now = if self.is_open(&waiting.behaviour) { &self.confirmed } else { &nothing };
        let made = (waiting.made_ms, waiting.offline);
        Conflict::of(waiting.behaviour.clone(), waiting.change.clone(), made, theirs.to_vec(), now)
    }

    /// A change of a program that is not open any more waits until that is opened.
    fn keeps_elsewhere(&mut self, waiting: &WaitingChange, theirs: &[Accepted]) -> bool {
        let mut all = (*self.conflicts).clone();
        let new = self.conflict_of(waiting, theirs);
        let Some(new) = new.filter(|_| all.len() < CONFLICTS_MAX) else { return false };
        all.push(new);
        self.set_conflicts(all);
        self.say(Announcement::WaitsElsewhere);
        true
    }

    /// A change touches a record that somebody is editing. One that was made without a connection, or that meets nothing but a
    /// lock of this page from before, is kept until that is free; gives it back if it is no such change.
    pub(crate) fn waits_for_lock(&mut self, waiting: WaitingChange) -> Option<WaitingChange> {
        let mut all = (*self.conflicts).clone();
        if let Some(known) = all.iter_mut().find(|known| known.retry.as_ref() == Some(&waiting.change.op)) {
            (known.retry, known.shown) = (None, known.shown && !known.locked);
            let waits = known.locked;
            self.set_conflicts(all);
            self.ask_whether_free(&waiting.change);
            return (!waits).then_some(waiting);
        }
        let is_others = self.other_editor(&waiting.change).is_some();
        let is_kept = waiting.way == SendMode::Propose
            && is_worth_keeping(&waiting.change)
            && !self.only_moves_tiles(&waiting.change);
        if !is_kept || is_others && !waiting.offline || all.len() >= CONFLICTS_MAX {
            return Some(waiting);
        }
        let (of, made) = (waiting.behaviour.clone(), (waiting.made_ms, waiting.offline));
        let Some(new) = Conflict::of(of, waiting.change.clone(), made, Vec::new(), &self.confirmed) else {
            return Some(waiting);
        };
        all.push(Conflict { locked: true, ..new });
        self.set_conflicts(all);
        self.ask_whether_free(&waiting.change);
        None
    }

    /// Names who is editing what a kept change touches. As far as this page knows that may be nobody, any more or yet: then it
    /// is proposed again in a moment, as no news of that lock may come.
    fn ask_whether_free(&mut self, kept: &Change) {
        self.name_editors();
        if self.other_editor(kept).is_none() {
            self.effect(Effect::After(FREE_MS, AlarmPurpose::Free));
        }
    }

    /// The name of somebody else who is editing something that a change touches, as far as this page knows by now.
    fn other_editor(&self, change: &Change) -> Option<&str> {
        let mut edited = self.edited_by_others();
        let found = edited.find(|(record, _)| change.edits.iter().any(|edit| edit.id == **record));
        found.map(|(_, lock)| lock.name.as_str())
    }

    /// Names, once for each kept change, the person who is editing something that it touches.
    fn name_editors(&mut self) {
        let mut all = (*self.conflicts).clone();
        let mut named = Vec::new();
        for kept in all.iter_mut().filter(|kept| kept.locked && kept.retry.is_none() && !kept.shown) {
            if let Some(name) = self.other_editor(&kept.mine) {
                kept.shown = true;
                named.push(name.to_owned());
            }
        }
        named.into_iter().for_each(|name| self.say(Announcement::WaitsUntilFree(name)));
        self.set_conflicts(all);
    }

    /// Proposes the kept changes of which nobody else is editing anything any more, and names who is editing the others.
    pub(crate) fn propose_what_is_free(&mut self) {
        self.propose_kept(false);
        if self.conflicts.iter().any(|kept| kept.locked) {
            self.name_editors();
        }
    }

    /// Proposes all kept changes of the open program: after it was opened the server alone knows who is editing what.
    pub(crate) fn propose_all_kept(&mut self) {
        self.propose_kept(true);
    }

    fn propose_kept(&mut self, even_edited: bool) {
        let waiting = self.conflicts.iter().filter(|kept| kept.locked && kept.retry.is_none());
        let is_meant = |kept: &&Conflict| {
            self.is_open(&kept.behaviour) && (even_edited || self.other_editor(&kept.mine).is_none())
        };
        let meant: Vec<Conflict> = waiting.filter(is_meant).cloned().collect();
        for kept in meant {
            // It stays kept until what waits before it is saved.
            if !self.queue.has_room_for(&kept.mine) {
                return self.effect(Effect::After(FREE_MS, AlarmPurpose::Free));
            }
            self.propose_again(kept);
        }
    }

    fn propose_again(&mut self, kept: Conflict) {
        let again = Change { op: self.next_id(), ..kept.mine.clone() };
        let mut all = (*self.conflicts).clone();
        if let Some(known) = all.iter_mut().find(|known| known.mine.op == kept.mine.op) {
            known.retry = Some(again.op.clone());
        }
        self.set_conflicts(all);
        let made = (*self.revision, kept.made_ms, kept.offline);
        self.queue_made(kept.behaviour, (again, SendMode::Propose), made);
    }

    /// It is shown now; put off, it only waits.
    pub fn conflict_shown(&mut self, op: &Id) {
        let mut all = (*self.conflicts).clone();
        if let Some(shown) = all.iter_mut().find(|conflict| conflict.mine.op == *op && !conflict.shown) {
            shown.shown = true;
            self.set_conflicts(all);
        }
    }

    /// Puts one's own on top of what there is now, as the change of this name.
    pub fn keep_mine(&mut self, op: &Id, top: Id) {
        let mut all = (*self.conflicts).clone();
        let Some(conflict) = all.iter_mut().find(|conflict| conflict.mine.op == *op && conflict.retry.is_none()) else {
            return self.tell_nobody(&top);
        };
        let start = Change::of(top, &self.me.name, &conflict.mine.label);
        let top = conflict.on_top(&self.behaviour(), start, self.follow);
        if top.edits.is_empty() {
            self.drop_conflict(op);
            return self.tell_nobody(&top.op);
        }
        (conflict.retry, conflict.again) = (Some(top.op.clone()), false);
        self.set_conflicts(all);
        self.propose(top);
    }

    /// It could not be put on top, and waits again.
    pub(crate) fn not_on_top(&mut self, op: &Id) {
        let mut all = (*self.conflicts).clone();
        if let Some(conflict) = all.iter_mut().find(|conflict| conflict.mine.op == *op) {
            conflict.retry = None;
        }
        self.set_conflicts(all);
    }

    /// A change was saved: what it decided waits no more.
    pub(crate) fn conflict_saved(&mut self, retry: &Id) {
        let decided = self.conflicts.iter().find(|conflict| conflict.retry.as_ref() == Some(retry));
        if let Some(op) = decided.map(|conflict| conflict.mine.op.clone()) {
            self.drop_conflict(&op);
        }
    }

    /// Drops one's own change; the one that others saved stays.
    pub fn drop_conflict(&mut self, op: &Id) {
        let mut all = (*self.conflicts).clone();
        let dropped: Vec<Conflict> = all.extract_if(.., |conflict| conflict.mine.op == *op).collect();
        dropped.into_iter().for_each(|dropped| self.effect(Effect::ForgetDraft(dropped.about.id)));
        self.set_conflicts(all);
    }

    /// Brings back what somebody removed under an open editor, by this change, which is empty still.
    pub fn bring_back(&mut self, record: RecordId, start: Change) {
        match (*self.open).clone() {
            Some(open) => self.look_back(open, *self.revision, Look::BringBack(record, Box::new(start))),
            None => self.tell_nobody(&start.op),
        }
    }

    fn bring_back_found(&mut self, record: &RecordId, start: Change, log: &[Accepted]) {
        let now = &self.confirmed;
        let is_missing = |whole: &Behaviour| -> BTreeSet<RecordId> {
            [record.clone()].into_iter().filter(|id| !whole.records.contains_key(id)).filled()
        };
        let back = between(now, &brought_back(now, log, is_missing), start);
        if back.edits.is_empty() && !now.records.contains_key(record) {
            return self.tell(&back.op, Err(Refused::Change(Refusal::Gone)));
        }
        self.propose(back);
    }

    /// Finds out who changed something last, and when; nothing is told if that is too long ago.
    pub fn find_last_change(&mut self, record: RecordId, number: u32) {
        match (*self.open).clone() {
            Some(open) => self.look_back(open, *self.revision, Look::LastChange(record, number)),
            None => self.effect(Effect::LastChange(number, None)),
        }
    }

    /// Finds out who removed something, if it was not heard here.
    pub fn find_remover(&mut self, id: Id) {
        if let Some(open) = (*self.open).clone() {
            self.look_back(open, *self.revision, Look::Remover(id));
        }
    }

    /// Takes up what waited before the page was loaded again.
    pub fn restore_conflicts(&mut self, mut kept: Vec<Conflict>) {
        let waits = |op: &Id| self.queue.all().any(|waiting| waiting.change.op == *op);
        kept.iter_mut().for_each(|conflict| conflict.retry = conflict.retry.take().filter(waits));
        self.set_conflicts(kept);
    }

    pub(crate) fn set_conflicts(&mut self, all: Vec<Conflict>) {
        self.effect(Effect::KeepConflicts);
        self.conflicts.set(all);
    }
}

/// The last change that touches a record.
fn last_of<'a>(log: &'a [Accepted], record: &RecordId) -> Option<&'a Accepted> {
    log.iter().rev().find(|accepted| accepted.change.edits.iter().any(|edit| edit.id == *record))
}
