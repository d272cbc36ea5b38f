//! Refused changes that wait for their author: found out who was first, kept over reloads, marked, decided.

use super::conflict::{
    CONFLICTS_MAX, Conflict, between, brought_back, is_late, is_shown_beside, is_worth_keeping, since_seen,
};
use super::propose::OnAnswer;
use super::queue::{SendMode, WaitingChange};
use super::{Document, UnsavedMark};
use crate::browser::Drawer;
use crate::desk::tab::{Dialog, new_id, set_if_new};
use crate::{link, words};
use behaviour::{Accepted, Behaviour, Change, FillFrom, Id, Kind, RecordId, Refusal, without_late_followers};
use leptos::prelude::*;
use protocol::{LIBRARY, Refused, Reply, Request};
use std::collections::BTreeSet;

const CONFLICTS_KEY: &str = "rrp.conflicts";
/// The number of changes back in which it is looked who was first.
const LOOK_BACK: u64 = 100;
/// The most pages of the log that are read for that.
const PAGES_MAX: u32 = 8;

type ConflictNext = Box<dyn FnOnce(Vec<Accepted>)>;

impl Document {
    /// A change came too late. If only otherwises were late that follow what it edits, it goes without them. Else it is
    /// found out who was first; then it is shown beside theirs, or it is said who it was.
    pub(super) fn came_late(&self, mut waiting: WaitingChange, no: Refusal, on_answer: OnAnswer) {
        if self.is_open(&waiting.behaviour) {
            let whole = waiting.change.edits.len();
            waiting.change = self.with_confirmed(|now| without_late_followers(now, waiting.change.clone()));
            let only_followers_were_late =
                waiting.change.edits.len() < whole && self.with_confirmed(|now| !is_late(&waiting.change, now));
            if only_followers_were_late {
                let was = waiting.change.op.clone();
                let again = Change { op: new_id(), ..waiting.change };
                self.retries_as(&was, &again.op);
                return self.propose_and(again, on_answer);
            }
        }
        let document = self.clone();
        self.look_back(waiting.behaviour.clone(), waiting.revision, move |log| {
            let theirs = since_seen(log, &waiting.change);
            if waiting.behaviour.as_str() != LIBRARY
                && is_shown_beside(&waiting.change, &no)
                && document.keeps(&waiting, &theirs)
            {
                return;
            }
            on_answer(Err(Refused::Change(no.clone())));
            if let (Refusal::Stale(what), Some(last)) = (&no, theirs.last()) {
                document.tab.say(&words::was_first(&document.called(&last.change), what), true);
            }
        });
    }

    /// Names the person who saved a change: *you*, if it was in another window.
    pub(crate) fn called(&self, change: &Change) -> String {
        let is_me =
            self.tab.me.with_untracked(|me| me.as_ref().is_some_and(|me| Some(&me.client) == change.by.as_ref()));
        if is_me { words::you_elsewhere().to_owned() } else { words::person_called(&change.author) }
    }

    /// Reads what was saved since some time before a revision, as far as it can be found out.
    pub(super) fn look_back(&self, behaviour: Id, revision: u64, then: impl FnOnce(Vec<Accepted>) + 'static) {
        let from = revision.saturating_sub(LOOK_BACK);
        read_log(behaviour, from, Vec::new(), PAGES_MAX, Box::new(then));
    }

    /// Keeps a refused change for its author; false if there is no room or nothing to decide.
    fn keeps(&self, waiting: &WaitingChange, theirs: &[Accepted]) -> bool {
        if !self.is_open(&waiting.behaviour) {
            return self.keeps_elsewhere(waiting, theirs);
        }
        let now = self.with_confirmed(Behaviour::clone);
        let is_there_already = |new: &Conflict| new.on_top(&now, self.change("")).edits.is_empty();
        let mut all = self.conflicts.get_untracked();
        if let Some(known) = all.iter_mut().find(|known| known.retry.as_ref() == Some(&waiting.change.op)) {
            (known.retry, known.again, known.theirs) = (None, !known.locked, theirs.to_vec());
            // What only waited is to be decided from now on.
            if std::mem::take(&mut known.locked) {
                (known.mine.edits, known.shown) = (waiting.change.edits.clone(), false);
                self.replace_its_editor(known);
            }
        } else if let Some(known) = all.iter_mut().find(|known| known.retry.is_none() && known.meets(&waiting.change)) {
            known.join(waiting.change.clone());
        } else if all.len() < CONFLICTS_MAX {
            let made = (waiting.made_ms, waiting.offline);
            let new = Conflict::of(waiting.behaviour.clone(), waiting.change.clone(), made, theirs.to_vec(), &now);
            let Some(new) = new else { return false };
            if is_there_already(&new) {
                return true;
            }
            self.replace_its_editor(&new);
            all.push(new);
        } else {
            return false;
        }
        self.set_conflicts(all);
        true
    }

