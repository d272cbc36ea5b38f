//! The contract of every store, as one suite that runs against any of them. It panics where a store breaks the
//! contract.

mod bin;
mod changes;
mod checkpoints;
mod crowd;
mod filling;
mod insight;
mod large;
mod lists;
mod random;
mod samples;
mod usage;

use crate::Store;
use std::future::Future;
use std::sync::Arc;

/// The number of runs of chance that a store goes through whose answers cost next to nothing.
pub const RUNS: u64 = 12;

/// Runs the whole suite, with this many runs of chance at its end; `make` gives a new empty store at each call.
///
/// # Panics
/// Panics where the store breaks the contract.
pub async fn check<F>(make: impl Fn() -> F, runs: u64)
where
    F: Future<Output = Arc<dyn Store>>,
{
    changes::check(&make).await;
    bin::check(&make).await;
    checkpoints::check(&make).await;
    filling::check(&make).await;
    usage::check(&make).await;
    lists::check(&make).await;
    insight::check(&make).await;
    crowd::check(&make).await;
    large::check(make().await.as_ref()).await;
    for seed in 0..runs {
        random::check(make().await.as_ref(), seed).await;
    }
    epochs_grow(make().await.as_ref()).await;
}

async fn epochs_grow(store: &dyn Store) {
    let mut last = 0;
    for _ in 0..3 {
        let next = store.next_epoch().await.expect("an epoch");
        assert!(next > last, "epoch {next} does not follow {last}");
        last = next;
    }
    for least in [1, last + 1_000] {
        store.raise_epoch(least).await.expect("an answer");
        let next = store.next_epoch().await.expect("an epoch");
        assert_eq!(next, last.max(least) + 1, "the next epoch after {last} and at least {least}");
        last = next;
    }
    store.healthy().await.expect("a new store is healthy");
}
