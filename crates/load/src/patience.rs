//! Asking again what the server refuses for a moment only.

use protocol::Refused;
use shell::ClientError;
use std::time::Duration;
use tokio::time::Instant;

/// The time for which a refused request is sent again until nobody waits for it any more.
pub(crate) const PATIENCE: Duration = Duration::from_secs(90);
/// Before a refused request is sent again.
const AGAIN: Duration = Duration::from_millis(20);

/// True if the same request may be granted a moment later.
pub(crate) fn passes(no: &Refused) -> bool {
    matches!(no, Refused::TooFast | Refused::Store(_))
}

/// Does it again, for 90 seconds, as long as the server says that it is asked too much or that its store is away: a store
/// that was just started answers its first questions late. What is done must be the same when it is done twice.
///
/// # Errors
/// Any other refusal, at once, and the last one where nobody waits any more.
pub async fn patiently<T, F: Future<Output = Result<T, ClientError>>>(act: impl Fn() -> F) -> Result<T, ClientError> {
    let until = Instant::now() + PATIENCE;
    loop {
        match act().await {
            Err(ClientError::No(no)) if passes(&no) && Instant::now() < until => tokio::time::sleep(AGAIN).await,
            other => return other,
        }
    }
}
