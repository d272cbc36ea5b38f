//! What a room does one after another: deciding about changes and saving them, and going to the bin.

use super::saving::{self, Saved};
use super::{RoomTask, Stay};
use crate::connection::outbox::Answer;
use behaviour::{Change, Kind, Refusal};
use protocol::{Reply, SaidNo};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Jobs that may wait in one room.
const WAITING_MAX_JOBS: usize = 1_024;
/// Jobs of one sender among them.
const WAITING_PER_SENDER_MAX_JOBS: usize = 256;

/// What has to be saved.
pub(super) enum Job {
    /// A change.
    Save(Change, Answer),
    /// The behaviour goes to the bin; with who says so.
    Remove(String, Answer),
}

impl Job {
    /// The link of who wants it; none is the server.
    fn sender(&self) -> Option<u64> {
        match self {
            Self::Save(_, answer) | Self::Remove(_, answer) => answer.session(),
        }
    }

    fn no(self, no: SaidNo) {
        match self {
            Self::Save(_, answer) | Self::Remove(_, answer) => answer.no(no),
        }
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
            job.no(SaidNo::NoBehaviour);
        } else if self.waiting.has_room(job.sender()) {
            self.waiting.put(job);
        } else {
            job.no(SaidNo::TooFast);
        }
    }

    /// Begins the next job: one at a time.
    pub(super) fn start_saving(&mut self) {
        if self.saving.is_some() || self.waiting.is_empty() {
            return;
        }
        if let Some(no) = self.hub.health.away() {
            return self.waiting.take_all().into_iter().for_each(|job| job.no(no.clone()));
        }
        let (hub, id) = (Arc::clone(&self.hub), self.id.clone());
        if self.uncertain {
            self.saving = Some(Box::pin(saving::catch_up(hub, id, self.room.revision())));
            return;
        }
        match self.waiting.take() {
            Some(Job::Save(change, from)) => match self.stranger(&change) {
                Some(stranger) => from.no(SaidNo::Change(Refusal::Malformed(stranger))),
                None => self.saving = Some(Box::pin(saving::decide(hub, id, Arc::clone(&self.room), change, from))),
            },
            Some(Job::Remove(by, from)) => {
                self.stay = Stay::Leaving;
                self.saving = Some(Box::pin(saving::remove(hub, id, by, from)));
            }
            None => {}
        }
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
            Saved::Change { news, answer, from, uncertain } => {
                self.uncertain = uncertain;
                self.conclude(&news, answer, from);
            }
            Saved::CaughtUp(Ok(news)) => {
                self.uncertain = false;
                news.iter().for_each(|news| self.commit(news, None));
            }
            Saved::CaughtUp(Err(no)) => {
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
    fn conclude(&mut self, news: &[behaviour::Committed], answer: Result<behaviour::Accepted, SaidNo>, from: Answer) {
        let here = from.session().filter(|session| self.members.contains_key(session));
        let asked =
            if let (Some(session), Answer::Client(_, ask, _)) = (here, &from) { Some((session, *ask)) } else { None };
        let mut told = false;
        for one in news {
            let mine = asked.filter(|_| answer.as_ref().is_ok_and(|mine| mine.revision == one.revision));
            told |= mine.is_some();
            self.commit(one, mine);
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
        self.waiting.take_all().into_iter().for_each(|job| job.no(SaidNo::NoBehaviour));
        self.hub.programs.tell();
        from.give(Reply::Done);
        self.tell_removed(by);
    }
}

#[cfg(test)]
mod tests {
    use super::{Job, WAITING_PER_SENDER_MAX_JOBS, Waiting};
    use crate::connection::outbox::{AllWaiting, Answer, Outbox};

    fn put(waiting: &mut Waiting, session: u64, by: &str) -> bool {
        let (outbox, ..) = Outbox::new(session, AllWaiting::default());
        let has_room = waiting.has_room(Some(session));
        if has_room {
            waiting.put(Job::Remove(by.to_owned(), Answer::Client(outbox, 1, None)));
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
