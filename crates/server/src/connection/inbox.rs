//! What one client asked and what is not done yet: in order, bounded in number and bytes.

use super::budgets::{PersonBudget, Weight};
use axum::extract::ws::Utf8Bytes;
use protocol::Ask;
use tokio::sync::mpsc;

/// Requests of one client that may wait.
const WAITING_MAX: usize = 256;

/// A request that waits.
pub(super) enum WaitingRequest {
    /// It is read already.
    Small(Box<Ask>),
    /// It has to be read first, away from the threads that carry messages.
    Large(Utf8Bytes, Weight),
}

/// The way in.
pub(super) struct Inbox(mpsc::Sender<WaitingRequest>);

/// An inbox and its other end.
pub(super) fn inbox() -> (Inbox, mpsc::Receiver<WaitingRequest>) {
    let (queue, asked) = mpsc::channel(WAITING_MAX);
    (Inbox(queue), asked)
}

impl Inbox {
    /// Puts a request in; false if there is no room.
    pub(super) fn ask(&self, ask: Ask) -> bool {
        self.0.try_send(WaitingRequest::Small(Box::new(ask))).is_ok()
    }

    /// Puts a message in that has to be read yet; false if there is no room.
    pub(super) fn large(&self, text: Utf8Bytes, budget: &PersonBudget) -> bool {
        let Some(weight) = budget.weigh(text.len()) else { return false };
        self.0.try_send(WaitingRequest::Large(text, weight)).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::{WAITING_MAX, inbox};
    use crate::connection::budgets::Budgets;
    use crate::support::identity::PersonIdentity;
    use protocol::{Ask, request};

    #[test]
    fn what_waits_is_bounded_in_number_and_bytes() {
        let (budgets, (own, mut asked), (other, _asked)) = (Budgets::default(), inbox(), inbox());
        let [mine, theirs] = [(); 2].map(|()| budgets.of(&PersonIdentity::Host));
        let text = || "x".repeat(200 << 10).into();
        let taken = (0..100).filter(|_| own.large(text(), &mine)).count();
        assert_eq!(taken, 5);
        assert!(other.large(text(), &theirs), "others have room of their own");
        drop(asked.try_recv());
        assert!(own.large(text(), &mine), "what is done makes room");
        let small = (0..1_000).filter(|ask| own.ask(Ask::new(*ask, request::Runs {}))).count();
        assert_eq!(small, WAITING_MAX - taken);
    }
}
