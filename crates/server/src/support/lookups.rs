//! Turns for what is looked up in the store for who asks: few at once, so that what was found and is not told yet stays
//! little, however many ask.

use std::sync::Arc;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Lookups at once.
const AT_ONCE_MAX: usize = 16;

/// Behaviours as they were that are found out at once; each takes memory of its own.
const REPLAYS_AT_ONCE_MAX: usize = 2;

/// The turns. A clone is the same turns.
#[derive(Clone, Debug)]
pub(crate) struct Lookups(Arc<Semaphore>);

impl Default for Lookups {
    fn default() -> Self {
        Self(Arc::new(Semaphore::new(AT_ONCE_MAX)))
    }
}

impl Lookups {
    /// Turns for finding out how behaviours were.
    pub(crate) fn of_replays() -> Self {
        Self(Arc::new(Semaphore::new(REPLAYS_AT_ONCE_MAX)))
    }

    /// Waits for a turn, first come first served; it ends with what is returned.
    pub(crate) async fn turn(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.0).acquire_owned().await.ok()
    }
}
