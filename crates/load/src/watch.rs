//! Watching a load from outside, and ending it early.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tokio_util::sync::CancellationToken;

/// The progress of a load. A clone is of the same.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    acknowledged: Arc<AtomicU64>,
    pub(crate) ends: CancellationToken,
}

impl Watch {
    /// Edits that are saved by now.
    #[must_use]
    pub fn acknowledged(&self) -> u64 {
        self.acknowledged.load(Ordering::Relaxed)
    }

    /// No further edits are made, before the time of the plan is over.
    pub fn end(&self) {
        self.ends.cancel();
    }

    pub(crate) fn one_more(&self) {
        self.acknowledged.fetch_add(1, Ordering::Relaxed);
    }
}
