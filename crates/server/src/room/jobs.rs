//! What a room does one after another: deciding about changes and saving them, and going to the bin.

use super::RoomTask;
use super::saving::{self, Keep, Saved};
use crate::outbox::Answer;
use behaviour::{Change, Decision, Kind, Record, Refusal};
use protocol::{Reply, SaidNo};
use std::sync::Arc;

/// Jobs that may wait in one room.
const WAITING_MAX_JOBS: usize = 256;

/// What has to be saved.
pub(super) enum Job {
    /// A change.
    Save(Change, Answer),
    /// The behaviour goes to the bin; with who says so.
    Remove(String, Answer),
}

impl Job {
    fn no(self, no: SaidNo) {
        match self {
            Self::Save(_, answer) | Self::Remove(_, answer) => answer.no(no),
        }
    }
}

impl RoomTask {
    pub(super) fn wait(&mut self, job: Job) {
        if self.gone {
            job.no(SaidNo::NoBehaviour);
        } else if self.waiting.len() >= WAITING_MAX_JOBS {
            job.no(SaidNo::TooFast);
        } else {
            self.waiting.push_back(job);
        }
    }

    /// Begins the next jobs until one has to wait for the store.
    pub(super) fn start_saving(&mut self) {
        while self.saving.is_none() && !self.waiting.is_empty() {
            if let Some(no) = self.hub.health.away() {
                self.waiting.drain(..).for_each(|job| job.no(no.clone()));
                return;
            }
            if self.uncertain {
                let (hub, id) = (Arc::clone(&self.hub), self.id.clone());
                self.saving = Some(Box::pin(saving::catch_up(hub, id, self.room.revision())));
                return;
            }
            match self.waiting.pop_front() {
                Some(Job::Save(change, from)) => self.decide(change, from),
                Some(Job::Remove(by, from)) => {
                    let (hub, id) = (Arc::clone(&self.hub), self.id.clone());
                    self.saving = Some(Box::pin(saving::remove(hub, id, by, from)));
                }
                None => {}
            }
        }
    }

    fn decide(&mut self, change: Change, from: Answer) {
        if let Some(stranger) = self.stranger(&change) {
            return from.no(SaidNo::Change(Refusal::Malformed(stranger)));
        }
        let (hub, id) = (Arc::clone(&self.hub), self.id.clone());
        match self.room.propose(crate::now_ms(), change.clone(), &*self.hub.knowing) {
            Decision::Save(committed) => {
                let helpers = helpers_let_go(&committed.change);
                let mut after = self.room.behaviour().clone();
                after.apply(&committed.change);
                let keep = Keep { committed, after, helpers };
                self.saving = Some(Box::pin(saving::save(hub, id, keep, from)));
            }
            Decision::Duplicate(revision) => match self.log.iter().find(|known| known.revision == revision) {
                Some(known) => from.give(Reply::Accepted { behaviour: id, accepted: known.clone() }),
                None => self.saving = Some(Box::pin(saving::repeat(hub, id, revision, from))),
            },
            Decision::Refuse(refusal @ Refusal::Stale(_)) => {
                self.saving = Some(Box::pin(saving::settle(hub, id, change, refusal, from)));
            }
            Decision::Refuse(refusal) => from.no(SaidNo::Change(refusal)),
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
                if let Some(job) = self.waiting.pop_front() {
                    job.no(no);
                }
            }
            Saved::Removed { outcome: Ok(()), from, by } => self.removed(&by, from),
            Saved::Removed { outcome: Err(no), from, .. } => from.no(no),
        }
    }

    /// Tells the news; who asked gets the answer once: with the news if they are here and it is among them.
    fn conclude(&mut self, news: &[behaviour::Committed], answer: Result<behaviour::Accepted, SaidNo>, from: Answer) {
        let here = from.session().filter(|session| self.members.contains_key(session));
        let asked =
            if let (Some(session), Answer::Client(_, ask)) = (here, &from) { Some((session, *ask)) } else { None };
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
        self.gone = true;
        std::mem::take(&mut self.waiting).into_iter().for_each(|job| job.no(SaidNo::NoBehaviour));
        self.hub.programs.tell();
        from.give(Reply::Done);
        self.tell_removed(by);
    }
}

/// The helpers that would no longer be there under their name.
fn helpers_let_go(change: &Change) -> Vec<String> {
    let mut gone = Vec::new();
    for edit in &change.edits {
        if let Some(Record::Helper(before)) = &edit.before {
            let stays = matches!(&edit.after, Some(Record::Helper(after)) if after.name == before.name);
            if !stays {
                gone.push(before.name.clone());
            }
        }
    }
    gone
}
