//! Work on what people send, away from the threads that carry messages: reading large messages, checking procedures,
//! looking for problems, imports. A few threads of low priority; whoever sends much waits behind nobody but themselves.

use crate::support::lock;
use crate::support::priority::{self, Priority};
use crate::support::tasks::Made;
use behaviour::Id;
use protocol::Refused;
use std::collections::{HashMap, HashSet, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use tokio::sync::oneshot;
use tokio_util::sync::CancellationToken;

/// Threads that work.
const THREADS: usize = 2;
/// Stack of each in bytes; procedures nest on it, and debug builds need the most.
const STACK_BYTES: usize = 16 << 20;
/// Tasks of one sender that may wait.
const WAITING_PER_SENDER_MAX: usize = 16;
/// Tasks that may wait altogether.
const WAITING_MAX: usize = 1_024;

/// For whom something is worked on. Of one sender one task is under way at a time, and senders take turns.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Sender {
    /// What a link asks, by its number.
    Link(u64),
    /// What is told on a link, by its number.
    Writer(u64),
    /// An HTTP request, by its number.
    Request(u64),
    /// What is done for everyone in an open behaviour.
    Room(Id),
    /// The server itself.
    Server,
}

/// Why something was not worked on to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotDone {
    /// Too much waits already.
    TooMuch,
    /// It failed inside.
    Failed,
}

impl From<NotDone> for Refused {
    fn from(why: NotDone) -> Self {
        match why {
            NotDone::TooMuch => Self::TooFast,
            NotDone::Failed => Self::Unreadable("it makes the server fail; please tell the people who make rrp".into()),
        }
    }
}

/// The way to the threads; they end with the last clone.
#[derive(Clone)]
pub(crate) struct Workers(Arc<Pool>);

struct Pool(Arc<Shared>);

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    bell: Condvar,
}

/// Work of whatever kind, as one type: what does it is compiled once.
type Work = Box<dyn FnOnce(&CancellationToken) + Send>;
/// Work with what it is told by.
type Task = Box<dyn FnOnce() + Send>;

#[derive(Default)]
struct Queue {
    waiting: HashMap<Sender, VecDeque<Task>>,
    /// Senders of whom something waits and nothing is under way, next first.
    turns: VecDeque<Sender>,
    under_way: HashSet<Sender>,
    count: usize,
    ended: bool,
}

impl Workers {
    /// Starts the threads.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn start() -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let pool = Self(Arc::new(Pool(Arc::clone(&shared))));
        for number in 1..=THREADS {
            let shared = Arc::clone(&shared);
            let thread = std::thread::Builder::new().name(format!("worker-{number}")).stack_size(STACK_BYTES);
            thread.spawn(move || shared.work())?;
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
    ) -> impl Future<Output = Result<T, NotDone>> {
        let made = Made::default();
        let place = made.clone();
        let put = move |token: &CancellationToken| place.put(work(token));
        self.made(sender, Box::new(put), made)
    }

    /// Does work that puts what it makes into a place, and takes that.
    async fn made<T>(&self, sender: Sender, work: Work, made: Made<T>) -> Result<T, NotDone> {
        self.done(sender, work).await?;
        made.taken().ok_or(NotDone::Failed)
    }

    /// Does work and waits for its end.
    async fn done(&self, sender: Sender, work: Work) -> Result<(), NotDone> {
        let (token, (done, waiting)) = (CancellationToken::new(), oneshot::channel());
        let _leaving = token.clone().drop_guard();
        let task = move || {
            if !token.is_cancelled() {
                let worked = catch_unwind(AssertUnwindSafe(|| work(&token)));
                let _ = done.send(worked.map_err(|_| NotDone::Failed));
            }
        };
        if !lock(&self.0.0.queue).put(sender, Box::new(task)) {
            return Err(NotDone::TooMuch);
        }
        self.0.0.bell.notify_one();
        waiting.await.unwrap_or(Err(NotDone::Failed))
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        lock(&self.0.queue).ended = true;
        self.0.bell.notify_all();
    }
}