    /// A change of a program that is not open any more waits until that is opened.
    fn keeps_elsewhere(&self, waiting: &WaitingChange, theirs: &[Accepted]) -> bool {
        let mut all = self.conflicts.get_untracked();
        let made = (waiting.made_ms, waiting.offline);
        let now = Behaviour::default();
        let new = Conflict::of(waiting.behaviour.clone(), waiting.change.clone(), made, theirs.to_vec(), &now);
        let Some(new) = new.filter(|_| all.len() < CONFLICTS_MAX) else { return false };
        all.push(new);
        self.set_conflicts(all);
        self.tab.say(words::waits_elsewhere(), true);
        true
    }

    /// A change touches a record that somebody is editing. One that was made without a connection, or that meets nothing but a
    /// lock of this page from before, is kept until that is free; gives it back if it is no such change.
    pub(super) fn waits_for_lock(&self, waiting: WaitingChange) -> Option<WaitingChange> {
        let mut all = self.conflicts.get_untracked();
        if let Some(known) = all.iter_mut().find(|known| known.retry.as_ref() == Some(&waiting.change.op)) {
            (known.retry, known.shown) = (None, known.shown && !known.locked);
            let waits = known.locked;
            self.set_conflicts(all);
            self.name_editors();
            return (!waits).then_some(waiting);
        }
        let is_others = self.other_editor(&waiting.change).is_some();
        let is_kept = waiting.way == SendMode::Propose && is_worth_keeping(&waiting.change);
        if !is_kept || is_others && !waiting.offline || all.len() >= CONFLICTS_MAX {
            return Some(waiting);
        }
        let (of, made) = (waiting.behaviour.clone(), (waiting.made_ms, waiting.offline));
        let new = self.with_confirmed(|now| Conflict::of(of, waiting.change.clone(), made, Vec::new(), now));
        let Some(new) = new else { return Some(waiting) };
        all.push(Conflict { locked: true, ..new });
        self.set_conflicts(all);
        self.name_editors();
        None
    }

    /// The name of somebody else who is editing something that a change touches, as far as this page knows by now.
    fn other_editor(&self, change: &Change) -> Option<String> {
        let mut edited = untrack(|| self.edited_by_others()).into_iter();
        edited.find(|(record, _)| change.edits.iter().any(|edit| edit.id == *record)).map(|(_, editor)| editor.name)
    }

    /// Names, once for each kept change, the person who is editing something that it touches.
    fn name_editors(&self) {
        let mut all = self.conflicts.get_untracked();
        let unnamed = all.iter_mut().filter(|kept| kept.locked && kept.retry.is_none() && !kept.shown);
        for kept in unnamed {
            if let Some(name) = self.other_editor(&kept.mine) {
                kept.shown = true;
                self.tab.say(&words::waits_until_free(&name), true);
            }
        }
        self.set_conflicts(all);
    }

    /// Proposes the kept changes of which nobody else is editing anything any more, and names who is editing the others.
    pub(super) fn propose_what_is_free(&self) {
        self.propose_kept(|kept| self.other_editor(&kept.mine).is_none());
        if self.conflicts.with_untracked(|all| all.iter().any(|kept| kept.locked)) {
            self.name_editors();
        }
    }

    /// Proposes all kept changes of the open program: after it was opened the server alone knows who is editing what.
    pub(super) fn propose_all_kept(&self) {
        self.propose_kept(|_| true);
    }

    fn propose_kept(&self, wanted: impl Fn(&Conflict) -> bool) {
        let mut all = self.conflicts.get_untracked();
        let is_due =
            |kept: &&mut Conflict| kept.locked && kept.retry.is_none() && self.is_open(&kept.behaviour) && wanted(kept);
        let mut proposed = Vec::new();
        for kept in all.iter_mut().filter(is_due) {
            let again = Change { op: new_id(), ..kept.mine.clone() };
            kept.retry = Some(again.op.clone());
            proposed.push((kept.clone(), again));
        }
        if proposed.is_empty() {
            return;
        }
        self.set_conflicts(all);
        for (kept, again) in proposed {
            let (document, mine) = (self.clone(), kept.mine.op);
            self.queue_made(kept.behaviour, again, (kept.made_ms, kept.offline), move |answer| {
                if answer.is_err() {
                    document.drop_conflict(&mine);
                    document.tab.say_refusal(answer);
                }
            });
        }
    }

