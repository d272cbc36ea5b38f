//! The locks of one open behaviour, which show who is editing what. They are for people; data is kept whole by
//! comparing (`room.rs`).
//!
//! Pure: the server hands in its monotonic clock with every call, and asks [`Locks::due`] when to call [`Locks::tick`].
//! A lock never ends while an edit made under it is being saved, so who gets it next sees that edit first.

mod ask;
mod news;
mod time;

pub use ask::AskResult;
pub use news::{LockEndReason, LockEvent};

use crate::{Change, FillFrom, Id, Kind, Lookup, RecordId};
use ask::{LockAsk, PutOff};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Locks one link may hold, each over a set of records.
pub const LOCKS_PER_SESSION_MAX: usize = 16;
/// Records that one link may hold with all its locks.
pub const LOCKED_PER_SESSION_MAX: usize = 64;
/// Records that may be locked in one behaviour.
pub const LOCKED_MAX: usize = 1_024;

/// Somebody who holds or wants a lock, by one of their links.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Holder {
    /// The number of the link, never used twice by one server.
    pub session: u64,
    /// The client, which keeps its id when its link is made anew.
    pub client: Id,
    /// The name that others see.
    pub name: String,
}

/// Proves a lock, once: the next lock of the same record has a higher one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct LockToken {
    /// Grows with every start of the server, so that no token outlives it.
    pub epoch: u64,
    /// Grows with every lock.
    pub counter: u64,
}

/// A lock that was given.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grant {
    /// Goes with every edit made under the lock.
    pub token: LockToken,
    /// The records that the lock covers.
    pub records: BTreeSet<RecordId>,
}

/// The reasons why a lock was not given. Nothing of the set is locked then.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Denied {
    /// Somebody is editing one of the records, or their change of it is being saved.
    Held {
        /// The record that is busy.
        record: RecordId,
        /// The name of the person who has it.
        by: String,
    },
    /// A position, or nothing at all, has no lock.
    NoLock,
    /// This link holds as much as it may, or the behaviour does.
    TooMany,
}

/// The proof that comes with a change that its sender may touch what is locked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Presented {
    /// The client it came from, by whichever of its links; none for what is no client: a request over HTTP, an import,
    /// the server itself.
    pub client: Option<Id>,
    /// The tokens that came with it.
    pub tokens: Vec<LockToken>,
}

/// One lock as others see it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held<'a> {
    /// The token of the lock.
    pub token: LockToken,
    /// The person who holds the lock.
    pub holder: &'a Holder,
    /// The records that the lock covers.
    pub records: &'a BTreeSet<RecordId>,
    /// True if the link of its holder ended, and it is kept for a moment.
    pub is_kept: bool,
}

/// A lock and everything that can end it.
#[derive(Clone, Debug)]
struct Lock {
    holder: Holder,
    records: BTreeSet<RecordId>,
    /// The time when its holder last did something.
    active_ms: u64,
    was_warned: bool,
    /// The time when the link of its holder ended.
    left_ms: Option<u64>,
    /// It ends as soon as nothing of it is being saved.
    ending: Option<LockEndReason>,
    /// The people who want it, first come first; only the first one is put before its holder.
    asks: VecDeque<LockAsk>,
}

/// A change on its way into the store.
#[derive(Clone, Debug)]
struct ChangeSaving {
    client: Option<Id>,
    by: String,
    records: BTreeSet<RecordId>,
}

/// The locks of one behaviour.
#[derive(Clone, Debug)]
pub struct Locks {
    epoch: u64,
    /// The counter of the newest lock.
    counter: u64,
    /// The time of the last call, in milliseconds; never goes back.
    now_ms: u64,
    /// The locks by the counters of their tokens.
    held: BTreeMap<u64, Lock>,
    by_record: Lookup<RecordId, u64>,
    /// The changes that are being saved, by their names.
    saving: Vec<(Id, ChangeSaving)>,
    /// The clients that were told *not yet*, with the records.
    refused: Vec<((Id, RecordId), PutOff)>,
    /// Grows whenever who holds what changes.
    version: u64,
    news: VecDeque<LockEvent>,
}

impl Locks {
    /// Nothing is locked. The epoch is the server's, which grows with every start.
    #[must_use]
    pub fn new(epoch: u64) -> Self {
        let (held, by_record, saving) = (BTreeMap::new(), Lookup::new(), Vec::new());
        let (refused, news) = (Vec::new(), VecDeque::new());
        Self { epoch, counter: 0, now_ms: 0, held, by_record, saving, refused, version: 0, news }
    }

    /// Locks all of these records or none. Asked twice by one link for one set, it gives one lock.
    ///
    /// # Errors
    /// The first record somebody else is editing, or that it would be too many.
    pub fn take(&mut self, now_ms: u64, holder: Holder, records: BTreeSet<RecordId>) -> Result<Grant, Denied> {
        self.advance(now_ms);
        if let Some(grant) = self.given_before(holder.session, &records) {
            return Ok(grant);
        }
        self.check_free(&holder.client, &records)?;
        self.check_room(holder.session, records.len())?;
        Ok(self.give(holder, records))
    }

