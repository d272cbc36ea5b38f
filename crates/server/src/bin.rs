//! The bin: what has been in it for too long goes for ever, at the start and once a day.

use crate::hub::{Hub, bounded};
use std::sync::Arc;
use std::time::Duration;
use store::{Store, StoreError};

/// How long a removed behaviour can be taken back.
const BIN_DAYS: u64 = 30;
const DAY_MS: u64 = 24 * 60 * 60 * 1_000;

/// Empties the bin now and then until the server ends.
pub(crate) fn keep(hub: &Arc<Hub>) {
    let hub = Arc::clone(hub);
    hub.clone().tasks.spawn(async move {
        let mut beat = tokio::time::interval(Duration::from_millis(DAY_MS));
        while hub.stopping.run_until_cancelled(beat.tick()).await.is_some() {
            match empty(&*hub.store, crate::now_ms()).await {
                Ok(0) => {}
                Ok(gone) => {
                    tracing::info!(gone, "behaviours were in the bin for {BIN_DAYS} days and are deleted");
                    hub.programs.tell();
                }
                Err(error) => tracing::warn!(%error, "the bin could not be emptied; it is tried again tomorrow"),
            }
        }
    });
}

/// Deletes what went to the bin [`BIN_DAYS`] before `now_ms`, or earlier; says how many.
async fn empty(store: &dyn Store, now_ms: u64) -> Result<u32, StoreError> {
    bounded(store.purge(now_ms.saturating_sub(BIN_DAYS * DAY_MS))).await
}

#[cfg(test)]
mod tests {
    use super::{BIN_DAYS, DAY_MS, empty};
    use behaviour::{Behaviour, Change, Committed, Id, Record, RecordId, Settings};
    use store::{MemoryStore, Store};

    #[tokio::test]
    async fn what_is_in_the_bin_for_thirty_days_goes() {
        let (store, id) = (MemoryStore::new(), Id::new("old").unwrap());
        let named = Record::Settings(Settings::named("Old"));
        let change = Change::of(id.clone(), "Aiko", "Add").put(&Behaviour::default(), RecordId::settings(), named);
        let mut after = Behaviour::default();
        after.apply(&change);
        store.append(&id, &Committed { revision: 1, change }, &after).await.unwrap();
        assert!(store.remove(&id, 1_000, "Aiko").await.unwrap());
        assert_eq!(empty(&store, 1_000 + BIN_DAYS * DAY_MS).await.unwrap(), 0);
        assert!(store.load(&id).await.unwrap().is_some());
        assert_eq!(empty(&store, 1_001 + BIN_DAYS * DAY_MS).await.unwrap(), 1);
        assert!(store.load(&id).await.unwrap().is_none());
    }
}
