//! The problems of a behaviour: found again after changes to it or to the library, away from the threads that carry
//! messages, and told when they differ.

use super::RoomTask;
use crate::support::identity::Sender;
use crate::support::message::encode;
use crate::support::workers::WorkNotDone;
use behaviour::{BehaviourFile, Problem};
use futures_util::future::BoxFuture;
use protocol::Event;
use std::sync::Arc;
use tokio_util::sync::CancellationToken;

/// What was found out about one revision.
#[derive(Clone, Debug, Default)]
pub(super) struct FoundProblems {
    revision: u64,
    /// Its problems.
    pub(super) problems: Vec<Problem>,
    /// What would run.
    pub(super) fingerprint: u32,
}

/// True if the problems that were found are those of the newest revision.
pub(super) enum Finding {
    /// They are.
    Current,
    /// They have to be looked for.
    Due,
    /// They are being looked for.
    UnderWay(BoxFuture<'static, Result<FoundProblems, WorkNotDone>>),
    /// They are being looked for, and something changed since that began.
    Overtaken(BoxFuture<'static, Result<FoundProblems, WorkNotDone>>),
}

impl Finding {
    /// Something changed: they have to be looked for, once more if they are being looked for just now.
    pub(super) fn mark_due(&mut self) {
        *self = match std::mem::replace(self, Self::Due) {
            Self::Current | Self::Due => Self::Due,
            Self::UnderWay(work) | Self::Overtaken(work) => Self::Overtaken(work),
        };
    }

    /// Waits for what is being looked for, else for ever.
    pub(super) async fn answer(&mut self) -> Result<FoundProblems, WorkNotDone> {
        let (found, next) = match self {
            Self::UnderWay(work) => (work.await, Self::Current),
            Self::Overtaken(work) => (work.await, Self::Due),
            Self::Current | Self::Due => std::future::pending().await,
        };
        *self = next;
        found
    }
}

impl RoomTask {
    /// Once before anybody is let in.
    pub(super) async fn find_problems_at_first(&mut self) {
        if !self.is_library() {
            self.finding = Finding::Due;
            self.start_finding();
            let found = self.finding.answer().await;
            self.found_problems(found);
        }
    }

    /// Begins to look for problems, if that is due and not under way.
    pub(super) fn start_finding(&mut self) {
        let Finding::Due = self.finding else { return };
        let (knowing, snapshot) = (Arc::clone(&self.around.knowing), self.snapshot.borrow_and_update().clone());
        let room = Arc::clone(&self.room);
        let find = move |_: &CancellationToken| {
            let (behaviour, helpers) = (room.behaviour(), snapshot.helpers());
            let problems = behaviour::problems(behaviour, &helpers, &*knowing);
            let fingerprint = BehaviourFile::of(behaviour, &helpers).fingerprint();
            FoundProblems { revision: room.revision(), problems, fingerprint }
        };
        let (workers, sender) = (self.around.workers.clone(), Sender::Room(self.id.clone()));
        self.finding = Finding::UnderWay(Box::pin(async move { workers.run(sender, find).await }));
    }

    /// They are found.
    pub(super) fn found_problems(&mut self, found: Result<FoundProblems, WorkNotDone>) {
        match found {
            Ok(found) => {
                let FoundProblems { revision, problems, fingerprint } = found.clone();
                self.found = found;
                let event = Event::Problems { behaviour: self.id.clone(), revision, problems, fingerprint };
                self.problems_text.send_replace(encode(event));
            }
            // When it is the turn of something else, it is tried again.
            Err(WorkNotDone::TooMuch) => self.finding.mark_due(),
            Err(WorkNotDone::Failed) => tracing::error!(behaviour = %self.id, "the problems could not be found"),
        }
    }
}
