//! Work on what people send, away from the threads that carry messages: reading large messages, checking procedures,
//! looking for problems, imports. A few threads of low priority; whoever sends much waits behind nobody but themselves.

use crate::support::identity::Sender;
use crate::support::lock;
use crate::support::priority::{self, Priority};
use crate::support::tasks::TaskResult;
use crate::support::turns::{FairTurns, TurnBounds};
use phrase::phrase;
use protocol::Refused;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use tokio::sync::oneshot;
use tokio_util::sync::CancellationToken;

/// Stack of each thread in bytes; procedures nest on it, and debug builds need the most.
const STACK_BYTES: usize = 16 << 20;
/// Threads that work on what people send. One invitation has one of them at a time, and all rooms together have, so that
/// what somebody else sends finds the other one.
const THREADS: usize = 2;
/// Threads that read and write files, which wait for the disk more than they work.
const FILE_THREADS: usize = 4;
/// Threads that read whole recordings for people.
const ANALYSIS_THREADS: usize = 2;
/// What may wait for threads, and who has how many of them: with 16 tasks of a guest or of a link of the host.
const BOUNDS: TurnBounds =
    TurnBounds { host: usize::MAX, group: 1, sender: 1, sender_waiting: 16, group_waiting: 256, waiting: 4_096 };

/// Why something was not worked on to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WorkNotDone {
    /// Too much waits already.
    TooMuch,
    /// It failed inside.
    Failed,
}

impl From<WorkNotDone> for Refused {
    fn from(why: WorkNotDone) -> Self {
        match why {
            WorkNotDone::TooMuch => Self::TooFast,
            WorkNotDone::Failed => Self::Unreadable(phrase!(
                "server.it_makes_the_server_fail",
                "it makes the server fail; please tell the people who make rrp"
            )),
        }
    }
}

/// The way to the threads; they end with the last clone.
#[derive(Clone)]
pub(crate) struct Workers(Arc<Pool>);

struct Pool(Arc<WorkersShared>);

struct WorkersShared {
    queue: Mutex<WorkQueue>,
    bell: Condvar,
}

/// Work of whatever kind, as one type: what does it is compiled once.
type WorkerJob = Box<dyn FnOnce(&CancellationToken) + Send>;
/// Work with what it is told by.
type Task = Box<dyn FnOnce() + Send>;

struct WorkQueue {
    turns: FairTurns<Task>,
    ended: bool,
}

impl Workers {
    /// Starts the threads for what people send, which give way to those that carry messages.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn start() -> std::io::Result<Self> {
        Self::of(THREADS, "worker", Some(Priority::Work))
    }

    /// Starts the threads for files.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn for_files() -> std::io::Result<Self> {
        Self::of(FILE_THREADS, "files", None)
    }

    /// Starts the threads that read whole recordings, for seconds each: nothing else waits behind them.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn for_analyses() -> std::io::Result<Self> {
        Self::of(ANALYSIS_THREADS, "analysis", Some(Priority::Work))
    }

    fn of(threads: usize, name: &str, priority: Option<Priority>) -> std::io::Result<Self> {
        let queue = Mutex::new(WorkQueue { turns: FairTurns::within(BOUNDS), ended: false });
        let shared = Arc::new(WorkersShared { queue, bell: Condvar::new() });
        let pool = Self(Arc::new(Pool(Arc::clone(&shared))));
        for number in 1..=threads {
            let shared = Arc::clone(&shared);
            let thread = std::thread::Builder::new().name(format!("{name}-{number}")).stack_size(STACK_BYTES);
            thread.spawn(move || shared.work(priority))?;
        }
        Ok(pool)
    }

    /// Works on something and waits for it. If the returned future is dropped, what waits is not begun, and what is
    /// under way is told by its token, which work in loops asks.
    ///
    /// # Errors
    /// If too much waits already, or the work panics.
    pub(crate) fn run<T: Send + 'static>(
        &self,
        sender: Sender,
        work: impl FnOnce(&CancellationToken) -> T + Send + 'static,
    ) -> impl Future<Output = Result<T, WorkNotDone>> {
        let made = TaskResult::default();
        let place = made.clone();
        let put = move |token: &CancellationToken| place.put(work(token));
        self.made(sender, Box::new(put), made)
    }

    /// Does work that puts what it makes into a place, and takes that.
    async fn made<T>(&self, sender: Sender, work: WorkerJob, made: TaskResult<T>) -> Result<T, WorkNotDone> {
        self.done(sender, work).await?;
        made.taken().ok_or(WorkNotDone::Failed)
    }

    /// Does work and waits for its end.
    async fn done(&self, sender: Sender, work: WorkerJob) -> Result<(), WorkNotDone> {
        let (token, (done, waiting)) = (CancellationToken::new(), oneshot::channel());
        let _leaving = token.clone().drop_guard();
        let task = move || {
            if !token.is_cancelled() {
                let worked = catch_unwind(AssertUnwindSafe(|| work(&token)));
                let _ = done.send(worked.map_err(|_| WorkNotDone::Failed));
            }
        };
        if !lock(&self.0.0.queue).put(&sender, Box::new(task)) {
            return Err(WorkNotDone::TooMuch);
        }
        self.0.0.bell.notify_one();
        waiting.await.unwrap_or(Err(WorkNotDone::Failed))
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        lock(&self.0.queue).ended = true;
        self.0.bell.notify_all();
    }
}

