//! A server around the pure room and its locks, as small as it can be: it decides, saves, tells, and dies when told to.

use crate::gestures::start;
use crate::witness::{Check, Disk, Witness};
use behaviour::{
    AnyKnowledge, Behaviour, Change, Committed, Decision, Denied, Grant, Holder, Id, LockEndReason, LockEvent,
    LockToken, Locks, Presented, RecordId, Refusal, Room, UndoLog,
};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

const PING_MS: u64 = 5_000;
const MISSED_MAX: u32 = 2;
const QUEUE_MAX: usize = 64;

/// The faults that can be put in on purpose, to know that they would be noticed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Mutant {
    /// The server does not compare what a change found.
    NoCas,
    /// Locks are not asked.
    NoFencing,
    /// It is told before it is saved.
    AckBeforeCommit,
    /// The server forgets what it answered.
    NoDedupe,
    /// Time does nothing to locks.
    LocksNeverExpire,
    /// A client takes any revision for the next one.
    IgnoredGap,
    /// A ping does not say the revision.
    PingWithoutRevision,
    /// The server gives a lock to a client that is to be denied one.
    DoubleGrant,
    /// The locks are not told what is being saved.
    GrantWhileSaving,
    /// A copy of a refused change is decided anew.
    ForgottenRefusal,
    /// A token is good whoever brings it.
    TokenAlone,
    /// A token is good whichever server gave it.
    AnyEpoch,
}

/// A change that somebody wants to be made.
#[derive(Clone, Debug)]
pub(crate) enum Wish {
    Change(Change),
    Undo { op: Id, again: bool },
}

impl Wish {
    pub(crate) fn op(&self) -> &Id {
        match self {
            Self::Change(change) => &change.op,
            Self::Undo { op, .. } => op,
        }
    }
}

/// A message to the server.
#[derive(Clone, Debug)]
pub(crate) enum Up {
    Hello(usize),
    Propose(Wish, Vec<LockToken>),
    Take(BTreeSet<RecordId>),
    Release(LockToken),
    Type(LockToken),
    Ask(RecordId),
    Answer(LockToken, bool),
    Steal(RecordId),
    Since(u64),
    Pong,
    /// The link ends.
    Close,
}

/// A message to a client.
#[derive(Clone, Debug)]
pub(crate) enum Down {
    Welcome { revision: u64, behaviour: Behaviour, grants: Vec<Grant> },
    Changed(Committed),
    Missed(Vec<Committed>),
    Made(Id, u64),
    Refused(Id),
    Granted(Grant),
    Freed(LockToken),
    Ping(Option<u64>),
    Closed,
}

struct Session {
    client: usize,
    was_heard: bool,
    missed: u32,
}

struct Job {
    session: u64,
    client: usize,
    wish: Wish,
    tokens: Vec<LockToken>,
}

/// A change that the store was asked to keep.
struct UnderWay {
    session: u64,
    committed: Committed,
    presented: Presented,
}

pub(crate) struct Server {
    mutant: Option<Mutant>,
    pub(crate) disk: Disk,
    pub(crate) witness: Witness,
    pub(crate) room: Room,
    locks: Locks,
    sessions: BTreeMap<u64, Session>,
    queue: VecDeque<Job>,
    under_way: Option<UnderWay>,
    now_ms: u64,
    ping_ms: u64,
    /// The messages that it said, to be put on the links.
    pub(crate) said: Vec<(u64, Down)>,
    /// The number of times that each thing happened, to know that it does.
    pub(crate) counts: BTreeMap<&'static str, usize>,
}

impl Server {
    pub(crate) fn new(mutant: Option<Mutant>) -> Self {
        let (disk, witness, room) = (Disk::new(start()), Witness::default(), Room::open(start(), 0));
        let (sessions, queue, under_way) = (BTreeMap::new(), VecDeque::new(), None);
        let (locks, now_ms, ping_ms, said, counts) = (Locks::new(0), 0, PING_MS, Vec::new(), BTreeMap::new());
        Self { mutant, disk, witness, room, locks, sessions, queue, under_way, now_ms, ping_ms, said, counts }
    }

    fn is(&self, mutant: Mutant) -> bool {
        self.mutant == Some(mutant)
    }

    /// Returns the time that the locks are told.
    fn clock(&self) -> u64 {
        if self.is(Mutant::LocksNeverExpire) { 0 } else { self.now_ms }
    }

