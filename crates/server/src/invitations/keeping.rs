//! The one writer of what may be written later: what guests are called, and revocations that the book does not have yet. At
//! most once in a while and all together, tried again until it is written, and once more at the end of the server.

use super::Invitations;
use crate::support::identity::Sender;
use crate::support::tasks::Tasks;
use crate::support::workers::Workers;
use std::sync::Arc;
use std::time::Duration;

/// Between two times that it is written.
const WRITE_MS: u64 = 2_000;

/// Writes until the server ends.
pub(crate) fn keep(all: &Arc<Invitations>, files: &Workers, tasks: &Tasks) {
    let (all, files, ending) = (Arc::clone(all), files.clone(), tasks.clone());
    tasks.spawn(async move {
        while ending.until_end(all.is_due()).await.is_some()
            && ending.until_end(tokio::time::sleep(Duration::from_millis(WRITE_MS))).await.is_some()
        {
            write(&all, &files).await;
        }
        write(&all, &files).await;
    });
}

async fn write(all: &Arc<Invitations>, files: &Workers) {
    let writing = Arc::clone(all);
    if let Err(why) = files.run(Sender::Server, move |_| writing.write_due()).await {
        tracing::error!(?why, "invitations could not be written");
    }
}
