//! Stops in their order, so that what somebody pressed before a Stop never moves a robot after it. Every Stop has a number
//! over all robots. Clients hear the newest one, send it back with what they ask, and are refused where the robot that is
//! meant was stopped since: a request may have waited in a stalled link or in a queue of ours for long.

use std::sync::atomic::{AtomicU64, Ordering};

/// Returns the number before the first one that this start of the server gives, to Stops as to runs: larger than all that
/// earlier starts gave.
pub(super) fn first_number(epoch: u64) -> u64 {
    epoch.saturating_mul(protocol::STOPS_PER_START)
}

/// The numbers of Stops.
#[derive(Debug, Default)]
pub(super) struct StopNumbers {
    first: u64,
    newest: AtomicU64,
}

impl StopNumbers {
    /// No Stop came yet since this start of the server.
    pub(super) fn of(epoch: u64) -> Self {
        let first = first_number(epoch);
        Self { first, newest: AtomicU64::new(first) }
    }

    /// The number that stands for the start of the server, which stopped whatever had been before.
    pub(super) fn first(&self) -> u64 {
        self.first
    }

    /// The newest one. Whoever is told it and presses then presses after that Stop.
    pub(super) fn newest(&self) -> u64 {
        self.newest.load(Ordering::SeqCst)
    }

    /// A Stop comes.
    pub(super) fn next(&self) -> u64 {
        self.newest.fetch_add(1, Ordering::SeqCst) + 1
    }
}

/// The robot was stopped since the person who asks heard of a Stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct StoppedSince;

/// Somebody who presses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Presser<'a> {
    /// The names by which they are told.
    pub(crate) by: &'a str,
    /// The newest Stop of which they had heard; none if their client has heard of none.
    pub(crate) stops: Option<u64>,
}

impl<'a> From<&'a str> for Presser<'a> {
    fn from(by: &'a str) -> Self {
        Self { by, stops: None }
    }
}
