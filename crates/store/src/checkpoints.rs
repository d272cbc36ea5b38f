//! Revisions with a name, as all stores keep them.

use crate::{StoreError, json};
use behaviour::Checkpoint;

/// Checks that a store can keep it.
pub(crate) fn check(checkpoint: &Checkpoint) -> Result<(), StoreError> {
    json::check_time(checkpoint.at_ms)
}

/// By revision, then in the order in which they were named.
pub(crate) fn in_order(mut kept: Vec<Checkpoint>) -> Vec<Checkpoint> {
    kept.sort_by(|a, b| (a.revision, a.at_ms, &a.name).cmp(&(b.revision, b.at_ms, &b.name)));
    kept
}
