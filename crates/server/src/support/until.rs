//! A time after which work for people ends.

use std::time::{Duration, Instant};
use tokio_util::sync::CancellationToken;

/// Until when something is worked on, and if somebody still waits for it.
pub(crate) struct Until<'a> {
    at: Instant,
    token: &'a CancellationToken,
}

impl<'a> Until<'a> {
    pub(crate) fn after(ms: u64, token: &'a CancellationToken) -> Self {
        Self { at: Instant::now() + Duration::from_millis(ms), token }
    }

    pub(crate) fn goes_on(&self) -> bool {
        !self.token.is_cancelled() && Instant::now() < self.at
    }

    /// Returns what tells a run that it is over, from wherever it is.
    pub(crate) fn hook(&self) -> impl Fn() -> bool + 'static {
        let (at, token) = (self.at, self.token.clone());
        move || token.is_cancelled() || Instant::now() >= at
    }
}
