//! The gate between a run and the robot: once closed, nothing of the run reaches the robot any more.

use std::sync::atomic::{AtomicBool, Ordering};

/// Open while a run may move the robot. Closing needs no lock, and what was sent before is void from then on.
#[derive(Debug, Default)]
pub(super) struct Gate {
    closed: AtomicBool,
}

impl Gate {
    /// Closes it for good; true if it was open.
    pub(super) fn close(&self) -> bool {
        !self.closed.swap(true, Ordering::SeqCst)
    }

    /// Whether commands still pass.
    pub(super) fn is_open(&self) -> bool {
        !self.closed.load(Ordering::SeqCst)
    }
}
