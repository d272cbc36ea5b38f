//! Whether the store can save: asked by writing, so once for all who ask at the same time, and not again for a moment.

use crate::support::store_call::bounded;
use std::sync::Arc;
use std::time::{Duration, Instant};
use store::{Store, StoreError};
use tokio::sync::Mutex;

/// How long an answer holds.
const HOLDS: Duration = Duration::from_secs(1);

/// What was found, and when.
type ReadinessFound = (Instant, Result<(), StoreError>);

/// What was found last. A clone is the same.
#[derive(Clone, Default)]
pub(super) struct Readiness(Arc<Mutex<Option<ReadinessFound>>>);

impl Readiness {
    /// Whether the store can save.
    ///
    /// # Errors
    /// Why not.
    pub(super) async fn ask(&self, store: &dyn Store) -> Result<(), StoreError> {
        let mut last = self.0.lock().await;
        match &*last {
            Some((at, found)) if at.elapsed() < HOLDS => found.clone(),
            _ => {
                let found = bounded(store.healthy()).await;
                *last = Some((Instant::now(), found.clone()));
                found
            }
        }
    }
}
