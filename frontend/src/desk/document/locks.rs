//! Locks: who else is editing what, and the lock of what is edited here. They are for people; data is kept whole by
//! comparing, so that whoever is offline edits without one.

use super::editing::{Asking, Editing, WriteRight};
use super::queue::WaitingChange;
use super::{Document, DocumentFields};
use crate::desk::tab::set_if_new;
use crate::{browser, link};
use behaviour::{AskResult, Grant, Id, LockEvent, LockToken, RecordId, Refusal};
use leptos::prelude::*;
use protocol::{LockShown, Refused, Reply, Request};
use std::collections::BTreeSet;

/// The least time between two messages that somebody types, in milliseconds.
const TYPING_MS: f64 = 1_000.0;

/// Somebody else who is editing something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct OtherEditor {
    pub(crate) name: String,
    /// The number of the colour, of the eight for people.
    pub(crate) color: u8,
}

impl DocumentFields {
    fn my_client(&self) -> Option<Id> {
        self.tab.me.with_untracked(|me| me.as_ref().map(|me| me.client.clone()))
    }

    pub(super) fn change_editing(&self, act: impl FnOnce(&mut Editing)) {
        let changed = self.editing.with_untracked(|now| {
            let mut new = now.clone()?;
            act(&mut new);
            Some(new).filter(|new| Some(new) != now.as_ref())
        });
        if changed.is_some() {
            self.editing.set(changed);
        }
    }

    pub(super) fn edited<T>(&self, look: impl FnOnce(&Editing) -> T) -> Option<T> {
        self.editing.with_untracked(|editing| editing.as_ref().map(look))
    }
}

impl Document {
    /// Returns what others are editing, each with who does. Reactive.
    pub(crate) fn edited_by_others(&self) -> Vec<(RecordId, OtherEditor)> {
        let me = self.tab.me.with(|me| me.as_ref().map(|me| me.client.clone()));
        let people = self.people.get();
        let color =
            |client: &Id| people.iter().find(|person| person.client == *client).map_or(0, |person| person.color);
        let locks = self.locks.get().into_iter().filter(|lock| Some(&lock.client) != me.as_ref());
        let records = locks.flat_map(|lock| {
            let editor = OtherEditor { color: color(&lock.client) % 8, name: lock.name };
            lock.records.into_iter().map(move |record| (record, editor.clone()))
        });
        records.collect()
    }

    /// Returns the other person who is editing a record. Reactive.
    pub(crate) fn editor_of(&self, record: &RecordId) -> Option<OtherEditor> {
        self.edited_by_others().into_iter().find(|(edited, _)| edited == record).map(|(_, editor)| editor)
    }

    /// An editor is opened here: its lock is asked for, and that of the one before it is given back. Answers with the
    /// number that ends it.
    pub(crate) fn open_editor(&self, record: RecordId) -> u32 {
        let before = self.edited(|now| now.number);
        before.into_iter().for_each(|before| self.close_editor(before));
        let (number, seen) = {
            let mut state = self.state();
            state.editors = state.editors.wrapping_add(1);
            (state.editors, state.record(&record))
        };
        let by = untrack(|| self.editor_of(&record)).map(|editor| editor.name);
        if let Some(behaviour) = self.open.get_untracked() {
            self.editing.set(Some(Editing::open(number, behaviour, (record, seen), by)));
            self.take_lock();
        }
        number
    }

    /// An editor was closed: what it locked is free.
    pub(crate) fn close_editor(&self, number: u32) {
        let waits = {
            let state = self.state();
            self.awaits_lock(state.queue.all().next())
        };
        if waits && self.edited(|now| now.number) == Some(number) {
            // What was typed is sent with the lock first, which ends then.
            self.change_editing(|now| now.is_over = true);
            return;
        }
        let closed = self.editing.with_untracked(|now| now.clone().filter(|now| now.number == number));
        let Some(closed) = closed else { return };
        self.editing.set(None);
        if let Some(token) = closed.token() {
            unlock(closed.behaviour, token);
        }
    }

