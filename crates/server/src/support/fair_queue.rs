//! A bounded queue of which everybody is served in turn, one thing each: when it is full, the oldest of who has most waiting
//! gives way.

use crate::support::lock;
use std::collections::{HashMap, VecDeque};
use std::hash::Hash;
use std::sync::Mutex;
use tokio::sync::Notify;

/// The queue, with one reader.
#[derive(Debug)]
pub(crate) struct FairQueue<K, T> {
    max: usize,
    waiting: Mutex<QueuedItem<K, T>>,
    arrived: Notify,
}

#[derive(Debug)]
struct QueuedItem<K, T> {
    count: usize,
    /// Of each, the oldest first; nobody has none.
    by: HashMap<K, VecDeque<T>>,
    /// Whose turn it is.
    turns: VecDeque<K>,
}

impl<K: Copy + Eq + Hash, T> FairQueue<K, T> {
    /// Of so many places.
    pub(crate) fn of(max: usize) -> Self {
        let waiting = QueuedItem { count: 0, by: HashMap::new(), turns: VecDeque::new() };
        Self { max, waiting: Mutex::new(waiting), arrived: Notify::new() }
    }

    /// Puts something of somebody at the end; what gave way for it comes back.
    pub(crate) fn push(&self, whose: K, what: T) -> Option<T> {
        let mut waiting = lock(&self.waiting);
        let gave_way = if waiting.count >= self.max { waiting.give_way() } else { None };
        waiting.count += 1;
        if !waiting.by.contains_key(&whose) {
            waiting.turns.push_back(whose);
        }
        waiting.by.entry(whose).or_default().push_back(what);
        drop(waiting);
        self.arrived.notify_one();
        gave_way
    }

    /// What comes next, when there is something.
    pub(crate) async fn next(&self) -> T {
        loop {
            let next = lock(&self.waiting).next();
            match next {
                Some(next) => return next,
                None => self.arrived.notified().await,
            }
        }
    }
}

impl<K: Copy + Eq + Hash, T> QueuedItem<K, T> {
    fn next(&mut self) -> Option<T> {
        let whose = self.turns.pop_front()?;
        let next = self.oldest(whose);
        if self.by.contains_key(&whose) {
            self.turns.push_back(whose);
        }
        next
    }

    fn give_way(&mut self) -> Option<T> {
        let many = |whose: &K| self.by.get(whose).map_or(0, VecDeque::len);
        // Of equals the one that waits longest.
        let whose = *self.turns.iter().rev().max_by_key(|whose| many(whose))?;
        let oldest = self.oldest(whose);
        if !self.by.contains_key(&whose) {
            self.turns.retain(|turn| *turn != whose);
        }
        oldest
    }

    fn oldest(&mut self, whose: K) -> Option<T> {
        let of = self.by.get_mut(&whose)?;
        let oldest = of.pop_front()?;
        if of.is_empty() {
            self.by.remove(&whose);
        }
        self.count -= 1;
        Some(oldest)
    }
}

#[cfg(test)]
mod tests {
    use super::FairQueue;

    #[tokio::test]
    async fn everybody_is_served_in_turn_and_who_has_most_gives_way() {
        let queue = FairQueue::of(4);
        for number in 0..4 {
            assert_eq!(queue.push("many", number), None);
        }
        assert_eq!(queue.push("few", 10), Some(0), "for somebody with none");
        assert_eq!(queue.push("many", 4), Some(1), "for their own");
        let mut served = Vec::new();
        for _ in 0..4 {
            served.push(queue.next().await);
        }
        assert_eq!(served, [2, 10, 3, 4]);
    }

    #[tokio::test]
    async fn of_many_with_one_each_the_oldest_gives_way() {
        let queue = FairQueue::of(2);
        assert_eq!([queue.push(1, 1), queue.push(2, 2), queue.push(3, 3)], [None, None, Some(1)]);
        assert_eq!([queue.next().await, queue.next().await], [2, 3]);
        assert_eq!(queue.push(1, 4), None, "and there is room again");
    }
}