impl WorkersShared {
    fn work(&self, priority: Option<Priority>) {
        priority.into_iter().for_each(priority::of_this_thread);
        while let Some((sender, task)) = self.next() {
            task();
            lock(&self.queue).turns.done(&sender);
            // What waited for the end of this one may begin now, besides what this thread takes next.
            self.bell.notify_one();
        }
    }

    /// The next task; none once the server ended.
    fn next(&self) -> Option<(Sender, Task)> {
        let mut queue = lock(&self.queue);
        loop {
            if queue.ended {
                return None;
            }
            if let Some(next) = queue.turns.take() {
                return Some(next);
            }
            queue = self.bell.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl WorkQueue {
    /// Adds a task; false if there is no room.
    fn put(&mut self, sender: &Sender, task: Task) -> bool {
        !self.ended && self.turns.put(sender, task)
    }
}

#[cfg(test)]
mod tests {
    use super::{WorkNotDone, Workers};
    use crate::support::identity::tests::guest;
    use crate::support::identity::{PersonIdentity, Sender};
    use std::sync::mpsc::channel;

    #[tokio::test]
    async fn what_panics_is_told_and_the_next_is_worked_on() {
        let workers = Workers::start().unwrap();
        for _ in 0..5 {
            let failed: Result<(), _> = workers.run(Sender::Server, |_| panic!("on purpose")).await;
            assert_eq!(failed, Err(WorkNotDone::Failed));
        }
        assert_eq!(workers.run(Sender::Server, |_| 7).await, Ok(7));
    }

    #[tokio::test]
    async fn who_leaves_is_told_to_the_work() {
        let workers = Workers::start().unwrap();
        let ((begin, began), (end, ended)) = (channel(), channel());
        let work = workers.run(PersonIdentity::Host.asks(1), move |cancel| {
            begin.send(()).unwrap();
            while !cancel.is_cancelled() {
                std::thread::yield_now();
            }
            end.send(()).unwrap();
        });
        let leaving = tokio::task::spawn_blocking(move || began.recv().unwrap());
        tokio::select! {
            done = work => panic!("{done:?}"),
            left = leaving => left.unwrap(),
        }
        tokio::task::spawn_blocking(move || ended.recv().unwrap()).await.unwrap();
    }

    /// All that one invitation sends, by however many cookies and links, has one of the threads.
    #[tokio::test]
    async fn an_invitation_that_works_without_end_leaves_a_thread_to_others() {
        let workers = Workers::start().unwrap();
        let all: Vec<_> = (0..8)
            .map(|cookie| {
                let (workers, sender) = (workers.clone(), guest("many", &cookie.to_string()).asks(1));
                tokio::spawn(async move {
                    workers
                        .run(sender, |cancel| {
                            while !cancel.is_cancelled() {
                                std::thread::yield_now()
                            }
                        })
                        .await
                })
            })
            .collect();
        for turn in 0..50 {
            assert_eq!(workers.run(guest("other", "one").asks(1), move |_| turn).await, Ok(turn));
            assert_eq!(workers.run(PersonIdentity::Host.asks(1), move |_| turn).await, Ok(turn));
        }
        all.iter().for_each(tokio::task::JoinHandle::abort);
    }
}
