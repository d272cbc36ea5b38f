//! Waiting at the start for a database of its own, which may start with us or still be warming up.

use futures_util::future::BoxFuture;
use std::time::Duration;
use store::StoreError;
use tokio::time::Instant;

/// How long a server waits for its database at the start.
const WAIT: Duration = Duration::from_secs(60);
/// How long a database may be silent before that is said, and between two such sentences.
const SILENT: Duration = Duration::from_millis(1_500);
/// Between two attempts.
const PAUSE: Duration = Duration::from_secs(1);

/// Does it again while the database is away, but not for ever. What is on this computer's disk is asked once.
pub(crate) async fn retry<'a, T>(
    url: &str,
    attempt: impl Fn() -> BoxFuture<'a, Result<T, StoreError>>,
) -> Result<T, StoreError> {
    retry_within(WAIT, PAUSE, url, attempt).await
}

async fn retry_within<'a, T>(
    wait: Duration,
    pause: Duration,
    url: &str,
    attempt: impl Fn() -> BoxFuture<'a, Result<T, StoreError>>,
) -> Result<T, StoreError> {
    let start = Instant::now();
    loop {
        match told_while_silent(attempt()).await {
            Err(error) if error.is_open() && url.contains("://") && start.elapsed() < wait => {
                tracing::warn!(%error, "the database is not ready yet; it is asked again");
                tokio::time::sleep(pause).await;
            }
            answer => return answer,
        }
    }
}

/// Says again and again that nobody answers, for as long as that is so.
async fn told_while_silent<T>(attempt: BoxFuture<'_, T>) -> T {
    let mut attempt = std::pin::pin!(attempt);
    loop {
        match tokio::time::timeout(SILENT, &mut attempt).await {
            Ok(answer) => return answer,
            Err(_) => {
                tracing::warn!("the store does not answer yet; look whether the database runs, and what holds it")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, WAIT, retry_within};
    use futures_util::FutureExt;
    use std::sync::atomic::{AtomicU32, Ordering};
    use store::StoreError;

    #[tokio::test]
    async fn a_database_is_waited_for_and_a_disk_is_not() {
        let asked = AtomicU32::new(0);
        let third =
            || async { if asked.fetch_add(1, Ordering::SeqCst) < 2 { Err(StoreError::Timeout) } else { Ok(()) } };
        let url = "bolt://127.0.0.1:7687";
        let (now, never) = (Duration::ZERO, Duration::ZERO);
        assert_eq!(retry_within(WAIT, now, url, || third().boxed()).await, Ok(()));
        assert_eq!(asked.load(Ordering::SeqCst), 3);
        let away = |error: StoreError| move || std::future::ready(Err::<(), _>(error.clone())).boxed();
        let late = away(StoreError::Timeout);
        assert_eq!(retry_within(never, now, url, &late).await, Err(StoreError::Timeout));
        assert_eq!(retry_within(WAIT, now, "/data", &late).await, Err(StoreError::Timeout));
        assert_eq!(retry_within(WAIT, now, url, away(StoreError::Gone)).await, Err(StoreError::Gone));
    }
}
