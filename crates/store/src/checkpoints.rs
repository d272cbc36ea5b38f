//! Revisions with a name, as all stores keep them.

use crate::{StoreError, json};
use behaviour::Checkpoint;

/// Checks that a store can keep it.
pub(crate) fn check(checkpoint: &Checkpoint) -> Result<(), StoreError> {
    json::check_time(checkpoint.at_ms)
}

/// Orders names by revision, then as they were given.
pub(crate) fn in_order(mut kept: Vec<Checkpoint>) -> Vec<Checkpoint> {
    kept.sort_by(|a, b| (a.revision, a.at_ms, &a.name).cmp(&(b.revision, b.at_ms, &b.name)));
    kept
}
