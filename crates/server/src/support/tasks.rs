//! Tasks that live until the server ends, and work as tokio gets it: of few types, as its machinery is compiled for each.
//! Each type of future costs the compiler some 2,800 lines of LLVM, so the server boxes its work: a fifth less to compile.

use crate::support::lock;
use std::future::Future;
use std::pin::Pin;
use std::sync::{Arc, Mutex};
use tokio::runtime::Handle;
use tokio::task::{JoinError, JoinHandle};
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

/// Work for a task, all of one type.
pub(crate) type TaskWork = Pin<Box<dyn Future<Output = ()> + Send>>;

/// This as work for a task.
pub(crate) fn boxed(work: impl Future<Output = ()> + Send + 'static) -> TaskWork {
    Box::pin(work)
}

/// Does what may take its time on a thread for such work. It begins at once, and goes on if nobody waits for it.
pub(crate) fn blocking<T: Send + 'static>(
    work: impl FnOnce() -> T + Send + 'static,
) -> impl Future<Output = Result<T, JoinError>> {
    let made = TaskResult::default();
    let place = made.clone();
    let work: Box<dyn FnOnce() + Send> = Box::new(move || place.put(work()));
    made.when(tokio::task::spawn_blocking(work))
}

/// What a task makes, for who waits for its end.
pub(crate) struct TaskResult<T>(Arc<Mutex<Option<T>>>);

impl<T> Clone for TaskResult<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> Default for TaskResult<T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<T> TaskResult<T> {
    /// This as work for a task, and what it makes.
    pub(crate) fn by(work: impl Future<Output = T> + Send + 'static) -> (TaskWork, Self)
    where
        T: Send + 'static,
    {
        let made = Self::default();
        let place = made.clone();
        (boxed(async move { place.put(work.await) }), made)
    }

    /// Puts there what was made.
    pub(crate) fn put(&self, made: T) {
        *lock(&self.0) = Some(made);
    }

    /// What was made, if it was.
    pub(crate) fn taken(&self) -> Option<T> {
        lock(&self.0).take()
    }

    /// What was made, when the task ended.
    ///
    /// # Errors
    /// If it failed inside or was aborted.
    pub(crate) async fn when(self, ended: impl Future<Output = Result<(), JoinError>>) -> Result<T, JoinError> {
        ended.await?;
        #[expect(clippy::expect_used, reason = "a task that ended well has put there what it made")]
        Ok(self.taken().expect("what was made is there"))
    }
}

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
    pub(crate) fn spawn(&self, work: impl Future<Output = ()> + Send + 'static) -> JoinHandle<()> {
        self.spawn_on(boxed(work), &self.runtime)
    }

    /// Starts a task on these threads.
    pub(crate) fn spawn_on(&self, work: TaskWork, threads: &Handle) -> JoinHandle<()> {
        self.tracker.spawn_on(work, threads)
    }

    /// Starts a task that makes something, on the threads that do not carry messages. It goes on if nobody waits for it.
    pub(crate) fn make<T: Send + 'static>(
        &self,
        work: impl Future<Output = T> + Send + 'static,
    ) -> impl Future<Output = Result<T, JoinError>> {
        let (work, made) = TaskResult::by(work);
        made.when(self.spawn_on(work, &self.runtime))
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
