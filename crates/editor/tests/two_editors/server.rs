//! A server around a real room and its locks, as small as it can be. It takes the path of production: locks let a change in,
//! the room decides, the store saves, the room commits, everyone is told (`crates/server/src/rooms/task`).

use behaviour::{
    AnyKnowledge, Behaviour, Change, Committed, Decision, Grant, Holder, Id, Kind, Knowledge, LockEvent, LockToken,
    Locks, Presented, RecordId, Refusal, Room, UndoLog,
};
use protocol::{AnyAnswer, AnyRequest, Event, HistoryLine, LockShown, Message, Person, Refused, answer, request};
use std::collections::{BTreeMap, VecDeque};

/// Changes of one answer about the log, and lines of one page of the history: few, so that there are several pages.
const PAGE: usize = 6;
/// Changes that may wait to be saved.
const JOBS_MAX: usize = 3;

pub(crate) fn id(text: &str) -> Id {
    Id::new(text).expect("a short id")
}

/// A message to one session.
pub(crate) type Said = (u64, Message);

enum Wish {
    Change(Box<Change>),
    Undo { op: Id, again: bool },
}

struct Job {
    session: u64,
    ask: u32,
    wish: Wish,
    tokens: Vec<LockToken>,
}

struct UnderWay {
    session: u64,
    ask: u32,
    committed: Committed,
}

/// The answer of the store to what it is asked to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StoreAnswer {
    Saved,
    /// It says no.
    Failed,
    /// It has it, and nobody hears so.
    SavedUnheard,
}

pub(crate) struct Server {
    pub(crate) behaviour: Id,
    pub(crate) room: Room,
    /// The knowledge that the rules ask for.
    pub(crate) knowledge: &'static dyn Knowledge,
    /// All that the store has.
    pub(crate) log: Vec<Committed>,
    pub(crate) locks: Locks,
    epoch: u64,
    /// The program before any change.
    first: Behaviour,
    people: BTreeMap<u64, Person>,
    sessions: BTreeMap<u64, usize>,
    jobs: VecDeque<Job>,
    under_way: Option<UnderWay>,
    is_away: bool,
    locks_told: u64,
    now_ms: u64,
    pub(crate) said: Vec<Said>,
}

impl Server {
    pub(crate) fn new(first: Behaviour) -> Self {
        Self {
            behaviour: id("program"),
            room: Room::open(first.clone(), 0),
            knowledge: &AnyKnowledge,
            first,
            people: BTreeMap::new(),
            log: Vec::new(),
            locks: Locks::new(1),
            epoch: 1,
            sessions: BTreeMap::new(),
            jobs: VecDeque::new(),
            under_way: None,
            is_away: false,
            locks_told: 0,
            now_ms: 0,
            said: Vec::new(),
        }
    }

    pub(crate) fn client(who: usize) -> Id {
        id(&format!("client{who}"))
    }

    pub(crate) fn name(who: usize) -> String {
        ["Aiko", "Ben", "Yuki"][who].to_owned()
    }

    fn holder(&self, session: u64) -> Option<Holder> {
        let who = *self.sessions.get(&session)?;
        Some(Holder { session, client: Self::client(who), name: Self::name(who) })
    }

    fn say(&mut self, session: u64, message: impl Into<Message>) {
        if self.sessions.contains_key(&session) {
            self.said.push((session, message.into()));
        }
    }

    fn answer(&mut self, session: u64, ask: u32, answer: impl Into<AnyAnswer>) {
        self.say(session, Message::Answer { ask, answer: answer.into() });
    }

    fn no(&mut self, session: u64, ask: u32, no: Refused) {
        self.say(session, Message::No { ask: Some(ask), no });
    }

    fn tell_all(&mut self, event: &Event) {
        self.said.extend(self.sessions.keys().map(|session| (*session, event.clone().into())));
    }

    /// A client comes; its earlier session ends.
    pub(crate) fn connect(&mut self, session: u64, who: usize) {
        let earlier: Vec<u64> = self.sessions.iter().filter(|(_, known)| **known == who).map(|(id, _)| *id).collect();
        earlier.into_iter().for_each(|earlier| self.leave(earlier));
        self.sessions.insert(session, who);
        let away = self.is_away.then(|| "The disk is full.".into());
        self.say(session, Event::Store { away });
    }

