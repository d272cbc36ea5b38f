//! The bin: what has been in it for too long goes for ever.
//!
//! A clock may be wrong: a computer that starts forty days ahead would find everything in the bin too old. So nothing is
//! deleted on the word of one look at the clock. Each server remembers in its data folder when it last looked, and deletes
//! only what was too old at that earlier look already, if that was at least a day ago. If a look finds the clock before
//! the earlier one, the earlier one was wrong and is forgotten. It does not matter which store keeps the behaviours.

use super::LibraryService;
use crate::support::atomic_file;
use crate::support::store_call::{bounded, store_no};
use behaviour::Id;
use phrase::phrase;
use protocol::Refused;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use store::{Store, StoreError};

/// How long a removed behaviour can be taken back.
const BIN_DAYS: u64 = 30;
const DAY_MS: u64 = 24 * 60 * 60 * 1_000;
/// How often the clock is looked at.
const LOOK_MS: u64 = 60 * 60 * 1_000;
/// The file in the data folder with the earlier look, in milliseconds since 1970.
const FILE: &str = "bin-looked.json";

/// Empties the bin now and then until the server ends.
pub(crate) fn keep(library: &Arc<LibraryService>, data: Option<&Path>) {
    let (library, mut looks) = (Arc::clone(library), Looks::within(data));
    library.clone().tasks.spawn(async move {
        let mut beat = tokio::time::interval(Duration::from_millis(LOOK_MS));
        while library.tasks.until_end(beat.tick()).await.is_some() {
            match empty(&*library.store, &mut looks, crate::support::now_ms()).await {
                Ok(0) => {}
                Ok(gone) => {
                    tracing::info!(gone, "behaviours were in the bin for {BIN_DAYS} days and are deleted");
                    library.rooms.news().tell();
                }
                Err(error) => tracing::warn!(%error, "the bin could not be emptied; it is tried again in an hour"),
            }
        }
    });
}

/// Takes a behaviour back out of the bin.
///
/// # Errors
/// If it is not there, or the store does not answer.
pub(crate) async fn restore(library: &LibraryService, behaviour: &Id) -> Result<(), Refused> {
    let back = bounded(library.store.restore(behaviour)).await.map_err(|error| store_no(&error))?;
    library.rooms.news().tell();
    if back { Ok(()) } else { Err(Refused::NoBehaviour) }
}

/// Deletes what was in the bin for [`BIN_DAYS`] at the earlier look already; says how many.
async fn empty(store: &dyn Store, looks: &mut Looks, now_ms: u64) -> Result<u32, StoreError> {
    let unkept = |error: std::io::Error| {
        StoreError::Unavailable(phrase!("server.cannot_be_written", "{FILE} cannot be written ({error})"))
    };
    match looks.look(now_ms).map_err(unkept)? {
        Some(earlier_ms) => bounded(store.purge(earlier_ms.saturating_sub(BIN_DAYS * DAY_MS))).await,
        None => Ok(0),
    }
}

/// When the clock was looked at.
struct Looks {
    path: Option<PathBuf>,
    earlier_ms: Option<u64>,
}

impl Looks {
    /// What is remembered in a data folder; without a folder it lasts as long as the server.
    fn within(data: Option<&Path>) -> Self {
        let path = data.map(|data| data.join(FILE));
        Self { earlier_ms: path.as_deref().and_then(atomic_file::read), path }
    }

    /// Looks at the clock; answers with an earlier look, if it was at least a day before and so agrees with this one.
    fn look(&mut self, now_ms: u64) -> std::io::Result<Option<u64>> {
        match self.earlier_ms {
            Some(earlier_ms) if (earlier_ms..earlier_ms.saturating_add(DAY_MS)).contains(&now_ms) => Ok(None),
            earlier_ms => {
                self.remember(now_ms)?;
                Ok(earlier_ms.filter(|earlier_ms| *earlier_ms < now_ms))
            }
        }
    }

    fn remember(&mut self, now_ms: u64) -> std::io::Result<()> {
        self.path.as_ref().map_or(Ok(()), |path| atomic_file::put(path, &now_ms.to_string()))?;
        self.earlier_ms = Some(now_ms);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{BIN_DAYS, DAY_MS, Looks, empty};
    use behaviour::{Behaviour, Change, Committed, Id, Record, RecordId, Settings};
    use std::path::Path;
    use store::{MemoryStore, Store};

    const BIN_MS: u64 = BIN_DAYS * DAY_MS;
    const REMOVED_MS: u64 = 100 * DAY_MS;

    /// A store with one behaviour, in the bin since [`REMOVED_MS`].
    async fn binned() -> MemoryStore {
        let (store, id) = (MemoryStore::new(), Id::new("old").unwrap());
        let named = Record::Settings(Settings::named("Old"));
        let change = Change::of(id.clone(), "Aiko", "Add").put(&Behaviour::default(), RecordId::settings(), named);
        let mut after = Behaviour::default();
        after.apply(&change);
        store.append(&id, &Committed { revision: 1, change }, &after).await.unwrap();
        assert!(store.remove(&id, REMOVED_MS, "Aiko").await.unwrap());
        store
    }

    /// A start of a server at that time: how many go.
    async fn start(store: &MemoryStore, data: &Path, now_ms: u64) -> u32 {
        empty(store, &mut Looks::within(Some(data)), now_ms).await.unwrap()
    }

    #[tokio::test]
    async fn what_is_in_the_bin_for_thirty_days_goes_when_two_looks_a_day_apart_agree() {
        let (store, data) = (binned().await, tempfile::tempdir().unwrap());
        let due_ms = REMOVED_MS + BIN_MS;
        assert_eq!(start(&store, data.path(), due_ms).await, 0);
        assert_eq!(start(&store, data.path(), due_ms + DAY_MS).await, 0, "at the first look it was not too old");
        assert_eq!(start(&store, data.path(), due_ms + 2 * DAY_MS - 1).await, 0, "that is less than a day later");
        assert_eq!(start(&store, data.path(), due_ms + 2 * DAY_MS).await, 1);
    }

    #[tokio::test]
    async fn a_clock_that_was_ahead_deletes_nothing() {
        let (store, data) = (binned().await, tempfile::tempdir().unwrap());
        let (today, ahead) = (REMOVED_MS + DAY_MS, REMOVED_MS + 41 * DAY_MS);
        for now_ms in [today, ahead, ahead + DAY_MS - 1, today + 1, ahead, today + DAY_MS + 1, today + BIN_MS / 2] {
            assert_eq!(start(&store, data.path(), now_ms).await, 0, "at {now_ms}");
        }
        assert!(store.load(&Id::new("old").unwrap()).await.unwrap().is_some());
    }

    #[tokio::test]
    async fn a_server_that_runs_on_empties_it_too() {
        let (store, mut looks) = (binned().await, Looks::within(None));
        let mut gone_at = None;
        for hour in 0..24 * 40 {
            let now_ms = REMOVED_MS + hour * DAY_MS / 24;
            if empty(&store, &mut looks, now_ms).await.unwrap() > 0 {
                gone_at = Some(hour / 24);
            }
        }
        assert_eq!(gone_at, Some(BIN_DAYS + 2));
    }
}