    pub(crate) fn knows(&self, session: u64) -> bool {
        self.sessions.contains_key(&session)
    }

    pub(crate) fn is_idle(&self) -> bool {
        self.queue.is_empty() && self.under_way.is_none()
    }

    fn say(&mut self, session: u64, down: Down) {
        if self.knows(session) {
            self.said.push((session, down));
        }
    }

    fn say_all(&mut self, down: &Down) {
        self.said.extend(self.sessions.keys().map(|session| (*session, down.clone())));
    }

    fn holder(&self, session: u64, client: usize) -> Holder {
        Holder { session, client: client_id(client), name: format!("P{client}") }
    }

    /// Hears one message.
    pub(crate) fn hear(&mut self, session: u64, up: Up) -> Check {
        if let Up::Hello(client) = up {
            return self.welcome(session, client);
        }
        let Some(client) = self.sessions.get(&session).map(|known| known.client) else { return Ok(()) };
        match up {
            Up::Hello(_) => {}
            Up::Propose(wish, tokens) if self.queue.len() < QUEUE_MAX => {
                self.queue.push_back(Job { session, client, wish, tokens });
                self.work()?;
            }
            Up::Propose(..) => {}
            Up::Since(revision) => {
                let missed = self.disk.log.iter().skip(revision as usize).take(self.room.revision() as usize);
                let missed = missed.cloned().collect();
                self.say(session, Down::Missed(missed));
            }
            Up::Pong => {
                self.sessions.insert(session, Session { client, was_heard: true, missed: 0 });
            }
            Up::Close => self.close(session)?,
            lock => self.hear_of_locks(session, client, lock)?,
        }
        Ok(())
    }

    fn hear_of_locks(&mut self, session: u64, client: usize, up: Up) -> Check {
        let (now_ms, holder) = (self.clock(), self.holder(session, client));
        let taken = match up {
            Up::Take(records) => Some((self.locks.take(now_ms, holder, records.clone()), records)),
            Up::Steal(record) => Some((self.locks.take_over(now_ms, holder, record.clone()), BTreeSet::from([record]))),
            Up::Ask(record) => {
                self.locks.ask(now_ms, holder, record);
                None
            }
            other => {
                self.hear_of_lock(session, other);
                None
            }
        };
        self.tell_of_locks()?;
        taken.map_or(Ok(()), |(answer, records)| self.tell_taken(session, answer, records))
    }

    /// A holder says something about its lock.
    fn hear_of_lock(&mut self, session: u64, up: Up) {
        let now_ms = self.clock();
        match up {
            Up::Release(token) => self.locks.release(now_ms, session, token),
            Up::Type(token) => self.locks.touch(now_ms, session, token),
            Up::Answer(token, true) => self.locks.say_yes(now_ms, session, token),
            Up::Answer(token, false) => self.locks.say_not_yet(now_ms, session, token),
            _ => false,
        };
    }

    fn tell_taken(&mut self, session: u64, answer: Result<Grant, Denied>, records: BTreeSet<RecordId>) -> Check {
        let grant = match answer {
            Ok(grant) => grant,
            Err(Denied::Held { .. }) if self.is(Mutant::DoubleGrant) => {
                Grant { token: LockToken { epoch: self.disk.epoch, counter: 1_000_000 + self.now_ms }, records }
            }
            Err(_) => return Ok(()),
        };
        self.count("granted");
        self.witness.granted(session, &grant)?;
        self.say(session, Down::Granted(grant));
        Ok(())
    }

    fn tell_of_locks(&mut self) -> Check {
        let news = self.locks.news();
        self.tell_events(news)
    }