    /// Asks for the lock of what is edited here.
    pub(crate) fn take_lock(&self) {
        let Some((number, behaviour, record)) = self.edited(|at| (at.number, at.behaviour.clone(), at.record.clone()))
        else {
            return;
        };
        let document = self.clone();
        let asked = Request::Lock { behaviour, records: BTreeSet::from([record]) };
        // A grant is heard by whoever hears everything, as it also comes unasked.
        link::ask_even_down(asked, move |reply| document.lock_answered(number, reply));
    }

    fn lock_answered(&self, number: u32, reply: Option<&Reply>) {
        if self.edited(|now| now.number) != Some(number) {
            return;
        }
        match reply {
            Some(Reply::No { no: Refused::Change(Refusal::Locked { by, .. }) }) => {
                self.change_editing(|now| now.denied(by));
            }
            Some(Reply::No { .. }) | None => self.change_editing(Editing::not_locked),
            Some(_) => {}
        }
        self.go_on_after_lock();
    }

    /// The lock is given or not: what waited for that is sent, and an editor that was left meanwhile ends.
    fn go_on_after_lock(&self) {
        self.pump();
        if let Some(number) = self.edited(|now| now.is_over.then_some(now.number)).flatten() {
            self.close_editor(number);
        }
    }

    /// A lock was given, asked or unasked. One that nobody here wants any more is given back.
    pub(in crate::desk) fn hear_grant(&self, grant: &Grant) {
        let mut is_wanted = false;
        self.change_editing(|now| is_wanted = now.granted(grant));
        if let (false, Some(open)) = (is_wanted, self.open.get_untracked()) {
            unlock(open, grant.token);
        }
        if is_wanted {
            self.go_on_after_lock();
        }
    }

    /// Everyone is told who is editing what.
    pub(in crate::desk) fn hear_locks(&self, of: &Id, locks: Vec<LockShown>) {
        if self.is_wanted(of) {
            let me = self.my_client();
            self.change_editing(|now| now.shown(&locks, me.as_ref()));
            set_if_new(&self.locks, locks);
            self.propose_what_is_free();
        }
    }

    /// Something happened to a lock that is held or wanted here.
    pub(in crate::desk) fn hear_lock_event(&self, of: &Id, now_ms: u64, event: &LockEvent) {
        if let LockEvent::Granted { grant, .. } = event {
            self.hear_grant(grant);
        } else if self.edited(|now| now.behaviour == *of).unwrap_or_default() {
            let at = on_page_clock(now_ms);
            self.change_editing(|now| now.hear(event, at));
        }
        self.tick_lock();
    }

    /// The link broke: nothing is locked as far as this page knows.
    pub(super) fn forget_locks(&self) {
        self.change_editing(Editing::link_lost);
    }

    /// After the link was made anew: what is being edited is locked again, if it is there still.
    pub(super) fn lock_again(&self) {
        let record = self.edited(|now| now.record.clone()).filter(|_| self.edits_freely());
        let is_there = record.is_some_and(|record| self.with_confirmed(|whole| whole.records.contains_key(&record)));
        if is_there {
            // The text that was typed meanwhile is sent with that lock.
            self.change_editing(|now| now.writing = WriteRight::Opening);
            self.take_lock();
        }
    }

    fn edits_freely(&self) -> bool {
        self.edited(|now| now.writing == WriteRight::Free).unwrap_or_default()
    }

    /// True if this change is about what is typed into here, and the lock of that is asked for and not answered yet.
    pub(super) fn awaits_lock(&self, next: Option<&WaitingChange>) -> bool {
        let awaits = |now: &Editing, next: &WaitingChange| {
            now.writing == WriteRight::Opening && now.behaviour == next.behaviour && now.made_by(&next.change).is_some()
        };
        next.is_some_and(|next| self.edited(|now| awaits(now, next)) == Some(true))
    }

    /// The tokens that go with a change of a behaviour.
    pub(super) fn tokens(&self, behaviour: &Id) -> Vec<LockToken> {
        let token = self.edited(|now| now.token().filter(|_| now.behaviour == *behaviour));
        token.flatten().into_iter().collect()
    }

