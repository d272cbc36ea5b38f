//! Asking for what somebody else is editing: one is put before the holder at a time, silence means yes.

use super::{Grant, Holder, LockEndReason, LockEvent, LockToken, Locks};
use crate::{FillFrom, Id, RecordId};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The silence of a holder, in milliseconds, after which it means yes.
pub(super) const SILENCE_MS: u64 = 10_000;
/// For how long typing and saying so count as *not yet*.
pub(super) const NOT_YET_MS: u64 = 60_000;
/// For how long who was refused may not ask again.
const AGAIN_MS: u64 = 30_000;
/// Typing is told to who asks in steps of at least this.
const POSTPONED_STEP_MS: u64 = 1_000;
/// The most people who may wait for one lock.
const ASKS_MAX: usize = 4;
/// Refusals that are remembered in one behaviour; the one that ends first gives way.
const REFUSED_MAX: usize = 1_024;
/// For how long after it may be asked again it is remembered since when it was asked.
const REMEMBERED_MS: u64 = 60_000;

/// The result of asking for a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum AskResult {
    /// The holder is asked; silence until then means yes.
    Waiting {
        /// Until when.
        by_ms: u64,
    },
    /// The number of people who asked before.
    Queued {
        /// The number of people.
        before: usize,
    },
    /// Nobody is editing it: it can be taken.
    Free,
    /// It is locked by who asks.
    Yours,
    /// The holder said *not yet* a moment ago.
    TooSoon {
        /// The time when they may ask again.
        again_ms: u64,
    },
    /// The most people are waiting for it already.
    Full,
}

/// Somebody was told *not yet*.
#[derive(Clone, Debug)]
pub(super) struct PutOff {
    /// Under which lock.
    counter: u64,
    /// The time when they asked first.
    since_ms: u64,
    /// The time when they may ask again.
    again_ms: u64,
}

impl PutOff {
    /// True if it still matters to the next question.
    pub(super) fn is_remembered(&self, now_ms: u64) -> bool {
        self.again_ms + REMEMBERED_MS > now_ms
    }
}

/// Somebody wants a record.
#[derive(Clone, Debug)]
pub(super) struct LockAsk {
    pub(super) asker: Holder,
    record: RecordId,
    /// The time when it was first put before the holder, also if that one said *not yet* since.
    since_ms: u64,
    /// The time when silence means yes.
    pub(super) by_ms: u64,
    /// The holder said yes.
    agreed: bool,
}

impl LockAsk {
    /// True if the holder put it off for as long as that counts.
    fn is_last(&self, now_ms: u64) -> bool {
        now_ms >= self.since_ms + NOT_YET_MS
    }
}

impl Locks {
    /// Asks the holder of a record for it. Asking twice is asking once.
    pub fn ask(&mut self, now_ms: u64, asker: Holder, record: RecordId) -> AskResult {
        self.advance(now_ms);
        let Some(counter) = self.by_record.get(&record).copied() else { return AskResult::Free };
        let put_off = put_off(&self.refused, &asker.client, &record);
        if let Some(put_off) = put_off.filter(|put_off| put_off.again_ms > self.now_ms) {
            return AskResult::TooSoon { again_ms: put_off.again_ms };
        }
        let lock = &self.held[&counter];
        if lock.holder.session == asker.session {
            return AskResult::Yours;
        }
        let is_same = |ask: &LockAsk| ask.asker.session == asker.session && ask.record == record;
        if let Some(before) = lock.asks.iter().position(is_same) {
            return self.waits(counter, before);
        }
        if lock.asks.len() >= ASKS_MAX {
            return AskResult::Full;
        }
        let before = lock.asks.len();
        self.queue(counter, LockAsk { asker, record, since_ms: 0, by_ms: 0, agreed: false });
        self.waits(counter, before)
    }

    /// The holder says yes to who asked first: it goes to them once what was edited under it is saved. Returns true if
    /// anybody asked.
    pub fn say_yes(&mut self, now_ms: u64, session: u64, token: LockToken) -> bool {
        self.advance(now_ms);
        let now = self.now_ms;
        let Some(ask) = self.of(session, token).and_then(|lock| lock.asks.front_mut()) else { return false };
        (ask.agreed, ask.by_ms) = (true, now);
        self.advance(now_ms);
        true
    }

    /// Ends the question of a person who wants the record no more. Returns true if there was one.
    pub fn withdraw(&mut self, now_ms: u64, session: u64, record: &RecordId) -> bool {
        self.advance(now_ms);
        self.forget_asks_that(|ask| ask.asker.session == session && ask.record == *record)
    }

    /// The holder says *not yet* to who asked first, who may not ask again for a while; who asked next is heard. A
    /// minute after somebody asked first it counts no more. Returns true if it counted.
    pub fn say_not_yet(&mut self, now_ms: u64, session: u64, token: LockToken) -> bool {
        self.advance(now_ms);
        let now_ms = self.now_ms;
        let Some(lock) = self.of(session, token) else { return false };
        if lock.asks.front().is_none_or(|ask| ask.is_last(now_ms)) {
            return false;
        }
        let (by, asked) = (lock.holder.name.clone(), lock.asks.pop_front());
        let Some(LockAsk { asker, record, since_ms, .. }) = asked else { return false };
        let again_ms = now_ms + AGAIN_MS;
        self.remember_refused(&asker, &record, PutOff { counter: token.counter, since_ms, again_ms });
        self.tell(LockEvent::NotYet { to: asker, record, by, again_ms });
        self.put_before_holder(token.counter);
        true
    }