    fn tell_events(&mut self, news: Vec<LockEvent>) -> Check {
        for event in news {
            match event {
                LockEvent::Granted { to, grant } => {
                    self.count("handed over");
                    self.witness.granted(to.session, &grant)?;
                    self.say(to.session, Down::Granted(grant));
                }
                LockEvent::Freed { holder, grant, why } => {
                    self.count(match why {
                        LockEndReason::Released => "freed: released",
                        LockEndReason::Idle => "freed: idle",
                        LockEndReason::Left => "freed: left",
                        LockEndReason::HandedOver { .. } => "freed: handed over",
                        LockEndReason::TakenOver { .. } => "freed: taken over",
                    });
                    self.witness.freed(&grant);
                    self.say(holder.session, Down::Freed(grant.token));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// A client comes in; its earlier links end.
    fn welcome(&mut self, session: u64, client: usize) -> Check {
        let earlier: Vec<u64> =
            self.sessions.iter().filter(|(_, known)| known.client == client).map(|(earlier, _)| *earlier).collect();
        earlier.into_iter().try_for_each(|earlier| self.close(earlier))?;
        self.sessions.insert(session, Session { client, was_heard: true, missed: 0 });
        self.witness.welcomed(session, client_id(client));
        let grants = self.locks.return_to(self.clock(), &client_id(client), session);
        self.tell_of_locks()?;
        grants.iter().for_each(|_| self.count("kept"));
        grants.iter().try_for_each(|grant| self.witness.granted(session, grant))?;
        let (revision, behaviour) = (self.room.revision(), self.room.behaviour().clone());
        self.say(session, Down::Welcome { revision, behaviour, grants });
        Ok(())
    }

    fn close(&mut self, session: u64) -> Check {
        self.say(session, Down::Closed);
        self.sessions.remove(&session);
        self.locks.leave(self.clock(), session);
        self.tell_of_locks()
    }

    /// Decides about what waits, until something has to be saved.
    fn work(&mut self) -> Check {
        while self.under_way.is_none() {
            let Some(job) = self.queue.pop_front() else { return Ok(()) };
            self.decide(job)?;
        }
        Ok(())
    }

    fn decide(&mut self, job: Job) -> Check {
        if self.is(Mutant::NoDedupe) {
            self.room = Room::open(self.room.behaviour().clone(), self.room.revision());
        }
        let op = job.wish.op().clone();
        let presented = Presented { client: Some(client_id(job.client)), tokens: job.tokens };
        let decision = match self.answered(&job.wish) {
            Some(decision) => decision,
            None => match self.wanted(job.client, job.wish) {
                Ok(change) => self.judge(change, &presented)?,
                Err(refusal) => Decision::Refuse(refusal),
            },
        };
        match decision {
            Decision::Save(committed) => self.begin(job.session, committed, presented),
            Decision::Duplicate(revision) => {
                self.say(job.session, Down::Made(op, revision));
                Ok(())
            }
            Decision::Refuse(refusal) => {
                self.refuse(job.session, op, &refusal);
                Ok(())
            }
        }
    }

    /// Returns the earlier answer: the store knows all that was made, the room what it refused lately.
    fn answered(&self, wish: &Wish) -> Option<Decision> {
        let known = self.disk.ops.get(wish.op()).filter(|_| !self.is(Mutant::NoDedupe));
        known.map(|revision| Decision::Duplicate(*revision)).or_else(|| self.room.answer(wish.op()))
    }

    fn wanted(&self, client: usize, wish: Wish) -> Result<Change, Refusal> {
        let (log, by) = (|| UndoLog::of(&self.disk.log), client_id(client));
        match wish {
            Wish::Change(change) => Ok(change),
            Wish::Undo { op, again: true } => log().redo(&by, op, &self.room),
            Wish::Undo { op, again: false } => log().undo(&by, op, &self.room),
        }
    }

    fn judge(&mut self, sent: Change, presented: &Presented) -> Result<Decision, String> {
        let mut change = sent.clone();
        if self.is(Mutant::NoCas) {
            change.edits.iter_mut().for_each(|edit| edit.before = self.room.behaviour().records.get(&edit.id).cloned());
        }
        // The path of production (`crates/server/src/rooms/task`): the locks let a change in, which then is decided about.
        let let_in = match self.is(Mutant::NoFencing) {
            true => Ok(()),
            false => self.room.check_locks(&change, &self.presented(presented), &self.locks),
        };
        let decision = match let_in {
            Ok(()) => {
                if !self.is(Mutant::GrantWhileSaving) {
                    self.locks.begin_saving(self.clock(), &change, presented);
                }
                self.room.propose(self.now_ms, change, &AnyKnowledge)
            }
            Err(locked) => Decision::Refuse(locked),
        };
        if !matches!(decision, Decision::Save(_)) {
            self.locks.saved(self.clock(), &sent.op);
        }
        match &decision {
            Decision::Save(committed) => self.witness.let_in(&sent, &committed.change, presented)?,
            Decision::Refuse(Refusal::Locked { .. }) => self.witness.kept_out(&sent, presented)?,
            Decision::Refuse(_) | Decision::Duplicate(_) => {}
        }
        Ok(decision)
    }

    /// Returns the proof that the locks are told was presented.
    fn presented(&self, presented: &Presented) -> Presented {
        let Presented { client, mut tokens } = presented.clone();
        if self.is(Mutant::AnyEpoch) {
            tokens.iter_mut().for_each(|token| token.epoch = self.disk.epoch);
        }
        let owner = self.locks.held().find(|held| self.is(Mutant::TokenAlone) && tokens.contains(&held.token));
        let client = owner.map(|held| held.holder.client.clone()).or(client);
        Presented { client, tokens }
    }

    fn begin(&mut self, session: u64, committed: Committed, presented: Presented) -> Check {
        self.tell_of_locks()?;
        if self.is(Mutant::AckBeforeCommit) {
            self.tell_made(session, &committed);
        }
        self.under_way = Some(UnderWay { session, committed, presented });
        Ok(())
    }

    fn refuse(&mut self, session: u64, op: Id, refusal: &Refusal) {
        self.count(match refusal {
            Refusal::Locked { .. } => "refused: locked",
            Refusal::Stale(_) => "refused: stale",
            Refusal::ChangedSince { .. } => "refused: changed since",
            _ => "refused",
        });
        if !self.is(Mutant::ForgottenRefusal) {
            self.room.refused(&op, refusal);
        }
        self.say(session, Down::Refused(op));
    }

    fn tell_made(&mut self, session: u64, committed: &Committed) {
        self.say(session, Down::Made(committed.change.op.clone(), committed.revision));
        self.say_all(&Down::Changed(committed.clone()));
    }

    /// The store answers.
    pub(crate) fn saved(&mut self, fails: bool) -> Check {
        let Some(UnderWay { session, committed, presented }) = self.under_way.take() else { return Ok(()) };
        let op = committed.change.op.clone();
        if fails {
            self.refuse(session, op.clone(), &Refusal::NotSaved("".into()));
        } else {
            self.witness.saved(&committed.change, &presented)?;
            self.disk.append(&committed)?;
            self.room.commit(&committed);
            self.count(if committed.change.undoes.is_some() { "taken back" } else { "made" });
            if !self.is(Mutant::AckBeforeCommit) {
                self.tell_made(session, &committed);
            }
            if *self.room.behaviour() != self.disk.behaviour {
                return Err("the room is not what the store has".to_owned());
            }
        }
        self.locks.saved(self.clock(), &op);
        self.tell_of_locks()?;
        self.work()
    }

    /// Returns the time when it wants to do something next.
    pub(crate) fn due_ms(&self) -> u64 {
        let locks = self.locks.due().filter(|_| !self.is(Mutant::LocksNeverExpire));
        locks.unwrap_or(u64::MAX).min(self.ping_ms)
    }

    /// It is so late now. Says whether it sent pings.
    pub(crate) fn tick(&mut self, now_ms: u64) -> Result<bool, String> {
        self.now_ms = now_ms;
        let news = self.locks.tick(self.clock());
        self.tell_events(news)?;
        let is_due = now_ms >= self.ping_ms;
        if is_due {
            self.ping_ms = now_ms + PING_MS;
            self.ping()?;
        }
        Ok(is_due)
    }

    /// Asks every client whether it is there; who missed two is not.
    fn ping(&mut self) -> Check {
        for known in self.sessions.values_mut() {
            known.missed = if known.was_heard { 0 } else { known.missed + 1 };
            known.was_heard = false;
        }
        let gone = self.sessions.iter().filter(|(_, known)| known.missed >= MISSED_MAX);
        let gone: Vec<u64> = gone.map(|(session, _)| *session).collect();
        gone.into_iter().try_for_each(|session| self.close(session))?;
        let revision = Some(self.room.revision()).filter(|_| !self.is(Mutant::PingWithoutRevision));
        self.say_all(&Down::Ping(revision));
        Ok(())
    }

    fn count(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    /// The server dies and starts again.
    pub(crate) fn kill(&mut self, kept: bool) -> Check {
        if let Some(UnderWay { committed, .. }) = self.under_way.take().filter(|_| kept) {
            self.disk.append(&committed)?;
        }
        self.disk.epoch += 1;
        self.room = Room::open(self.disk.replay(start()), self.disk.revision());
        self.locks = Locks::new(self.disk.epoch);
        self.sessions.clear();
        self.queue.clear();
        self.witness.epoch_ends();
        Ok(())
    }
}

fn client_id(client: usize) -> Id {
    crate::gestures::id(&format!("client{client}"))
}