    /// Gives a lock back. It ends once what was edited under it is saved. Returns true if there was such a lock.
    pub fn release(&mut self, now_ms: u64, session: u64, token: LockToken) -> bool {
        self.advance(now_ms);
        let Some(lock) = self.of(session, token) else { return false };
        lock.ending = Some(LockEndReason::Released);
        self.advance(now_ms);
        true
    }

    /// Notes that the holder does something in the editor, such as typing. Returns true if there is such a lock.
    pub fn touch(&mut self, now_ms: u64, session: u64, token: LockToken) -> bool {
        self.advance(now_ms);
        let now_ms = self.now_ms;
        let Some(lock) = self.of(session, token) else { return false };
        (lock.active_ms, lock.was_warned) = (now_ms, false);
        self.postpone(token.counter);
        true
    }

    /// Takes the lock of a record from whoever has it. The caller has made sure that this one may.
    ///
    /// # Errors
    /// If a change of the record is being saved just now, or it would be too many.
    pub fn take_over(&mut self, now_ms: u64, admin: Holder, record: RecordId) -> Result<Grant, Denied> {
        self.advance(now_ms);
        let records = std::iter::once(record.clone()).filled();
        let taken = self.by_record.get(&record).copied();
        let Some(counter) = taken.filter(|counter| self.held[counter].holder.session != admin.session) else {
            return self.take(now_ms, admin, records);
        };
        if self.is_saving(&self.held[&counter]) {
            return Err(Denied::Held { record, by: self.held[&counter].holder.name.clone() });
        }
        self.check_room(admin.session, 1)?;
        let asks = self.end(counter, LockEndReason::TakenOver { by: admin.name.clone() });
        let grant = self.give(admin, records);
        self.settle(asks);
        Ok(grant)
    }

    /// A link ended. Its locks are kept for a moment for the same client; what it asked for is forgotten.
    pub fn leave(&mut self, now_ms: u64, session: u64) {
        self.advance(now_ms);
        let now_ms = self.now_ms;
        let mut kept = Vec::new();
        for (counter, lock) in &mut self.held {
            if lock.holder.session == session && lock.left_ms.is_none() {
                lock.left_ms = Some(now_ms);
                kept.push(*counter);
            }
        }
        self.version += u64::from(!kept.is_empty());
        kept.into_iter().for_each(|counter| self.tell_kept(counter));
        self.forget_asks(session);
    }

    /// A client is back by a new link: what was kept for it is its own again, under the same tokens.
    pub fn return_to(&mut self, now_ms: u64, client: &Id, session: u64) -> Vec<Grant> {
        self.advance(now_ms);
        let epoch = self.epoch;
        let kept = self.held.iter_mut().filter(|(_, lock)| lock.holder.client == *client && lock.left_ms.is_some());
        let back = kept.map(|(counter, lock)| {
            (lock.holder.session, lock.left_ms) = (session, None);
            Grant { token: LockToken { epoch, counter: *counter }, records: lock.records.clone() }
        });
        let back: Vec<Grant> = back.collect();
        self.version += u64::from(!back.is_empty());
        back
    }

    /// A client is called something else: what it holds and asks for is told by that name.
    pub fn rename(&mut self, client: &Id, name: &str) {
        let holders = self.held.values_mut().flat_map(|Lock { holder, asks, .. }| {
            std::iter::once(holder).chain(asks.iter_mut().map(|ask| &mut ask.asker))
        });
        holders.filter(|holder| holder.client == *client).for_each(|holder| name.clone_into(&mut holder.name));
        self.version += 1;
    }

    /// A change was let in and goes to the store. Until [`Self::saved`], nobody else gets what it touches.
    pub fn begin_saving(&mut self, now_ms: u64, change: &Change, presented: &Presented) {
        self.advance(now_ms);
        for token in &presented.tokens {
            let session = self.held.get(&token.counter).map(|lock| &lock.holder);
            let session = session.filter(|holder| presented.client.as_ref() == Some(&holder.client));
            if let Some(session) = session.map(|holder| holder.session) {
                self.touch(now_ms, session, *token);
            }
        }
        let records = lockable(change).cloned().collect();
        let saving = ChangeSaving { client: presented.client.clone(), by: change.author.clone(), records };
        self.saving.retain(|(op, _)| *op != change.op);
        self.saving.push((change.op.clone(), saving));
    }

    /// A change is saved and everyone was told, or it is not saved and never will be.
    pub fn saved(&mut self, now_ms: u64, op: &Id) {
        self.saving.retain(|(saved, _)| saved != op);
        self.advance(now_ms);
    }

