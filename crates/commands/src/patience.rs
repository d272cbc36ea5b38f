//! Waiting for a database that may have just started: bounded, and said on standard error.

use std::future::Future;
use std::io::Write;
use std::pin::Pin;
use std::sync::Arc;
use std::time::Duration;
use store::{Store, StoreError};
use tokio::time::Instant;

type OpeningAnswer<'a> = Pin<Box<dyn Future<Output = Result<Arc<dyn Store>, StoreError>> + 'a>>;

/// How long a command waits for a database to come.
const COMES_MAX: Duration = Duration::from_secs(60);
/// Between two attempts.
const PAUSE: Duration = Duration::from_secs(1);
/// How long a command may be silent before that is said.
const SILENT: Duration = Duration::from_secs(2);
/// Between two such lines.
const AGAIN: Duration = Duration::from_secs(10);

/// Opens a store; one that is elsewhere is waited for.
pub(crate) async fn opened<'a, F>(url: &str, attempt: impl Fn() -> F) -> Result<Arc<dyn Store>, StoreError>
where
    F: Future<Output = Result<Arc<dyn Store>, StoreError>> + 'a,
{
    // In a box, or else what waits for it would be too deep for the compiler.
    let attempt = || -> OpeningAnswer<'a> { Box::pin(attempt()) };
    if !is_elsewhere(url) {
        return attempt().await;
    }
    let end = Instant::now() + COMES_MAX;
    let silent =
        || Err(StoreError::Unavailable(format!("the database did not answer within {} s", COMES_MAX.as_secs()).into()));
    let waiting = async {
        loop {
            match tokio::time::timeout_at(end, attempt()).await.unwrap_or_else(|_| silent()) {
                Err(error) if error.is_open() && Instant::now() + PAUSE < end => {
                    say(&format!("{error} It is asked again for up to {} s.", COMES_MAX.as_secs()));
                    tokio::time::sleep(PAUSE).await;
                }
                answer => return answer,
            }
        }
    };
    told(url, waiting).await
}

/// Does some work, and says that it goes on while a database elsewhere takes long for it.
pub(crate) async fn told<T>(url: &str, work: impl Future<Output = T>) -> T {
    let mut work: Pin<Box<dyn Future<Output = T> + '_>> = Box::pin(work);
    if !is_elsewhere(url) {
        return work.await;
    }
    let (begun, mut silent) = (Instant::now(), SILENT);
    loop {
        match tokio::time::timeout(silent, &mut work).await {
            Ok(done) => return done,
            Err(_) => {
                silent = AGAIN;
                let so_far = begun.elapsed().as_secs();
                say(&format!("Waiting for the database, {so_far} s so far; one that has just started needs a while."));
            }
        }
    }
}

fn is_elsewhere(url: &str) -> bool {
    store::folder_of(url).is_none()
}

fn say(line: &str) {
    // Nobody may be listening.
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}
