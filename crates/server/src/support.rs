//! What every part leans on and that leans on none of them: the time, locks, workers, files and calls of the store.

pub(crate) mod atomic_file;
pub(crate) mod data_folder;
pub(crate) mod digest;
pub(crate) mod fair_places;
pub(crate) mod fair_queue;
pub(crate) mod file_name;
pub(crate) mod identity;
pub(crate) mod lookups;
pub(crate) mod message;
pub(crate) mod places;
pub(crate) mod priority;
pub(crate) mod retry;
pub(crate) mod shares;
pub(crate) mod store_call;
pub(crate) mod store_health;
pub(crate) mod tasks;
pub(crate) mod turns;
pub(crate) mod until;
pub(crate) mod workers;

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Milliseconds since 1970.
pub(crate) fn now_ms() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO);
    u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
}

/// Locks for a few lines without waiting inside; a panic elsewhere does not matter to what these locks hold.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