    fn waits(&self, counter: u64, before: usize) -> AskResult {
        match self.held[&counter].asks.front() {
            Some(ask) if before == 0 => AskResult::Waiting { by_ms: ask.by_ms },
            Some(_) | None => AskResult::Queued { before },
        }
    }

    fn queue(&mut self, counter: u64, ask: LockAsk) {
        let Some(lock) = self.held.get_mut(&counter) else { return };
        lock.asks.push_back(ask);
        if lock.asks.len() == 1 {
            self.put_before_holder(counter);
        }
    }

    /// Puts who asked first before the holder.
    fn put_before_holder(&mut self, counter: u64) {
        let now_ms = self.now_ms;
        let Some(lock) = self.held.get_mut(&counter) else { return };
        let Some(ask) = lock.asks.front_mut() else { return };
        let put_off = put_off(&self.refused, &ask.asker.client, &ask.record);
        let before = put_off.filter(|put_off| put_off.counter == counter);
        ask.since_ms = before.map_or(now_ms, |put_off| put_off.since_ms);
        ask.by_ms = now_ms + SILENCE_MS;
        let (asker, record, by_ms) = (ask.asker.clone(), ask.record.clone(), ask.by_ms);
        let (holder, token, last) =
            (lock.holder.clone(), LockToken { epoch: self.epoch, counter }, ask.is_last(now_ms));
        self.tell(LockEvent::Asked { holder, token, asker, record, by_ms, last });
    }

    /// The holder is typing: who asked first waits longer, within a limit.
    pub(super) fn postpone(&mut self, counter: u64) {
        let now_ms = self.now_ms;
        let front = self.held.get_mut(&counter).and_then(|lock| lock.asks.front_mut());
        let Some(ask) = front.filter(|ask| !ask.agreed) else { return };
        let by_ms = (now_ms + SILENCE_MS).min(ask.since_ms + NOT_YET_MS);
        if by_ms < ask.by_ms + POSTPONED_STEP_MS {
            return;
        }
        ask.by_ms = by_ms;
        let (to, record) = (ask.asker.clone(), ask.record.clone());
        self.tell(LockEvent::Postponed { to, record, by_ms });
    }

    /// It goes to who asked first.
    pub(super) fn hand_over(&mut self, counter: u64) {
        let front = self.held.get(&counter).and_then(|lock| lock.asks.front());
        let Some(to) = front.map(|ask| ask.asker.name.clone()) else { return };
        let asks = self.end(counter, LockEndReason::HandedOver { to });
        self.settle(asks);
    }

    /// Gives each who asked what is free now, in the order in which they asked; others go on waiting for the holder.
    pub(super) fn settle(&mut self, asks: VecDeque<LockAsk>) {
        for ask in asks {
            match self.by_record.get(&ask.record).copied() {
                Some(counter) if self.held[&counter].holder.session == ask.asker.session => {}
                Some(counter) => self.queue(counter, LockAsk { agreed: false, ..ask }),
                None => self.give_to(ask),
            }
        }
    }

    fn give_to(&mut self, ask: LockAsk) {
        let (to, records) = (ask.asker, std::iter::once(ask.record).filled());
        let event = match self.check_room(to.session, 1) {
            Ok(()) => {
                let grant: Grant = self.give(to.clone(), records);
                LockEvent::Granted { to, grant }
            }
            Err(denied) => LockEvent::Denied { to, denied },
        };
        self.tell(event);
    }

    /// Nobody by this link asks any more.
    pub(super) fn forget_asks(&mut self, session: u64) {
        self.forget_asks_that(|ask| ask.asker.session == session);
    }

    /// Forgets questions; holders who were asked are told, and hear who asked next. Returns true if there were any.
    fn forget_asks_that(&mut self, is_gone: impl Fn(&LockAsk) -> bool) -> bool {
        let (mut gone, mut first) = (false, Vec::new());
        for (counter, lock) in &mut self.held {
            let before = lock.asks.len();
            let was_first = lock.asks.front().filter(|ask| is_gone(ask)).map(|ask| ask.asker.clone());
            lock.asks.retain(|ask| !is_gone(ask));
            gone |= lock.asks.len() < before;
            first.extend(was_first.map(|asker| (*counter, lock.holder.clone(), asker)));
        }
        for (counter, holder, asker) in first {
            self.tell(LockEvent::Withdrawn { holder, token: LockToken { epoch: self.epoch, counter }, asker });
            self.put_before_holder(counter);
        }
        gone
    }

    fn remember_refused(&mut self, asker: &Holder, record: &RecordId, put_off: PutOff) {
        self.refused.retain(|((client, of), _)| (client, of) != (&asker.client, record));
        if self.refused.len() >= REFUSED_MAX {
            let soonest = (0..self.refused.len()).min_by_key(|at| self.refused[*at].1.again_ms);
            soonest.map(|at| self.refused.remove(at));
        }
        self.refused.push(((asker.client.clone(), record.clone()), put_off));
    }
}

/// Until when who was refused may not ask for a record again.
fn put_off<'r>(refused: &'r [((Id, RecordId), PutOff)], client: &Id, record: &RecordId) -> Option<&'r PutOff> {
    refused.iter().find(|((of, at), _)| (of, at) == (client, record)).map(|(_, put_off)| put_off)
}
