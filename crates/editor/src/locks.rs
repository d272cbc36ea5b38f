//! Locks: who else is editing what, and the lock of what is edited here. They are for people; data is kept whole by
//! comparing, so that whoever is offline edits without one.

use crate::editing::{Asking, Editing, WriteRight};
use crate::effect::Purpose;
use crate::{Editor, NoAnswer};
use behaviour::{AskResult, FillFrom, Grant, Id, LockEvent, LockToken, RecordId, Refusal};
use protocol::{LockShown, Refused, answer, request};

/// The least time between two messages that somebody types, in milliseconds.
const TYPING_MS: f64 = 1_000.0;

impl Editor {
    pub(crate) fn change_editing(&mut self, act: impl FnOnce(&mut Editing)) {
        let Some(mut new) = (*self.editing).clone() else { return };
        act(&mut new);
        self.editing.set(Some(new));
    }

    pub(crate) fn edited<T>(&self, look: impl FnOnce(&Editing) -> T) -> Option<T> {
        self.editing.as_ref().map(look)
    }

    /// Returns what others are editing, each with the lock that says so.
    pub fn edited_by_others(&self) -> impl Iterator<Item = (&RecordId, &LockShown)> {
        let others = self.locks.iter().filter(|lock| Some(&lock.client) != self.me.client.as_ref());
        others.flat_map(|lock| lock.records.iter().map(move |record| (record, lock)))
    }

    /// An editor is opened here: its lock is asked for, and that of the one before it is given back. Answers with the
    /// number that ends it.
    pub fn open_editor(&mut self, record: RecordId) -> u32 {
        let before = self.edited(|now| now.number);
        before.into_iter().for_each(|before| self.close_editor(before));
        self.editors = self.editors.wrapping_add(1);
        let (number, seen) = (self.editors, self.record(&record));
        let by = self.edited_by_others().find(|(edited, _)| **edited == record).map(|(_, lock)| lock.name.clone());
        if let Some(behaviour) = (*self.open).clone() {
            self.editing.set(Some(Editing::open(number, behaviour, (record, seen), by)));
            self.take_lock();
        }
        number
    }

    /// An editor was closed: what it locked is free.
    pub fn close_editor(&mut self, number: u32) {
        if self.edited(|now| now.number) != Some(number) {
            return;
        }
        if self.awaits_lock() {
            // The lock goes with the typed change, which is sent first, and ends then.
            return self.change_editing(|now| now.is_over = true);
        }
        let closed = (*self.editing).clone();
        self.editing.set(None);
        if let Some((behaviour, token)) = closed.and_then(|closed| Some((closed.behaviour.clone(), closed.token()?))) {
            self.unlock(behaviour, token);
        }
    }

    /// Gives a lock back; who does not reach the server has none any more.
    fn unlock(&mut self, behaviour: Id, token: LockToken) {
        self.ask(request::Unlock { behaviour, token }, Purpose::Nothing);
    }

    /// Asks for the lock of what is edited here.
    pub fn take_lock(&mut self) {
        let asked = self.edited(|at| (at.number, at.behaviour.clone(), at.record.clone()));
        if let Some((number, behaviour, record)) = asked {
            let records = std::iter::once(record).filled();
            self.ask(request::Lock { behaviour, records }, Purpose::Lock(number));
        }
    }

    pub(crate) fn lock_answered(&mut self, number: u32, answer: Result<answer::Locked, NoAnswer>) {
        let is_still_open = self.edited(|now| now.number) == Some(number);
        match answer {
            // A grant counts also for an editor that was opened meanwhile, or is given back.
            Ok(locked) => self.hear_grant(&locked.grant),
            Err(_) if !is_still_open => {}
            Err(why) => {
                self.change_editing(|now| match &why {
                    NoAnswer::Refused(Refused::Change(Refusal::Locked { by, .. })) => now.denied(by),
                    NoAnswer::Refused(_) | NoAnswer::Unreachable => now.not_locked(),
                });
                self.go_on_after_lock();
            }
        }
    }

    /// The lock is given or not: what waited for that is sent, and an editor that was left meanwhile ends.
    fn go_on_after_lock(&mut self) {
        self.pump();
        if let Some(number) = self.edited(|now| now.is_over.then_some(now.number)).flatten() {
            self.close_editor(number);
        }
    }

    /// A lock was given, asked or unasked. One that nobody here wants any more is given back.
    pub fn hear_grant(&mut self, grant: &Grant) {
        let mut is_wanted = false;
        self.change_editing(|now| is_wanted = now.granted(grant));
        if is_wanted {
            self.go_on_after_lock();
        } else if let Some(open) = (*self.open).clone() {
            self.unlock(open, grant.token);
        }
    }

    /// Everyone is told who is editing what.
    pub fn hear_locks(&mut self, of: &Id, locks: Vec<LockShown>) {
        if self.is_wanted(of) {
            let me = self.me.client.clone();
            self.change_editing(|now| now.shown(&locks, me.as_ref()));
            self.locks.set(locks);
            self.propose_what_is_free();
        }
    }

