//! What a room does one after another: deciding about changes and saving them, and going to the bin.

use super::making;
use super::saving::{self, MadeChange, Proposal, SaveOutcome, Saved};
use super::waiting::{SavingJob, is_small};
use super::{RoomTask, Stay, naming};
use crate::rooms::member::AnswerTo;
use crate::support::store_call;
use behaviour::{Change, Kind, Presented, Refusal};
use futures_util::future::BoxFuture;
use phrase::{Phrase, Phrased};
use protocol::{Refused, answer};
use std::future::Future;
use std::sync::Arc;
use tokio::time::Instant;

/// Small changes that are saved together.
const TOGETHER_MAX_CHANGES: usize = 32;
/// What the behaviours after each of them may take together, in bytes.
const TOGETHER_MAX_BYTES: usize = 4 << 20;

/// What a room has to do with the store just now.
pub(super) enum SavingStage {
    /// Nothing, and the room knows all that is saved.
    Idle,
    /// Nothing, but the store may have more than the room knows: it is asked before anything else is saved.
    Uncertain,
    /// The store works on something.
    UnderWay(BoxFuture<'static, Saved>),
}

impl SavingStage {
    /// Work of the store that is to be answered by then.
    fn work(by: Instant, work: impl Future<Output = Saved> + Send + 'static) -> Self {
        Self::UnderWay(Box::pin(store_call::by(by, work)))
    }

    /// True if the store works on something.
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

impl RoomTask {
    pub(super) fn wait(&mut self, job: SavingJob) {
        if self.stay == Stay::Gone {
            job.no(Refused::NoBehaviour);
        } else if self.waiting.has_room(&job.sender()) {
            self.waiting.put(job);
        } else {
            job.no(Refused::TooFast);
        }
    }

    /// When what is begun now is to be answered: one time for all that a job needs.
    fn answer_by(&mut self) -> Instant {
        *self.answer_by.get_or_insert_with(store_call::answer_by)
    }

    /// Begins the next job: one at a time.
    pub(super) fn start_saving(&mut self) {
        while !self.saving.is_under_way() && !self.waiting.is_empty() {
            self.start_next();
        }
        if !self.saving.is_under_way() {
            self.answer_by = None;
        }
    }

    fn start_next(&mut self) {
        if let Some(no) = self.around.health.away() {
            return self.waiting.take_all().into_iter().for_each(|job| job.no(no.clone()));
        }
        let (around, id, by) = (Arc::clone(&self.around), self.id.clone(), self.answer_by());
        if let SavingStage::Uncertain = self.saving {
            self.saving = SavingStage::work(by, saving::catch_up(around, id, self.room.revision()));
            return;
        }
        match self.waiting.take() {
            Some(SavingJob::Save(proposal)) if is_small(&proposal.change) && !self.is_library() => {
                self.start_small(proposal)
            }
            Some(SavingJob::Save(proposal)) => self.start_change(proposal),
            Some(SavingJob::Make(wish, from)) => {
                let room = Arc::clone(&self.room);
                self.saving = SavingStage::work(by, making::make(around, id, room, wish, from));
            }
            Some(SavingJob::Name(what, from)) => {
                self.saving = SavingStage::work(by, naming::name(around, id, self.room.revision(), what, from));
            }
            Some(SavingJob::Remove(who, from)) => match self.locks.edited_by_others(&who.client, &self.room) {
                Some(locked) => from.no(Refused::Change(locked)),
                None => {
                    self.stay = Stay::Leaving;
                    self.saving = SavingStage::work(by, saving::remove(around, id, who.name, from));
                }
            },
            None => {}
        }
    }

    /// Others get no lock of what it touches until it is saved.
    fn start_change(&mut self, proposal: Proposal) {
        if let Some(stranger) = self.stranger(&proposal.change) {
            self.answer_by = None;
            return proposal.from.no(Refused::Change(Refusal::Malformed(stranger)));
        }
        let (around, id, by) = (Arc::clone(&self.around), self.id.clone(), self.answer_by());
        self.saving = match self.let_in(&proposal) {
            Ok(()) => SavingStage::work(by, saving::decide(around, id, Arc::clone(&self.room), proposal)),
            Err(locked) => {
                let Proposal { change, from, .. } = proposal;
                SavingStage::work(by, saving::refuse(around, id, change, locked, from))
            }
        };
    }