    pub(crate) fn leave(&mut self, session: u64) {
        self.sessions.remove(&session);
        if self.people.remove(&session).is_some() {
            self.tell_of_people();
        }
        self.locks.leave(self.now_ms, session);
        self.tell_of_locks();
    }

    pub(crate) fn hear(&mut self, session: u64, ask: u32, request: AnyRequest) {
        if !self.sessions.contains_key(&session) {
            return;
        }
        match request {
            AnyRequest::Open(request::Open { .. }) => {
                let (behaviour, revision) = (self.behaviour.clone(), self.room.revision());
                let records = Box::new(self.room.behaviour().clone());
                self.enter(session);
                let (problems, people) = (Vec::new(), self.people.values().cloned().collect());
                let fingerprint = 0;
                let opened =
                    answer::Opened { behaviour, revision, records, more: false, problems, fingerprint, people };
                self.answer(session, ask, opened);
                // A lock that was kept for this client is its own again.
                let grants = self.sessions.get(&session).map(|who| Self::client(*who));
                let grants = grants.map(|client| self.locks.return_to(self.now_ms, &client, session));
                for grant in grants.into_iter().flatten() {
                    self.say(session, Event::LockReturned { grant });
                }
                let locks = self.locks_shown();
                self.say(session, locks);
            }
            AnyRequest::Propose(request::Propose { change, tokens, .. }) => {
                self.wait(Job { session, ask, wish: Wish::Change(Box::new(change)), tokens });
            }
            AnyRequest::TakeBack(request::TakeBack { op, again, tokens, .. }) => {
                self.wait(Job { session, ask, wish: Wish::Undo { op, again }, tokens });
            }
            AnyRequest::Since(request::Since { revision, .. }) => {
                let all = self.log.iter().skip(revision as usize);
                let changes: Vec<Committed> = all.clone().take(PAGE).cloned().collect();
                let more = all.count() > PAGE;
                self.answer(session, ask, answer::Missed { behaviour: self.behaviour.clone(), changes, more });
            }
            AnyRequest::History(request::History { before, .. }) => {
                let before = before.unwrap_or(u64::MAX);
                let older = self.log.iter().rev().filter(|one| one.revision < before);
                let lines = older.clone().take(PAGE).cloned().map(HistoryLine::of).collect();
                let more = older.count() > PAGE;
                self.answer(session, ask, answer::History { behaviour: self.behaviour.clone(), lines, more });
            }
            AnyRequest::Present(request::Present { pointer, selected, view }) => {
                if let Some(person) = self.people.get_mut(&session) {
                    (person.pointer, person.selected, person.view) = (pointer, selected, view);
                    self.tell_of_people();
                }
            }
            other => self.hear_of_locks(session, ask, other),
        }
    }

    fn enter(&mut self, session: u64) {
        let Some(who) = self.sessions.get(&session).copied() else { return };
        let (client, name) = (Self::client(who), Self::name(who));
        let (color, pointer, selected, view) = (who as u8, None, None, None);
        self.people.insert(session, Person { client, name, color, pointer, selected, view, looks_at: None });
        self.tell_of_people();
    }

    fn tell_of_people(&mut self) {
        let people = self.people.values().cloned().collect();
        self.tell_all(&Event::People { behaviour: self.behaviour.clone(), people });
    }