impl Shared {
    fn work(&self) {
        priority::of_this_thread(Priority::Work);
        while let Some((sender, task)) = self.next() {
            task();
            if lock(&self.queue).done(sender) {
                self.bell.notify_one();
            }
        }
    }

    /// The next task; none once the server ended.
    fn next(&self) -> Option<(Sender, Task)> {
        let mut queue = lock(&self.queue);
        loop {
            if queue.ended {
                return None;
            }
            if let Some(next) = queue.take() {
                return Some(next);
            }
            queue = self.bell.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl Queue {
    /// Adds a task; false if there is no room.
    fn put(&mut self, sender: Sender, task: Task) -> bool {
        let mine = self.waiting.get(&sender).map_or(0, VecDeque::len);
        if self.ended || self.count >= WAITING_MAX || mine >= WAITING_PER_SENDER_MAX {
            return false;
        }
        if mine == 0 && !self.under_way.contains(&sender) {
            self.turns.push_back(sender.clone());
        }
        self.waiting.entry(sender).or_default().push_back(task);
        self.count += 1;
        true
    }

    fn take(&mut self) -> Option<(Sender, Task)> {
        let sender = self.turns.pop_front()?;
        let tasks = self.waiting.get_mut(&sender)?;
        let task = tasks.pop_front()?;
        if tasks.is_empty() {
            self.waiting.remove(&sender);
        }
        self.count -= 1;
        self.under_way.insert(sender.clone());
        Some((sender, task))
    }

    /// A task ended; true if its sender has another one, which waits for its turn now.
    fn done(&mut self, sender: Sender) -> bool {
        self.under_way.remove(&sender);
        let has_more = self.waiting.contains_key(&sender);
        if has_more {
            self.turns.push_back(sender);
        }
        has_more
    }
}

#[cfg(test)]
mod tests {
    use super::{NotDone, Queue, Sender, WAITING_PER_SENDER_MAX, Workers};
    use std::sync::mpsc::channel;

    fn put(queue: &mut Queue, link: u64) -> bool {
        queue.put(Sender::Link(link), Box::new(|| {}))
    }

    #[test]
    fn senders_take_turns_and_none_has_two_under_way() {
        let mut queue = Queue::default();
        for link in [1, 1, 1, 2, 3] {
            assert!(put(&mut queue, link));
        }
        let mut next = || queue.take().map(|(sender, _)| sender);
        assert_eq!([next(), next(), next(), next()], [1, 2, 3, 0].map(|n| (n > 0).then_some(Sender::Link(n))));
        assert!(!queue.done(Sender::Link(2)));
        assert!(queue.done(Sender::Link(1)));
        assert_eq!(queue.take().map(|(sender, _)| sender), Some(Sender::Link(1)));
    }

    #[test]
    fn a_busy_sender_is_refused_and_others_are_not() {
        let mut queue = Queue::default();
        let taken = (0..100).filter(|_| put(&mut queue, 1)).count();
        assert_eq!((taken, put(&mut queue, 2)), (WAITING_PER_SENDER_MAX, true));
    }

    #[tokio::test]
    async fn what_panics_is_told_and_the_next_is_worked_on() {
        let workers = Workers::start().unwrap();
        for _ in 0..5 {
            let failed: Result<(), _> = workers.run(Sender::Server, |_| panic!("on purpose")).await;
            assert_eq!(failed, Err(NotDone::Failed));
        }
        assert_eq!(workers.run(Sender::Server, |_| 7).await, Ok(7));
    }

    #[tokio::test]
    async fn who_leaves_is_told_to_the_work() {
        let workers = Workers::start().unwrap();
        let ((begin, began), (end, ended)) = (channel(), channel());
        let work = workers.run(Sender::Link(1), move |cancel| {
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
}
