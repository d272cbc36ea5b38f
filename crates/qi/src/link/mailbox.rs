//! Events that wait for one subscriber.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};
use std::time::Instant;

use tokio::sync::Notify;

use crate::locked::locked;
use crate::value::Value;

/// The most bytes of events that may wait for one subscriber; the newest event waits whatever its size.
pub const WAITING_MAX_BYTES: usize = 32 << 20;

/// The choice of events that a subscriber sees when they come faster than it takes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventChoice {
    /// The newest one only.
    Newest,
    /// All, up to so many that wait (at least 1) and [`WAITING_MAX_BYTES`]; beyond them the oldest is lost and counted.
    All(usize),
}

/// A signal that was raised.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalEvent {
    /// The values of the event.
    pub arguments: Vec<Value>,
    /// The time when it arrived here. Peers do not keep the order of events strictly; where a value has a time of its
    /// own, that counts.
    pub at: Instant,
}

/// An event as it came; it is read by its subscriber, so that one that cannot be read harms nobody else.
#[derive(Debug, Clone)]
pub(super) struct Letter {
    pub(super) flags: u8,
    pub(super) payload: Arc<[u8]>,
    pub(super) at: Instant,
}

#[derive(Debug)]
pub(super) struct EventMailbox {
    waiting: Mutex<WaitingEvents>,
    arrived: Notify,
    capacity: usize,
}

#[derive(Debug, Default)]
struct WaitingEvents {
    letters: VecDeque<Letter>,
    bytes: usize,
    lost: u64,
    closed: bool,
}

impl WaitingEvents {
    fn next(&mut self) -> Option<Letter> {
        let letter = self.letters.pop_front()?;
        self.bytes -= letter.payload.len();
        Some(letter)
    }
}

impl EventMailbox {
    pub(super) fn new(keep: EventChoice) -> Self {
        let capacity = match keep {
            EventChoice::Newest => 1,
            EventChoice::All(events) => events.max(1),
        };
        Self { waiting: Mutex::default(), arrived: Notify::new(), capacity }
    }

    pub(super) fn put(&self, letter: Letter) {
        let mut waiting = locked(&self.waiting);
        let bytes = letter.payload.len();
        while waiting.letters.len() >= self.capacity || waiting.bytes + bytes > WAITING_MAX_BYTES {
            if waiting.next().is_none() {
                break;
            }
            waiting.lost += 1;
        }
        waiting.bytes += bytes;
        waiting.letters.push_back(letter);
        drop(waiting);
        self.arrived.notify_one();
    }

    /// The next one; none after the end.
    pub(super) async fn take(&self) -> Option<Letter> {
        loop {
            if let Some(taken) = self.taken() {
                return taken;
            }
            self.arrived.notified().await;
        }
    }

    fn taken(&self) -> Option<Option<Letter>> {
        let mut waiting = locked(&self.waiting);
        match waiting.next() {
            Some(letter) => Some(Some(letter)),
            None => waiting.closed.then_some(None),
        }
    }

    pub(super) fn lost(&self) -> u64 {
        locked(&self.waiting).lost
    }

    pub(super) fn close(&self) {
        locked(&self.waiting).closed = true;
        self.arrived.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use super::{EventChoice, EventMailbox, Letter, WAITING_MAX_BYTES};
    use std::time::Instant;

    #[tokio::test]
    async fn large_events_make_way_for_newer_ones() {
        let mailbox = EventMailbox::new(EventChoice::All(1_000));
        let large = |byte: u8, bytes: usize| Letter { flags: 0, payload: vec![byte; bytes].into(), at: Instant::now() };
        for byte in 0..20 {
            mailbox.put(large(byte, WAITING_MAX_BYTES / 4));
        }
        assert_eq!((mailbox.lost(), mailbox.take().await.unwrap().payload[0]), (16, 16));
        mailbox.put(large(99, WAITING_MAX_BYTES + 1));
        assert_eq!((mailbox.lost(), mailbox.take().await.unwrap().payload[0]), (19, 99));
    }
}