    /// Somebody types in the editor here; told at most once a second.
    pub(crate) fn typing(&self) {
        if self.edited(Editing::is_free_again) == Some(true) {
            self.take_lock();
        }
        let Some((behaviour, Some(token))) = self.edited(|now| (now.behaviour.clone(), now.token())) else { return };
        self.change_editing(|now| now.own(|own| own.free_ms = None));
        if self.typing_is_due() {
            link::tell(Request::Typing { behaviour, token });
        }
    }

    fn typing_is_due(&self) -> bool {
        let (now_ms, mut state) = (browser::now_ms(), self.state());
        let is_due = now_ms - state.typed_ms >= TYPING_MS;
        if is_due {
            state.typed_ms = now_ms;
        }
        is_due
    }

    /// Takes it from whoever is editing, who keeps what they wrote.
    pub(crate) fn take_over(&self) {
        let Some((behaviour, record)) = self.edited(|at| (at.behaviour.clone(), at.record.clone())) else { return };
        self.tab.ask_or_say(Request::TakeOver { behaviour, record }, |_| {});
    }

    /// Asks whoever is editing to let this person edit.
    pub(crate) fn ask_for(&self) {
        let Some((number, behaviour, record)) = self.edited(|at| (at.number, at.behaviour.clone(), at.record.clone()))
        else {
            return;
        };
        let document = self.clone();
        self.tab.ask_or_say(Request::AskFor { behaviour, record }, move |reply| {
            if let Reply::Asked { now_ms, asked } = reply {
                document.asked(number, *now_ms, asked);
            }
        });
    }

    fn asked(&self, number: u32, now_ms: u64, asked: &AskResult) {
        if self.edited(|now| now.number) != Some(number) {
            return;
        }
        let mut is_free = false;
        self.change_editing(|now| is_free = now.asked(asked, on_page_clock(now_ms)));
        self.tick_lock();
        if is_free {
            self.take_lock();
        }
    }

    /// One no longer wants what was asked for.
    pub(crate) fn ask_no_more(&self) {
        if let Some((behaviour, record)) = self.edited(|at| (at.behaviour.clone(), at.record.clone())) {
            self.tab.ask_or_say(Request::Withdraw { behaviour, record }, |_| {});
            self.change_editing(Editing::withdrawn);
        }
    }

    /// Says to who asks that they may edit, or that they may not yet.
    pub(crate) fn hand_over(&self, yes: bool) {
        if let Some((behaviour, Some(token))) = self.edited(|now| (now.behaviour.clone(), now.token())) {
            self.tab.ask_or_say(Request::HandOver { behaviour, token, yes }, |_| {});
            self.change_editing(|now| now.own(|own| own.asker = None));
        }
    }

    /// Moves the clock of what is counted down beside an editor.
    pub(in crate::desk) fn tick_lock(&self) {
        let now_ms = browser::now_ms();
        self.change_editing(|now| now.tick(now_ms));
        if self.edited(counts).unwrap_or_default() {
            self.lock_clock.set(now_ms);
        }
    }
}

/// True if something is counted down.
fn counts(editing: &Editing) -> bool {
    match &editing.writing {
        WriteRight::Own(own) => own.free_ms.is_some(),
        WriteRight::No(reading) => matches!(reading.asking, Asking::Waits { .. } | Asking::Kept { .. }),
        WriteRight::Opening | WriteRight::Free => false,
    }
}

/// Puts times of the server's clock, which shows `now_ms`, on the clock of the page.
fn on_page_clock(now_ms: u64) -> impl Fn(u64) -> f64 {
    let here_ms = browser::now_ms();
    move |at_ms| here_ms + (at_ms as f64 - now_ms as f64)
}

/// Gives a lock back; who does not reach the server has none any more.
fn unlock(behaviour: Id, token: LockToken) {
    link::ask(Request::Unlock { behaviour, token }, |_| {});
}