    /// Small changes that wait are saved together: what the store takes for one it takes for all of them.
    fn start_small(&mut self, first: Proposal) {
        if !self.is_let_in(&first) {
            return self.start_change(first);
        }
        let (mut all, most) = (vec![first], TOGETHER_MAX_BYTES / self.room.bytes().max(1));
        while all.len() < TOGETHER_MAX_CHANGES.min(most)
            && let Some(proposal) = self.waiting.take_small()
        {
            if !self.is_let_in(&proposal) {
                // It is refused alone, when it is its turn.
                self.waiting.put_back(SavingJob::Save(proposal));
                break;
            }
            all.push(proposal);
        }
        let (around, id, by) = (Arc::clone(&self.around), self.id.clone(), self.answer_by());
        self.saving = SavingStage::work(by, saving::decide_together(around, id, Arc::clone(&self.room), all));
    }

    /// True if a change belongs here and the locks let it in; then it is to be decided about.
    fn is_let_in(&mut self, proposal: &Proposal) -> bool {
        self.stranger(&proposal.change).is_none() && self.let_in(proposal).is_ok()
    }

    /// True if the locks let a change in, which is then decided about.
    fn let_in(&mut self, proposal: &Proposal) -> Result<(), Refusal> {
        let Proposal { change, tokens, from } = proposal;
        let member = from.session().and_then(|session| self.members.get(&session));
        let client = member.map(|member| member.person.client.clone());
        self.locks.begin(&self.room, change, &Presented { client, tokens: tokens.clone() })
    }

    /// A record that does not belong here: helpers live in the library, and nothing else does.
    fn stranger(&self, change: &Change) -> Option<Phrase> {
        let library = self.is_library();
        let stranger = change.edits.iter().find(|edit| (edit.id.kind == Kind::Helper) != library);
        stranger.map(|edit| edit.id.phrase())
    }

    /// The store answered.
    pub(super) fn saved(&mut self, saved: Saved) {
        let by = self.answer_by.take();
        match saved {
            Saved::Change { op, outcome, from } => {
                if outcome.is_uncertain {
                    self.saving = SavingStage::Uncertain;
                }
                self.conclude(outcome, from);
                self.locks.saved(&op);
                self.tell_locks();
            }
            Saved::Made { outcome, from } => match *outcome {
                Ok(MadeChange::New(change, tokens)) => {
                    self.answer_by = by;
                    self.start_change(Proposal { change, tokens, from });
                }
                Ok(MadeChange::Known(accepted)) => from.give(answer::Saved { revision: accepted.revision }),
                Err(no) => from.no(no),
            },
            Saved::Named { outcome, from } => self.named(outcome, from),
            Saved::Together { done, left } => {
                for (Proposal { change, from, .. }, outcome) in done {
                    if outcome.is_uncertain {
                        self.saving = SavingStage::Uncertain;
                    }
                    self.conclude(outcome, from);
                    self.locks.saved(&change.op);
                }
                for proposal in left.into_iter().rev() {
                    self.locks.saved(&proposal.change.op);
                    self.waiting.put_back(SavingJob::Save(proposal));
                }
                self.tell_locks();
            }
            Saved::CaughtUp(Ok(news)) => {
                self.answer_by = by;
                news.iter().for_each(|news| self.commit(news, None));
            }
            Saved::CaughtUp(Err(no)) => {
                self.saving = SavingStage::Uncertain;
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

    /// Tells the news, then answers: who asked and is here has heard of the change when they hear that it is saved.
    fn conclude(&mut self, outcome: SaveOutcome, from: AnswerTo<answer::Saved>) {
        let SaveOutcome { news, after, answer, .. } = outcome;
        news.iter().for_each(|one| self.commit(one, after.as_ref()));
        from.end(answer.map(|accepted| answer::Saved { revision: accepted.revision }));
    }

    fn removed(&mut self, by: &str, from: AnswerTo<()>) {
        tracing::info!(behaviour = %self.id, by, "a behaviour goes to the bin");
        self.stay = Stay::Gone;
        self.waiting.take_all().into_iter().for_each(|job| job.no(Refused::NoBehaviour));
        self.around.news.tell();
        from.give(());
        self.tell_removed(by);
    }
}
