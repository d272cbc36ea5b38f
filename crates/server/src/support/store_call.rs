//! Calls of the store that end in time, and its faults as clients hear of them.

use protocol::Refused;
use std::future::Future;
use std::time::Duration;
use store::StoreError;

/// How long the store may take for one answer.
const STORE_MS: u64 = 5_000;

/// Waits for the store, but not for ever.
pub(crate) async fn bounded<T>(answer: impl Future<Output = Result<T, StoreError>>) -> Result<T, StoreError> {
    match tokio::time::timeout(Duration::from_millis(STORE_MS), answer).await {
        Ok(answer) => answer,
        Err(_) => Err(StoreError::Timeout),
    }
}

/// The store's sentence as a client gets it.
pub(crate) fn store_no(error: &StoreError) -> Refused {
    Refused::Store(reason(error))
}

/// A sentence as a reason in parentheses: without its full stop.
pub(crate) fn reason(error: &StoreError) -> String {
    error.to_string().trim_end_matches('.').to_owned()
}
