//! Tasks that live until the server ends.

use std::future::Future;
use tokio::runtime::Handle;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

/// Where tasks are started, and how they learn that the server ends. A clone is the same tasks.
#[derive(Clone, Debug)]
pub(crate) struct Tasks {
    /// What is under way.
    pub(crate) tracker: TaskTracker,
    /// The threads on which everything is done that is not carrying messages.
    pub(crate) runtime: Handle,
    /// Ends sockets, then rooms.
    pub(crate) stopping: CancellationToken,
}

impl Tasks {
    /// On the threads of the runtime that calls this.
    pub(crate) fn here() -> Self {
        Self { tracker: TaskTracker::new(), runtime: Handle::current(), stopping: CancellationToken::new() }
    }

    /// Starts a task on the threads that do not carry messages.
    pub(crate) fn spawn<T: Send + 'static>(&self, work: impl Future<Output = T> + Send + 'static) -> JoinHandle<T> {
        self.tracker.spawn_on(work, &self.runtime)
    }

    /// True once the server ends.
    pub(crate) fn ends(&self) -> bool {
        self.stopping.is_cancelled()
    }

    /// Waits for something; none if the server ends before that.
    pub(crate) async fn until_end<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.stopping.run_until_cancelled(work).await
    }
}
