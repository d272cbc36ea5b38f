//! What a room does one after another: deciding about changes and saving them, and going to the bin.

use super::making::{self, Made};
use super::saving::{self, SaveOutcome, Saved};
use super::{RoomTask, Stay, naming};
use crate::rooms::member::Answer;
use crate::rooms::past::{Naming, Wish};
use behaviour::{Change, Kind, Presented, Refusal, Token};
use futures_util::future::BoxFuture;
use protocol::{Refused, Reply};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Jobs that may wait in one room.
const WAITING_MAX_JOBS: usize = 1_024;
/// Jobs of one sender among them.
const WAITING_PER_SENDER_MAX_JOBS: usize = 256;

/// What has to be saved.
pub(super) enum Job {
    /// A change, with the tokens of what its sender locked.
    Save(Change, Vec<Token>, Answer),
    /// A change that has to be made first, out of what was.
    Make(Wish, Answer),
    /// A version gets a name, or loses it.
    Name(Naming, Answer),
    /// The behaviour goes to the bin; with who says so.
    Remove(String, Answer),
}

impl Job {
    /// The link of who wants it; none is the server.
    fn sender(&self) -> Option<u64> {
        match self {
            Self::Save(.., answer) | Self::Make(_, answer) | Self::Name(_, answer) | Self::Remove(_, answer) => {
                answer.session()
            }
        }
    }

    fn no(self, no: Refused) {
        match self {
            Self::Save(.., answer) | Self::Make(_, answer) | Self::Name(_, answer) | Self::Remove(_, answer) => {
                answer.no(no)
            }
        }
    }
}

/// What a room has to do with the store just now.
pub(super) enum Saving {
    /// Nothing, and the room knows all that is saved.
    Idle,
    /// Nothing, but the store may have more than the room knows: it is asked before anything else is saved.
    Uncertain,
    /// The store works on something.
    UnderWay(BoxFuture<'static, Saved>),
}

impl Saving {
    /// Whether the store works on something.
    pub(super) fn is_under_way(&self) -> bool {
        matches!(self, Self::UnderWay(_))
    }

    /// Waits for what the store works on, else for ever.
    pub(super) async fn answer(&mut self) -> Saved {
        let Self::UnderWay(work) = self else { return std::future::pending().await };
        let saved = work.await;
        *self = Self::Idle;
        saved
    }
}

/// Jobs that wait: each sender's in order, and the senders take turns.
#[derive(Default)]
pub(super) struct Waiting {
    of: BTreeMap<Option<u64>, VecDeque<Job>>,
    /// Who is next.
    turns: VecDeque<Option<u64>>,
    count: usize,
}

impl Waiting {
    /// Whether one more job of this sender finds room.
    fn has_room(&self, sender: Option<u64>) -> bool {
        let mine = self.of.get(&sender).map_or(0, VecDeque::len);
        self.count < WAITING_MAX_JOBS && mine < WAITING_PER_SENDER_MAX_JOBS
    }

    fn put(&mut self, job: Job) {
        let sender = job.sender();
        let mine = self.of.entry(sender).or_default();
        if mine.is_empty() {
            self.turns.push_back(sender);
        }
        mine.push_back(job);
        self.count += 1;
    }

    fn take(&mut self) -> Option<Job> {
        let sender = self.turns.pop_front()?;
        let jobs = self.of.get_mut(&sender)?;
        let job = jobs.pop_front()?;
        self.count -= 1;
        if jobs.is_empty() {
            self.of.remove(&sender);
        } else {
            self.turns.push_back(sender);
        }
        Some(job)
    }

    fn take_all(&mut self) -> Vec<Job> {
        std::iter::from_fn(|| self.take()).collect()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }
}

impl RoomTask {
    pub(super) fn wait(&mut self, job: Job) {
        if self.stay == Stay::Gone {
            job.no(Refused::NoBehaviour);
        } else if self.waiting.has_room(job.sender()) {
            self.waiting.put(job);
        } else {
            job.no(Refused::TooFast);
        }
    }

    /// Begins the next job: one at a time.
    pub(super) fn start_saving(&mut self) {
        while !self.saving.is_under_way() && !self.waiting.is_empty() {
            self.start_next();
        }
    }

    fn start_next(&mut self) {
        if let Some(no) = self.around.health.away() {
            return self.waiting.take_all().into_iter().for_each(|job| job.no(no.clone()));
        }
        let (around, id) = (Arc::clone(&self.around), self.id.clone());
        if let Saving::Uncertain = self.saving {
            self.saving = Saving::UnderWay(Box::pin(saving::catch_up(around, id, self.room.revision())));
            return;
        }
        match self.waiting.take() {
            Some(Job::Save(change, tokens, from)) => self.start_change(change, tokens, from),
            Some(Job::Make(wish, from)) => {
                let room = Arc::clone(&self.room);
                self.saving = Saving::UnderWay(Box::pin(making::make(around, id, room, wish, from)));
            }
            Some(Job::Name(what, from)) => {
                self.saving = Saving::UnderWay(Box::pin(naming::name(around, id, self.room.revision(), what, from)));
            }
            Some(Job::Remove(by, from)) => {
                self.stay = Stay::Leaving;
                self.saving = Saving::UnderWay(Box::pin(saving::remove(around, id, by, from)));
            }
            None => {}
        }
    }

