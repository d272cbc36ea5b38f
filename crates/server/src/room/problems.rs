//! The problems of a behaviour: found again after changes to it or to the library, away from the threads that carry
//! messages, and told when they differ.

use super::RoomTask;
use crate::outbox::encode;
use behaviour::Problem;
use protocol::Reply;
use std::sync::Arc;
use tokio::task::JoinError;

impl RoomTask {
    /// Once before anybody is let in.
    pub(super) async fn find_problems_at_first(&mut self) {
        self.problems_due = !self.is_library();
        self.start_finding();
        if let Some(finding) = self.finding.take() {
            self.found(finding.await);
        }
    }

    /// Begins to look for problems, if that is due and not under way.
    pub(super) fn start_finding(&mut self) {
        if !self.problems_due || self.finding.is_some() {
            return;
        }
        self.problems_due = false;
        let (knowing, shelf) = (Arc::clone(&self.hub.knowing), self.shelf.borrow_and_update().clone());
        let (behaviour, revision) = (self.room.behaviour().clone(), self.room.revision());
        let find = move || (revision, behaviour::problems(&behaviour, &shelf.helpers(), &*knowing));
        self.finding = Some(tokio::task::spawn_blocking(find));
    }

    /// They are found.
    pub(super) fn found(&mut self, found: Result<(u64, Vec<Problem>), JoinError>) {
        match found {
            Ok((revision, problems)) => {
                self.problems.clone_from(&problems);
                let reply = Reply::Problems { behaviour: self.id.clone(), revision, problems };
                self.problems_text.send_replace(encode(None, reply));
            }
            Err(error) => tracing::error!(behaviour = %self.id, %error, "the problems could not be found"),
        }
    }
}