    /// The editor in which the change was made gives its place to the comparison.
    fn replace_its_editor(&self, conflict: &Conflict) {
        let output = |connector: &Id| {
            self.connector(connector).map(|signals| signals.record.with_untracked(|at| at.output.clone()))
        };
        let is_its = |dialog: &Dialog| match dialog {
            Dialog::Operation { connector: Some(connector), .. } => {
                conflict.edits(connector) || output(connector).is_some_and(|output| conflict.edits(&output))
            }
            Dialog::Operation { connector: None, input, .. } => conflict.is_new() && conflict.rests_on(input),
            Dialog::EditStream(stream) => conflict.edits(stream),
            Dialog::Programs | Dialog::RenameProgram => conflict.about.kind == Kind::Settings,
            _ => false,
        };
        if self.tab.dialog.with_untracked(|dialog| dialog.as_ref().is_some_and(is_its)) {
            self.tab.dialog.set(Some(Dialog::Conflict(conflict.mine.op.clone())));
        }
    }

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
        let mut all = self.conflicts.get_untracked();
        if let Some(shown) = all.iter_mut().find(|conflict| conflict.mine.op == *op && !conflict.shown) {
            shown.shown = true;
            self.set_conflicts(all);
        }
    }

    /// Puts one's own on top of what there is now; `on_no` hears why that cannot be.
    pub(crate) fn keep_mine(&self, op: &Id, on_no: impl FnOnce(Refused) + 'static) {
        let mut all = self.conflicts.get_untracked();
        let Some(conflict) = all.iter_mut().find(|conflict| conflict.mine.op == *op && conflict.retry.is_none()) else {
            return;
        };
        let top = conflict.on_top(&self.behaviour(), self.change(&conflict.mine.label));
        if top.edits.is_empty() {
            return self.drop_conflict(op);
        }
        (conflict.retry, conflict.again) = (Some(top.op.clone()), false);
        self.set_conflicts(all);
        let (document, mine, retry) = (self.clone(), op.clone(), top.op.clone());
        self.propose_and(top, move |answer| match answer {
            Ok(()) => document.conflict_saved(&retry),
            Err(no) => {
                document.not_on_top(&mine);
                on_no(no);
            }
        });
    }

    /// A change under way that puts one's own on top, or that was kept, goes under another name.
    fn retries_as(&self, was: &Id, now: &Id) {
        let mut all = self.conflicts.get_untracked();
        if let Some(conflict) = all.iter_mut().find(|conflict| conflict.retry.as_ref() == Some(was)) {
            conflict.retry = Some(now.clone());
            self.set_conflicts(all);
        }
    }

    /// It could not be put on top, and waits again.
    fn not_on_top(&self, op: &Id) {
        let mut all = self.conflicts.get_untracked();
        if let Some(conflict) = all.iter_mut().find(|conflict| conflict.mine.op == *op) {
            conflict.retry = None;
        }
        self.set_conflicts(all);
    }

    /// A change was saved: what it decided waits no more.
    pub(super) fn conflict_saved(&self, retry: &Id) {
        let decided = self.conflicts.with_untracked(|all| {
            all.iter().find(|conflict| conflict.retry.as_ref() == Some(retry)).map(|conflict| conflict.mine.op.clone())
        });
        if let Some(op) = decided {
            self.drop_conflict(&op);
        }
    }

    /// Drops one's own change; the one that others saved stays.
    pub(crate) fn drop_conflict(&self, op: &Id) {
        let mut all = self.conflicts.get_untracked();
        for dropped in all.extract_if(.., |conflict| conflict.mine.op == *op) {
            Drawer::Tab.drop(&draft_key(&dropped.about.id));
        }
        self.set_conflicts(all);
    }

    /// Brings back what somebody removed under an open editor; `then` hears whether it is there again.
    pub(crate) fn bring_back(&self, record: RecordId, then: impl FnOnce(Result<(), Refused>) + 'static) {
        let Some(open) = self.open.get_untracked() else { return };
        let document = self.clone();
        self.look_back(open, self.revision.get_untracked(), move |log| {
            let now = document.with_confirmed(Behaviour::clone);
            let is_missing = |whole: &Behaviour| -> BTreeSet<RecordId> {
                [record.clone()].into_iter().filter(|id| !whole.records.contains_key(id)).filled()
            };
            let back = between(&now, &brought_back(&now, &log, is_missing), document.change(words::bring_back()));
            if back.edits.is_empty() && !now.records.contains_key(&record) {
                return then(Err(Refused::Change(Refusal::Gone)));
            }
            document.propose_and(back, then);
        });
    }

    /// Finds out who changed something last, and when; `then` hears nothing if that is too long ago.
    pub(crate) fn find_last_change(&self, record: RecordId, then: impl FnOnce(String, f64) + 'static) {
        let Some(open) = self.open.get_untracked() else { return };
        let document = self.clone();
        self.look_back(open, self.revision.get_untracked(), move |log| {
            let touches = |accepted: &&Accepted| accepted.change.edits.iter().any(|edit| edit.id == record);
            if let Some(last) = log.iter().rev().find(touches) {
                then(document.called(&last.change), last.change.at_ms as f64);
            }
        });
    }

    /// Finds out who removed something, if it was not heard here.
    pub(crate) fn find_remover(&self, id: Id) {
        let Some(open) = self.open.get_untracked() else { return };
        let document = self.clone();
        self.look_back(open, self.revision.get_untracked(), move |log| {
            let removes = |accepted: &&Accepted| {
                accepted
                    .change
                    .edits
                    .iter()
                    .any(|edit| edit.after.is_none() && edit.id.id == id && edit.id.kind != Kind::Place)
            };
            if let Some(removal) = log.iter().rev().find(removes) {
                document.note_removed(removal);
            }
        });
    }

    /// Takes up what waited before the page was loaded again.
    pub(in crate::desk) fn restore_conflicts(&self) {
        let kept = Drawer::Tab.get(CONFLICTS_KEY).and_then(|text| crate::json::read::<Vec<Conflict>>(&text).ok());
        let Some(mut kept) = kept else { return };
        {
            let state = self.state();
            let waits = |op: &Id| state.queue.all().any(|waiting| waiting.change.op == *op);
            kept.iter_mut().for_each(|conflict| conflict.retry = conflict.retry.take().filter(waits));
        }
        self.set_conflicts(kept);
    }

    fn set_conflicts(&self, all: Vec<Conflict>) {
        match serde_json::to_string(&all) {
            Ok(text) if !all.is_empty() => Drawer::Tab.put(CONFLICTS_KEY, &text),
            Ok(_) | Err(_) => Drawer::Tab.drop(CONFLICTS_KEY),
        }
        set_if_new(&self.conflicts, all);
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
    pub(crate) fn waiting(&self) -> Vec<(String, bool)> {
        let state = self.state();
        let is_here = |behaviour: &Id| state.wanted.as_ref() == Some(behaviour);
        state.queue.all().map(|waiting| (waiting.change.label.clone(), is_here(&waiting.behaviour))).collect()
    }

    /// Marks what waits to be sent while the page says that it waits.
    pub(super) fn show_waits(&self) {
        let waits: BTreeSet<RecordId> = {
            let state = self.state();
            match &state.wanted {
                Some(open) if !state.saves.can_save() => state.queue.touched(open).into_iter().filled(),
                _ => BTreeSet::new(),
            }
        };
        set_if_new(&self.waits, waits);
    }
}

/// Returns the key under which the unsaved text about something is kept.
pub(crate) fn draft_key(about: &Id) -> String {
    format!("rrp.draft.{about}")
}

/// Reads the log of a behaviour after a revision, page after page.
fn read_log(behaviour: Id, revision: u64, mut found: Vec<Accepted>, pages: u32, then: ConflictNext) {
    let again = behaviour.clone();
    link::ask_even_down(Request::Since { behaviour, revision }, move |reply| match reply {
        Some(Reply::Missed { changes, more, .. }) => {
            found.extend(changes.iter().cloned());
            match changes.last() {
                Some(last) if *more && pages > 1 => read_log(again, last.revision, found, pages - 1, then),
                Some(_) | None => then(found),
            }
        }
        Some(_) | None => then(found),
    });
}