    fn hear_of_locks(&mut self, session: u64, ask: u32, request: AnyRequest) {
        let (now_ms, Some(holder)) = (self.now_ms, self.holder(session)) else { return };
        let is_there = |record: &RecordId| self.room.behaviour().records.contains_key(record);
        match request {
            AnyRequest::Lock(request::Lock { records, .. }) if !records.iter().all(is_there) => {
                self.no(session, ask, Refused::NothingThere);
            }
            AnyRequest::Lock(request::Lock { records, .. }) => {
                let record = records.iter().next().cloned();
                let taken = self.locks.take(now_ms, holder, records);
                self.tell_taken(session, ask, taken.ok(), record);
            }
            AnyRequest::TakeOver(request::TakeOver { record, .. }) if is_there(&record) => {
                let taken = self.locks.take_over(now_ms, holder, record.clone());
                self.tell_taken(session, ask, taken.ok(), Some(record));
            }
            AnyRequest::Unlock(request::Unlock { token, .. }) => {
                self.locks.release(now_ms, session, token);
                self.answer(session, ask, ());
            }
            AnyRequest::Typing(request::Typing { token, .. }) => {
                self.locks.touch(now_ms, session, token);
            }
            AnyRequest::AskFor(request::AskFor { record, .. }) if is_there(&record) => {
                let asked = self.locks.ask(now_ms, holder, record);
                self.answer(session, ask, answer::Asked { now_ms, asked });
            }
            AnyRequest::HandOver(request::HandOver { token, yes, .. }) => {
                let _ = if yes {
                    self.locks.say_yes(now_ms, session, token)
                } else {
                    self.locks.say_not_yet(now_ms, session, token)
                };
                self.answer(session, ask, ());
            }
            _ if ask > 0 => self.no(session, ask, Refused::NothingThere),
            _ => {}
        }
        self.tell_of_locks();
    }

    fn tell_taken(&mut self, session: u64, ask: u32, grant: Option<Grant>, record: Option<RecordId>) {
        match (grant, record) {
            (Some(grant), _) => self.answer(session, ask, answer::Locked { grant }),
            (None, Some(record)) => {
                let by = self.locks.holder(&record).map_or_else(String::new, |holder| holder.name.clone());
                let what = self.room.name_of(&record);
                self.no(session, ask, Refused::Change(Refusal::Locked { what, by }));
            }
            (None, None) => self.no(session, ask, Refused::NoLock),
        }
    }

    fn locks_shown(&self) -> Event {
        let shown = self.locks.held().map(|held| LockShown {
            client: held.holder.client.clone(),
            name: held.holder.name.clone(),
            records: held.records.clone(),
            away: held.is_kept,
        });
        Event::Locks { behaviour: self.behaviour.clone(), locks: shown.collect() }
    }

    fn tell_of_locks(&mut self) {
        for event in self.locks.tick(self.now_ms) {
            let to = match &event {
                LockEvent::Granted { to, .. }
                | LockEvent::Denied { to, .. }
                | LockEvent::Postponed { to, .. }
                | LockEvent::NotYet { to, .. } => to.session,
                LockEvent::Freed { holder, .. }
                | LockEvent::Asked { holder, .. }
                | LockEvent::Withdrawn { holder, .. }
                | LockEvent::KeptFor { holder, .. }
                | LockEvent::Warned { holder, .. } => holder.session,
            };
            if self.sessions.contains_key(&to) {
                let (behaviour, event) = (self.behaviour.clone(), Box::new(event));
                self.say(to, Event::LockNews { behaviour, now_ms: self.now_ms, event });
            }
        }
        if self.locks.version() != self.locks_told {
            self.locks_told = self.locks.version();
            let shown = self.locks_shown();
            self.tell_all(&shown);
        }
    }

    fn wait(&mut self, job: Job) {
        if self.is_away {
            return self.no(job.session, job.ask, Refused::Store("The disk is full.".into()));
        }
        if self.jobs.len() >= JOBS_MAX {
            return self.no(job.session, job.ask, Refused::TooFast);
        }
        self.jobs.push_back(job);
        self.work();
    }

    fn work(&mut self) {
        while self.under_way.is_none()
            && let Some(job) = self.jobs.pop_front()
        {
            self.start(job);
        }
    }

