//! Who is editing what in a room: what links want with locks, and who is told what happened to them.

use super::RoomTask;
use crate::rooms::member::{AnswerTo, Recipient};
use crate::rooms::{LeaveReason, LockRequest};
use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use behaviour::{
    Change, Denied, Grant, Held, Holder, Id, Kind, LockEvent, LockToken, Locks, Presented, RecordId, Refusal, Room,
};
use protocol::{Event, LockShown, Refused, answer};
use std::time::Duration;
use tokio::sync::watch;
use tokio::time::Instant;

/// How fast everyone is told who is editing what, in bytes per second and client: few locks are told at once, and a
/// thousand, each made to change all the time, at their own slow pace.
const TOLD_BYTES_PER_SECOND: u64 = 64 << 10;

/// The locks of a room, by its own clock, and what everyone there is told of them.
pub(super) struct LockBook {
    locks: Locks,
    /// When the clock was 0.
    began: Instant,
    told: ToldLocks,
}

/// What everyone is told of the locks.
#[derive(Default)]
struct ToldLocks {
    text: watch::Sender<Utf8Bytes>,
    /// Which version of them.
    version: u64,
    /// When the next one may be told, on the clock of the room.
    next_ms: u64,
}

impl ToldLocks {
    /// When a newer version is to be told, if there is one.
    fn due(&self, locks: &Locks) -> Option<u64> {
        (self.version != locks.version()).then_some(self.next_ms)
    }

    /// Tells the newest version, if it is its turn.
    fn tell(&mut self, behaviour: &Id, locks: &Locks, now_ms: u64) {
        if self.due(locks).is_none_or(|at_ms| at_ms > now_ms) {
            return;
        }
        let shown = locks.held().map(shown).collect();
        let text = encode(Event::Locks { behaviour: behaviour.clone(), locks: shown });
        let bytes = u64::try_from(text.len()).unwrap_or(u64::MAX);
        (self.version, self.next_ms) = (locks.version(), now_ms + bytes * 1_000 / TOLD_BYTES_PER_SECOND);
        self.text.send_replace(text);
    }
}

impl LockBook {
    /// Nothing is locked.
    pub(super) fn new(epoch: u64) -> Self {
        Self { locks: Locks::new(epoch), began: Instant::now(), told: ToldLocks::default() }
    }

    fn now_ms(&self) -> u64 {
        u64::try_from(self.began.elapsed().as_millis()).unwrap_or(u64::MAX)
    }

    /// What everyone in the room is told.
    pub(super) fn text(&self) -> watch::Receiver<Utf8Bytes> {
        let mut text = self.told.text.subscribe();
        text.mark_changed();
        text
    }

    /// True if nobody holds a lock, also none that is kept for who may come back.
    pub(super) fn are_free(&self) -> bool {
        self.locks.held().next().is_none()
    }

    /// Waits until time does something to a lock, or everyone is to be told.
    pub(super) async fn due(&self) {
        match self.locks.due().into_iter().chain(self.told.due(&self.locks)).min() {
            Some(at_ms) => tokio::time::sleep_until(self.began + Duration::from_millis(at_ms)).await,
            None => std::future::pending().await,
        }
    }

    /// A change is decided about and saved, if the locks let it in.
    ///
    /// # Errors
    /// What is locked, and by whom.
    pub(super) fn begin(&mut self, room: &Room, change: &Change, presented: &Presented) -> Result<(), Refusal> {
        room.check_locks(change, presented, &self.locks)?;
        self.locks.begin_saving(self.now_ms(), change, presented);
        Ok(())
    }

    /// True if nobody edits what a change of the server's own touches.
    ///
    /// # Errors
    /// What is locked, and by whom.
    pub(super) fn check(&self, room: &Room, change: &Change) -> Result<(), Refusal> {
        room.check_locks(change, &Presented { client: None, tokens: Vec::new() }, &self.locks)
    }

    /// What somebody else than this client is editing, as why it may not be removed under their hands.
    pub(super) fn edited_by_others(&self, client: &Id, room: &Room) -> Option<Refusal> {
        let held = self.locks.held().find(|held| held.holder.client != *client)?;
        let record = held.records.iter().next()?;
        Some(Refusal::Locked { what: room.name_of(record), by: held.holder.name.clone() })
    }

    /// What was begun came to an end.
    pub(super) fn saved(&mut self, op: &Id) {
        self.locks.saved(self.now_ms(), op);
    }

    /// A client is called something else.
    pub(super) fn rename(&mut self, client: &Id, name: &str) {
        self.locks.rename(client, name);
    }

    /// A link left.
    pub(super) fn left(&mut self, session: u64, parting: LeaveReason) {
        let now_ms = self.now_ms();
        if parting == LeaveReason::Chosen {
            let own = self.locks.held().filter(|held| held.holder.session == session);
            let own: Vec<LockToken> = own.map(|held| held.token).collect();
            for token in own {
                self.locks.release(now_ms, session, token);
            }
        }
        self.locks.leave(now_ms, session);
    }