    /// Others get no lock of what it touches until it is saved.
    fn start_change(&mut self, change: Change, tokens: Vec<Token>, from: Answer) {
        if let Some(stranger) = self.stranger(&change) {
            return from.no(Refused::Change(Refusal::Malformed(stranger)));
        }
        let (around, id) = (Arc::clone(&self.around), self.id.clone());
        let member = from.session().and_then(|session| self.members.get(&session));
        let presented = Presented { client: member.map(|member| member.person.client.clone()), tokens };
        self.saving = match self.locks.begin(&self.room, &change, &presented) {
            Ok(()) => Saving::UnderWay(Box::pin(saving::decide(around, id, Arc::clone(&self.room), change, from))),
            Err(locked) => Saving::UnderWay(Box::pin(saving::refuse(around, id, change, locked, from))),
        };
    }

    /// A record that does not belong here: helpers live in the library, and nothing else does.
    fn stranger(&self, change: &Change) -> Option<String> {
        let library = self.is_library();
        let stranger = change.edits.iter().find(|edit| (edit.id.kind == Kind::Helper) != library);
        stranger.map(|edit| edit.id.to_string())
    }

    /// The store answered.
    pub(super) fn saved(&mut self, saved: Saved) {
        match saved {
            Saved::Change { op, outcome, from } => {
                if outcome.is_uncertain {
                    self.saving = Saving::Uncertain;
                }
                self.conclude(outcome, from);
                self.locks.saved(&op);
                self.tell_locks();
            }
            Saved::Made { outcome, from } => match *outcome {
                Ok(Made::New(change, tokens)) => self.start_change(change, tokens, from),
                Ok(Made::Known(accepted)) => from.give(Reply::Accepted { behaviour: self.id.clone(), accepted }),
                Err(no) => from.no(no),
            },
            Saved::Named { outcome, from } => self.named(outcome, from),
            Saved::CaughtUp(Ok(news)) => news.iter().for_each(|news| self.commit(news, None, None)),
            Saved::CaughtUp(Err(no)) => {
                self.saving = Saving::Uncertain;
                if let Some(job) = self.waiting.take() {
                    job.no(no);
                }
            }
            Saved::Removed { outcome: Ok(()), from, by } => self.removed(&by, from),
            Saved::Removed { outcome: Err(no), from, .. } => {
                self.stay = Stay::Here;
                from.no(no);
            }
        }
    }

    /// Tells the news; who asked gets the answer once: with the news if they are here and it is among them.
    fn conclude(&mut self, outcome: SaveOutcome, from: Answer) {
        let SaveOutcome { news, after, answer, .. } = outcome;
        let here = from.session().filter(|session| self.members.contains_key(session));
        let asked =
            if let (Some(session), Answer::Client { ask, .. }) = (here, &from) { Some((session, *ask)) } else { None };
        let mut told = false;
        for one in &news {
            let mine = asked.filter(|_| answer.as_ref().is_ok_and(|mine| mine.revision == one.revision));
            told |= mine.is_some();
            self.commit(one, after.as_ref(), mine);
        }
        match answer {
            Ok(_) if told => {}
            Ok(accepted) => from.give(Reply::Accepted { behaviour: self.id.clone(), accepted }),
            Err(no) => from.no(no),
        }
    }

    fn removed(&mut self, by: &str, from: Answer) {
        tracing::info!(behaviour = %self.id, by, "a behaviour goes to the bin");
        self.stay = Stay::Gone;
        self.waiting.take_all().into_iter().for_each(|job| job.no(Refused::NoBehaviour));
        self.around.news.tell();
        from.give(Reply::Done);
        self.tell_removed(by);
    }
}

#[cfg(test)]
mod tests {
    use super::{Job, WAITING_PER_SENDER_MAX_JOBS, Waiting};
    use crate::rooms::member::{Answer, Feed, Recipient, Whole};
    use axum::extract::ws::Utf8Bytes;
    use std::sync::Arc;

    /// A link that nobody reads.
    struct Silent(u64);

    impl Recipient for Silent {
        fn session(&self) -> u64 {
            self.0
        }

        fn is_gone(&self) -> bool {
            false
        }

        fn send(&self, _: Utf8Bytes) {}

        fn send_whole(&self, _: u32, _: Whole) {}

        fn follow(&self, _: Option<Box<Feed>>) {}
    }

    fn put(waiting: &mut Waiting, session: u64, by: &str) -> bool {
        let has_room = waiting.has_room(Some(session));
        if has_room {
            waiting
                .put(Job::Remove(by.to_owned(), Answer::Client { to: Arc::new(Silent(session)), ask: 1, held: None }));
        }
        has_room
    }

    #[test]
    fn senders_take_turns_and_each_has_its_own_bound() {
        let mut waiting = Waiting::default();
        let mine = (0..2 * WAITING_PER_SENDER_MAX_JOBS).filter(|_| put(&mut waiting, 1, "Ben")).count();
        assert!(mine == WAITING_PER_SENDER_MAX_JOBS && put(&mut waiting, 2, "Aiko"));
        let mut next = || waiting.take().and_then(|job| job.sender());
        assert_eq!([next(), next(), next()], [Some(1), Some(2), Some(1)]);
    }
}