    /// Answers again what was made long ago; the locks let the rest in; then the room decides.
    fn start(&mut self, job: Job) {
        let Job { session, ask, wish, tokens } = job;
        let op = match &wish {
            Wish::Change(change) => change.op.clone(),
            Wish::Undo { op, .. } => op.clone(),
        };
        if let Some(made) = self.log.iter().find(|one| one.change.op == op).cloned() {
            return self.answer(session, ask, answer::Saved { revision: made.revision });
        }
        let Some(holder) = self.holder(session) else { return };
        let made = match wish {
            Wish::Change(change) => Ok(*change),
            Wish::Undo { op, again: false } => UndoLog::of(&self.log).undo(&holder.client, op, &self.room),
            Wish::Undo { op, again: true } => UndoLog::of(&self.log).redo(&holder.client, op, &self.room),
        };
        let presented = Presented { client: Some(holder.client.clone()), tokens };
        let decided = made.and_then(|change| {
            let change = Change { author: holder.name, by: Some(holder.client), ..change };
            self.room.check_locks(&change, &presented, &self.locks)?;
            self.locks.begin_saving(self.now_ms, &change, &presented);
            match self.room.propose(self.now_ms, change, self.knowledge) {
                Decision::Save(committed) => Ok(committed),
                Decision::Refuse(refusal) => Err(refusal),
                Decision::Duplicate(_) => Err(Refusal::Reused),
            }
        });
        match decided {
            Ok(committed) => self.under_way = Some(UnderWay { session, ask, committed }),
            Err(refusal) => {
                self.locks.saved(self.now_ms, &op);
                self.no(session, ask, Refused::Change(refusal));
            }
        }
        self.tell_of_locks();
    }

    /// The store answers what it was asked.
    pub(crate) fn saved(&mut self, how: StoreAnswer) {
        let Some(UnderWay { session, ask, committed }) = self.under_way.take() else { return };
        match how {
            StoreAnswer::Failed => {
                self.no(session, ask, Refused::Change(Refusal::NotSaved("The disk is slow.".into())));
            }
            StoreAnswer::Saved | StoreAnswer::SavedUnheard => {
                self.log.push(committed.clone());
                self.room.commit(&committed);
                let behaviour = self.behaviour.clone();
                self.tell_all(&Event::Accepted { behaviour, accepted: committed.clone() });
                if how == StoreAnswer::Saved {
                    self.answer(session, ask, answer::Saved { revision: committed.revision });
                } else {
                    self.no(session, ask, Refused::Store("The store is slow.".into()));
                }
            }
        }
        self.locks.saved(self.now_ms, &committed.change.op);
        self.tell_of_locks();
        self.work();
    }

    pub(crate) fn set_away(&mut self, is_away: bool) {
        self.is_away = is_away;
        if is_away {
            for job in std::mem::take(&mut self.jobs) {
                self.no(job.session, job.ask, Refused::Store("The disk is full.".into()));
            }
        }
        self.tell_all(&Event::Store { away: is_away.then(|| "The disk is full.".into()) });
    }

    /// The server dies and starts again; with `kept`, the store has what it was just asked to keep.
    pub(crate) fn restart(&mut self, kept: bool) {
        if let Some(UnderWay { committed, .. }) = self.under_way.take().filter(|_| kept) {
            self.log.push(committed);
        }
        self.epoch += 1;
        let mut all = self.first.clone();
        self.log.iter().for_each(|one| all.apply(&one.change));
        self.room = Room::open(all, self.log.len() as u64);
        self.locks = Locks::new(self.epoch);
        self.locks_told = self.locks.version();
        self.sessions.clear();
        self.people.clear();
        self.jobs.clear();
        self.said.clear();
        self.is_away = false;
    }

    pub(crate) fn tick(&mut self, now_ms: u64) {
        self.now_ms = now_ms;
        self.tell_of_locks();
    }

    /// Tells everyone the revision, as it does twice a second.
    pub(crate) fn ping(&mut self) {
        let behaviour = Some((self.behaviour.clone(), self.room.revision()));
        self.tell_all(&Event::Ping { behaviour, library_revision: 0 });
    }

    pub(crate) fn is_idle(&self) -> bool {
        self.jobs.is_empty() && self.under_way.is_none()
    }

    /// Returns true if a lock of this token is held by this client.
    pub(crate) fn holds(&self, who: usize, token: LockToken) -> bool {
        self.locks.held().any(|held| held.token == token && held.holder.client == Self::client(who))
    }
}

/// A note of that number.
pub(crate) fn note(number: u64) -> RecordId {
    RecordId::new(Kind::Note, &id(&format!("n{number}")))
}
