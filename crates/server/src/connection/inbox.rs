//! What one client asked and what is not done yet: in order, bounded in number and bytes, for each and for all together.

use axum::extract::ws::Utf8Bytes;
use protocol::Ask;
use std::sync::Arc;
use tokio::sync::{OwnedSemaphorePermit, Semaphore, mpsc};

/// Requests of one client that may wait.
const WAITING_MAX: usize = 256;
/// What large messages of one client may take until they are answered, in KiB.
const CLIENT_MAX_KIB: usize = 1_024;
/// What large messages of all clients may take, in KiB.
const ALL_MAX_KIB: usize = 24 * 1_024;

/// A request that waits.
pub(super) enum Asked {
    /// It is read already.
    Small(Box<Ask>),
    /// It has to be read first, away from the threads that carry messages.
    Large(Utf8Bytes, Weight),
}

/// The room that a large message takes, free again with its end.
#[derive(Debug)]
pub(crate) struct Weight {
    _own: OwnedSemaphorePermit,
    _of_all: OwnedSemaphorePermit,
}

/// The room for the large messages of all clients.
#[derive(Debug)]
pub(crate) struct Weights(Arc<Semaphore>);

impl Default for Weights {
    fn default() -> Self {
        Self(Arc::new(Semaphore::new(ALL_MAX_KIB)))
    }
}

/// The way in.
pub(super) struct Inbox {
    queue: mpsc::Sender<Asked>,
    own: Arc<Semaphore>,
}

/// An inbox and its other end.
pub(super) fn inbox() -> (Inbox, mpsc::Receiver<Asked>) {
    let (queue, asked) = mpsc::channel(WAITING_MAX);
    (Inbox { queue, own: Arc::new(Semaphore::new(CLIENT_MAX_KIB)) }, asked)
}

impl Inbox {
    /// Puts a request in; false if there is no room.
    pub(super) fn ask(&self, ask: Ask) -> bool {
        self.queue.try_send(Asked::Small(Box::new(ask))).is_ok()
    }

    /// Puts a message in that has to be read yet; false if there is no room.
    pub(super) fn large(&self, text: Utf8Bytes, all: &Weights) -> bool {
        let kib = u32::try_from(text.len() >> 10).unwrap_or(u32::MAX).saturating_add(1);
        let Ok(own) = Arc::clone(&self.own).try_acquire_many_owned(kib) else { return false };
        let Ok(of_all) = Arc::clone(&all.0).try_acquire_many_owned(kib) else { return false };
        self.queue.try_send(Asked::Large(text, Weight { _own: own, _of_all: of_all })).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::{CLIENT_MAX_KIB, WAITING_MAX, Weights, inbox};
    use protocol::{Ask, Request};

    #[test]
    fn what_waits_is_bounded_in_number_and_bytes() {
        let (weights, (own, mut asked), (other, _asked)) = (Weights::default(), inbox(), inbox());
        let text = || "x".repeat(200 << 10).into();
        let taken = (0..100).filter(|_| own.large(text(), &weights)).count();
        assert_eq!(taken, CLIENT_MAX_KIB / 201);
        assert!(other.large(text(), &weights), "others have room of their own");
        drop(asked.try_recv());
        assert!(own.large(text(), &weights), "what is done makes room");
        let small = (0..1_000).filter(|ask| own.ask(Ask { ask: *ask, request: Request::Runs })).count();
        assert_eq!(small, WAITING_MAX - taken);
    }
}