    /// Checks that every record which a change touches is free or locked by what was presented. Positions are never
    /// locked.
    ///
    /// # Errors
    /// Returns the first other record and the person who is editing it.
    pub fn check<'a>(&'a self, change: &'a Change, presented: &Presented) -> Result<(), (&'a RecordId, &'a Holder)> {
        let other = lockable(change).find_map(|record| {
            let counter = *self.by_record.get(record)?;
            let (holder, token) = (&self.held[&counter].holder, LockToken { epoch: self.epoch, counter });
            let is_theirs = presented.client.as_ref() == Some(&holder.client) && presented.tokens.contains(&token);
            (!is_theirs).then_some((record, holder))
        });
        other.map_or(Ok(()), Err)
    }

    /// Returns the person who is editing a record, if any.
    #[must_use]
    pub fn holder(&self, record: &RecordId) -> Option<&Holder> {
        self.by_record.get(record).map(|counter| &self.held[counter].holder)
    }

    /// Grows whenever what [`Self::held`] says changes.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// All locks, oldest first.
    pub fn held(&self) -> impl Iterator<Item = Held<'_>> {
        self.held.iter().map(|(counter, lock)| Held {
            token: LockToken { epoch: self.epoch, counter: *counter },
            holder: &lock.holder,
            records: &lock.records,
            is_kept: lock.left_ms.is_some(),
        })
    }

    /// The lock of this link with this token.
    fn of(&mut self, session: u64, token: LockToken) -> Option<&mut Lock> {
        let lock = self.held.get_mut(&token.counter).filter(|_| token.epoch == self.epoch)?;
        Some(lock).filter(|lock| lock.holder.session == session)
    }

    /// The lock of this set that this link has already; also one given back that could not end yet, as its last edit is
    /// still being saved, if nobody waits for it.
    fn given_before(&mut self, session: u64, records: &BTreeSet<RecordId>) -> Option<Grant> {
        let counter = *self.by_record.get(records.first()?)?;
        let lock = self.held.get_mut(&counter)?;
        let is_same = lock.holder.session == session && lock.records == *records;
        let is_wanted = lock.ending.is_some() && !lock.asks.is_empty();
        if !is_same || is_wanted {
            return None;
        }
        lock.ending = None;
        Some(Grant { token: LockToken { epoch: self.epoch, counter }, records: records.clone() })
    }

    fn check_free(&self, client: &Id, records: &BTreeSet<RecordId>) -> Result<(), Denied> {
        if records.is_empty() || records.iter().any(|record| record.kind == Kind::Place) {
            return Err(Denied::NoLock);
        }
        records.iter().try_for_each(|record| match self.busy(client, record) {
            Some(by) => Err(Denied::Held { record: record.clone(), by: by.to_owned() }),
            None => Ok(()),
        })
    }

    /// Returns the name of another person who locked a record, or whose change of it is being saved.
    fn busy(&self, client: &Id, record: &RecordId) -> Option<&str> {
        let mut others =
            self.saving.iter().map(|(_, saving)| saving).filter(|saving| saving.client.as_ref() != Some(client));
        let saver = || others.find(|saving| saving.records.contains(record)).map(|saving| saving.by.as_str());
        self.holder(record).map(|holder| holder.name.as_str()).or_else(saver)
    }

    fn check_room(&self, session: u64, more: usize) -> Result<(), Denied> {
        let mine = self.held.values().filter(|lock| lock.holder.session == session);
        let (locks, records) = mine.fold((0, 0), |(locks, records), lock| (locks + 1, records + lock.records.len()));
        let fits = locks < LOCKS_PER_SESSION_MAX
            && records + more <= LOCKED_PER_SESSION_MAX
            && self.by_record.len() + more <= LOCKED_MAX;
        if fits { Ok(()) } else { Err(Denied::TooMany) }
    }

    fn is_saving(&self, lock: &Lock) -> bool {
        self.saving.iter().any(|(_, saving)| !saving.records.is_disjoint(&lock.records))
    }

    /// Locks what is known to be free.
    fn give(&mut self, holder: Holder, records: BTreeSet<RecordId>) -> Grant {
        (self.counter, self.version) = (self.counter + 1, self.version + 1);
        self.by_record.extend(records.iter().map(|record| (record.clone(), self.counter)));
        let (active_ms, asks) = (self.now_ms, VecDeque::new());
        let grant = Grant { token: LockToken { epoch: self.epoch, counter: self.counter }, records: records.clone() };
        let lock = Lock { holder, records, active_ms, was_warned: false, left_ms: None, ending: None, asks };
        self.held.insert(self.counter, lock);
        grant
    }

    /// Frees what a lock covers; with who wanted it.
    fn end(&mut self, counter: u64, why: LockEndReason) -> VecDeque<LockAsk> {
        let Some(lock) = self.held.remove(&counter) else { return VecDeque::new() };
        self.version += 1;
        self.by_record.retain(|_, held| *held != counter);
        let grant = Grant { token: LockToken { epoch: self.epoch, counter }, records: lock.records };
        self.tell(LockEvent::Freed { holder: lock.holder, grant, why });
        lock.asks
    }
}

/// The records of a change that can be locked: a position never is, so that tidying disturbs nobody.
fn lockable(change: &Change) -> impl Iterator<Item = &RecordId> {
    change.edits.iter().map(|edit| &edit.id).filter(|id| id.kind != Kind::Place)
}

#[cfg(test)]
mod tests;
