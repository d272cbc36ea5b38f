//! One server for one data directory.

use crate::StoreError;
use std::fs::{File, TryLockError};
use std::path::Path;

const LOCK: &str = "rrp.lock";

/// Makes the directory if need be and keeps every other server out of it for as long as the file is held.
pub(crate) fn lock(data_dir: &Path) -> Result<File, StoreError> {
    let unusable = |error: std::io::Error| StoreError::Unavailable(format!("{}: {error}", data_dir.display()));
    std::fs::create_dir_all(data_dir).map_err(unusable)?;
    let file = File::options().create(true).truncate(false).write(true).open(data_dir.join(LOCK)).map_err(unusable)?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StoreError::Busy(data_dir.to_owned())),
        Err(TryLockError::Error(error)) => Err(unusable(error)),
    }
}
