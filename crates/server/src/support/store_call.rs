//! Calls of the store that end in time, and its faults as clients hear of them.

use phrase::{Phrase, Phrased};
use protocol::Refused;
use std::future::Future;
use std::time::Duration;
use store::StoreError;
use tokio::time::{Instant, timeout_at};

/// How long the store may take for one answer. People in the page are answered within 3 s.
const STORE_MS: u64 = 2_900;
/// How long it may take for all that one edit needs, tried again or not: the rest of the 3 s is for deciding.
const EDIT_MS: u64 = 2_800;

tokio::task_local! {
    /// When the work that goes on is to be answered.
    static ANSWER_BY: Instant;
}

/// When an edit that is begun now is to be answered.
pub(crate) fn answer_by() -> Instant {
    Instant::now() + Duration::from_millis(EDIT_MS)
}

/// Does some work of which every call of the store, however many there are, ends by then.
pub(crate) fn by<T>(answer_by: Instant, work: impl Future<Output = T>) -> impl Future<Output = T> {
    ANSWER_BY.scope(answer_by, work)
}

/// Waits for the store, but not for ever.
pub(crate) async fn bounded<T>(answer: impl Future<Output = Result<T, StoreError>>) -> Result<T, StoreError> {
    let most = Instant::now() + Duration::from_millis(STORE_MS);
    let end = ANSWER_BY.try_with(|by| most.min(*by)).unwrap_or(most);
    timeout_at(end, answer).await.unwrap_or(Err(StoreError::Timeout))
}

/// The store's sentence as a client gets it.
pub(crate) fn store_no(error: &StoreError) -> Refused {
    Refused::Store(reason(error))
}

/// A sentence as a reason in parentheses: without its full stop.
pub(crate) fn reason(error: &StoreError) -> Phrase {
    error.phrase()
}
