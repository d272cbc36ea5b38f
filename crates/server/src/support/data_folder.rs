//! The folder with recordings, robots and orders: one server at a time, and none on what a restore left half done.

use crate::serve::Config;
use store::{FolderLock, StoreError};

/// Keeps other servers out of the data folder, for as long as what it answers with is held; none is needed where the
/// store, which is in the same folder, keeps them out already.
///
/// # Errors
/// [`StoreError::Busy`] if another server uses it, [`StoreError::HalfRestored`] if a restore into it did not end.
pub(crate) fn take(config: &Config) -> Result<Option<FolderLock>, StoreError> {
    let own = store::folder_of(&config.store);
    for folder in own.into_iter().chain(config.data.as_deref()) {
        store::backup::check_finished(folder)?;
    }
    let Some(data) = config.data.as_deref() else { return Ok(None) };
    if own.is_some_and(|own| store::is_same_folder(own, data)) {
        return Ok(None);
    }
    let lock = store::lock_folder(data)?;
    tracing::info!(folder = %data.display(), "recordings, robots and their orders are kept beside the store");
    Ok(Some(lock))
}

#[cfg(test)]
mod tests {
    use super::take;
    use crate::serve::Config;
    use std::path::Path;
    use store::StoreError;

    fn config(store: &str, data: &Path) -> Config {
        Config { listen: "127.0.0.1:0".parse().unwrap(), store: store.to_owned(), data: Some(data.to_owned()), seed: 1 }
    }

    #[test]
    fn two_servers_never_share_the_folder_beside_a_store() {
        let folder = tempfile::tempdir().unwrap();
        let first = config("bolt://one:7687", folder.path());
        let held = take(&first).unwrap();
        assert!(held.is_some());
        let second = take(&config("bolt://another:7687", folder.path()));
        assert_eq!(second.err(), Some(StoreError::Busy(folder.path().to_owned())));
        drop(held);
        assert!(take(&first).unwrap().is_some(), "it is free again");
    }

    #[test]
    fn the_folder_of_the_store_is_locked_by_the_store() {
        let folder = tempfile::tempdir().unwrap();
        let url = format!("sqlite:{}/.", folder.path().display());
        assert!(take(&config(&url, folder.path())).unwrap().is_none());
    }
}
