//! The problems of a behaviour: found again after changes to it or to the library, away from the threads that carry
//! messages, and told when they differ.

use super::RoomTask;
use crate::support::message::encode;
use crate::support::workers::{CancelFlag, NotDone, Sender};
use behaviour::{BehaviourFile, Problem};
use protocol::Reply;
use std::sync::Arc;

/// What was found out about one revision.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    revision: u64,
    /// Its problems.
    pub(super) problems: Vec<Problem>,
    /// What would run.
    pub(super) fingerprint: u32,
}

impl RoomTask {
    /// Once before anybody is let in.
    pub(super) async fn find_problems_at_first(&mut self) {
        self.problems_due = !self.is_library();
        self.start_finding();
        if let Some(finding) = self.finding.take() {
            self.found_problems(finding.await);
        }
    }

    /// Begins to look for problems, if that is due and not under way.
    pub(super) fn start_finding(&mut self) {
        if !self.problems_due || self.finding.is_some() {
            return;
        }
        self.problems_due = false;
        let (knowing, shelf) = (Arc::clone(&self.hub.knowing), self.shelf.borrow_and_update().clone());
        let room = Arc::clone(&self.room);
        let find = move |_: &CancelFlag| {
            let (behaviour, helpers) = (room.behaviour(), shelf.helpers());
            let problems = behaviour::problems(behaviour, &helpers, &*knowing);
            let fingerprint = BehaviourFile::of(behaviour, &helpers).fingerprint();
            Found { revision: room.revision(), problems, fingerprint }
        };
        let (workers, sender) = (self.hub.workers.clone(), Sender::Room(self.id.clone()));
        self.finding = Some(Box::pin(async move { workers.run(sender, find).await }));
    }

    /// They are found.
    pub(super) fn found_problems(&mut self, found: Result<Found, NotDone>) {
        match found {
            Ok(found) => {
                let Found { revision, problems, fingerprint } = found.clone();
                self.found = found;
                let reply = Reply::Problems { behaviour: self.id.clone(), revision, problems, fingerprint };
                self.problems_text.send_replace(encode(None, reply));
            }
            // When it is the turn of something else, it is tried again.
            Err(NotDone::TooMuch) => self.problems_due = true,
            Err(NotDone::Failed) => tracing::error!(behaviour = %self.id, "the problems could not be found"),
        }
    }
}