    /// A client is there: what was kept for it is its own again.
    pub(super) fn came(&mut self, client: &Id, session: u64, link: &dyn Recipient) {
        for grant in self.locks.return_to(self.now_ms(), client, session) {
            link.send(encode(Event::LockReturned { grant }));
        }
    }
}

/// True if all of these can be locked: only what is there. Nobody else knows the id of what somebody is about to make, and
/// names of nothing would fill the book.
fn are_there<'a>(mut records: impl Iterator<Item = &'a RecordId>, room: &Room) -> bool {
    records.all(|record| record.kind == Kind::Place || room.behaviour().records.contains_key(record))
}

/// Why a lock was not given.
fn refused(denied: Denied, room: &Room) -> Refused {
    match denied {
        Denied::Held { record, by } => Refused::Change(Refusal::Locked { what: room.name_of(&record), by }),
        Denied::NoLock => Refused::NoLock,
        Denied::TooMany => Refused::TooManyLocks,
    }
}

/// The answer to who wanted a lock.
fn locked(given: Result<Grant, Denied>, room: &Room) -> Result<answer::Locked, Refused> {
    given.map(|grant| answer::Locked { grant }).map_err(|denied| refused(denied, room))
}

impl RoomTask {
    /// Does what a link wants with the locks, if it is here; helpers are not locked.
    pub(super) fn lock(&mut self, session: u64, locking: LockRequest) {
        let Some(holder) = self.holder(session) else { return locking.refuse(Refused::NoLock) };
        let now_ms = self.locks.now_ms();
        match locking {
            LockRequest::Take(records, answer) if !are_there(records.iter(), &self.room) => {
                answer.no(Refused::NothingThere)
            }
            LockRequest::TakeOver(record, answer) if !are_there([&record].into_iter(), &self.room) => {
                answer.no(Refused::NothingThere)
            }
            LockRequest::Take(records, answer) => {
                let taken = self.locks.locks.take(now_ms, holder, records);
                answer.end(locked(taken, &self.room));
            }
            LockRequest::TakeOver(record, answer) => {
                let taken = self.locks.locks.take_over(now_ms, holder, record);
                answer.end(locked(taken, &self.room));
            }
            LockRequest::Release(token, answer) => {
                self.locks.locks.release(now_ms, session, token);
                answer.give(());
            }
            LockRequest::Touch(token) => {
                self.locks.locks.touch(now_ms, session, token);
            }
            LockRequest::Ask(record, answer) => {
                let asked = self.locks.locks.ask(now_ms, holder, record);
                answer.give(answer::Asked { now_ms, asked });
            }
            LockRequest::Withdraw(record, answer) => {
                self.locks.locks.withdraw(now_ms, session, &record);
                answer.give(());
            }
            LockRequest::Reply(token, yes, answer) => self.hand_over(session, token, yes, answer),
        }
        self.tell_locks();
    }

    fn hand_over(&mut self, session: u64, token: LockToken, yes: bool, answer: AnswerTo<()>) {
        let (now_ms, locks) = (self.locks.now_ms(), &mut self.locks.locks);
        let _had_ended_already =
            if yes { locks.say_yes(now_ms, session, token) } else { locks.say_not_yet(now_ms, session, token) };
        answer.give(());
    }

    fn holder(&self, session: u64) -> Option<Holder> {
        let member = self.members.get(&session).filter(|_| !self.is_library())?;
        Some(Holder { session, client: member.person.client.clone(), name: member.person.name.clone() })
    }

    /// Lets happen what is due, tells those whom it concerns, and everyone who is editing what.
    pub(super) fn tell_locks(&mut self) {
        let now_ms = self.locks.now_ms();
        for event in self.locks.locks.tick(now_ms) {
            if let Some(member) = self.members.get(&concerned(&event).session) {
                let (behaviour, event) = (self.id.clone(), Box::new(event));
                member.link.send(encode(Event::LockNews { behaviour, now_ms, event }));
            }
        }
        self.locks.told.tell(&self.id, &self.locks.locks, now_ms);
    }
}

fn shown(held: Held) -> LockShown {
    let Holder { client, name, .. } = held.holder.clone();
    LockShown { client, name, records: held.records.clone(), away: held.is_kept }
}

/// Whom an event is for.
fn concerned(event: &LockEvent) -> &Holder {
    match event {
        LockEvent::Granted { to, .. }
        | LockEvent::Denied { to, .. }
        | LockEvent::Postponed { to, .. }
        | LockEvent::NotYet { to, .. } => to,
        LockEvent::Freed { holder, .. }
        | LockEvent::Asked { holder, .. }
        | LockEvent::Withdrawn { holder, .. }
        | LockEvent::KeptFor { holder, .. }
        | LockEvent::Warned { holder, .. } => holder,
    }
}