    /// Something happened to a lock that is held or wanted here, while the server's clock showed `now_ms`.
    pub fn hear_lock_event(&mut self, of: &Id, now_ms: u64, event: &LockEvent) {
        if let LockEvent::Granted { grant, .. } = event {
            self.hear_grant(grant);
        } else if self.edited(|now| now.behaviour == *of).unwrap_or_default() {
            let at = self.on_page_clock(now_ms);
            self.change_editing(|now| now.hear(event, at));
        }
        self.tick();
    }

    /// Puts times of the server's clock, which shows `now_ms`, on the clock of the page.
    fn on_page_clock(&self, now_ms: u64) -> impl Fn(u64) -> f64 + use<> {
        let here_ms = self.now.clock_ms;
        move |at_ms| here_ms + (at_ms as f64 - now_ms as f64)
    }

    /// The link broke: nothing is locked as far as this page knows.
    pub(crate) fn forget_locks(&mut self) {
        self.change_editing(Editing::link_lost);
    }

    /// After the link was made anew: what is being edited is locked again, if it is there still.
    pub(crate) fn lock_again(&mut self) {
        let record = self.edited(|now| (now.writing == WriteRight::Free).then(|| now.record.clone())).flatten();
        if record.is_some_and(|record| self.confirmed.records.contains_key(&record)) {
            // The text that was typed meanwhile is sent with that lock.
            self.change_editing(|now| now.writing = WriteRight::Opening);
            self.take_lock();
        }
    }

    /// True if the next change is about what is typed into here, and the lock of that is asked for and not answered yet.
    pub(crate) fn awaits_lock(&self) -> bool {
        let (Some(next), Some(now)) = (self.queue.all().next(), self.editing.as_ref()) else { return false };
        now.writing == WriteRight::Opening && now.behaviour == next.behaviour && now.made_by(&next.change).is_some()
    }

    /// The tokens that go with a change of a behaviour.
    pub(crate) fn tokens(&self, behaviour: &Id) -> Vec<LockToken> {
        let token = self.edited(|now| now.token().filter(|_| now.behaviour == *behaviour));
        token.flatten().into_iter().collect()
    }

    /// Somebody types in the editor here; told at most once a second.
    pub fn typing(&mut self) {
        if self.edited(Editing::is_free_again) == Some(true) {
            self.take_lock();
        }
        let Some((behaviour, Some(token))) = self.edited(|now| (now.behaviour.clone(), now.token())) else { return };
        self.change_editing(|now| now.own(|own| own.free_ms = None));
        if self.now.clock_ms - self.typed_ms >= TYPING_MS {
            self.typed_ms = self.now.clock_ms;
            self.send_news(request::Typing { behaviour, token });
        }
    }

    fn edits(&self) -> Option<(Id, RecordId)> {
        self.edited(|at| (at.behaviour.clone(), at.record.clone()))
    }

    /// Takes it from whoever is editing, who keeps what they wrote.
    pub fn take_over(&mut self) {
        if let Some((behaviour, record)) = self.edits() {
            self.ask(request::TakeOver { behaviour, record }, Purpose::TakeOver);
        }
    }

    /// Asks whoever is editing to let this person edit.
    pub fn ask_for(&mut self) {
        if let (Some((behaviour, record)), Some(number)) = (self.edits(), self.edited(|at| at.number)) {
            self.ask(request::AskFor { behaviour, record }, Purpose::LetMeEdit(number));
        }
    }

    pub(crate) fn asked_for(&mut self, number: u32, now_ms: u64, asked: &AskResult) {
        if self.edited(|now| now.number) != Some(number) {
            return;
        }
        let (mut is_free, at) = (false, self.on_page_clock(now_ms));
        self.change_editing(|now| is_free = now.asked(asked, at));
        self.tick();
        if is_free {
            self.take_lock();
        }
    }

    /// One no longer wants what was asked for.
    pub fn ask_no_more(&mut self) {
        if let Some((behaviour, record)) = self.edits() {
            self.ask(request::Withdraw { behaviour, record }, Purpose::Deed);
            self.change_editing(Editing::withdrawn);
        }
    }

    /// Says to who asks that they may edit, or that they may not yet.
    pub fn hand_over(&mut self, yes: bool) {
        if let Some((behaviour, Some(token))) = self.edited(|now| (now.behaviour.clone(), now.token())) {
            self.ask(request::HandOver { behaviour, token, yes }, Purpose::Deed);
            self.change_editing(|now| now.own(|own| own.asker = None));
        }
    }

    /// Moves the clock of what is counted down beside an editor.
    pub fn tick(&mut self) {
        let now_ms = self.now.clock_ms;
        self.change_editing(|now| now.tick(now_ms));
        if self.edited(counts).unwrap_or_default() {
            self.lock_clock.put(now_ms);
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
