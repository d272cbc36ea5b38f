//! A part of a past: readings after a moment to go on from.

use crate::tape::Tape;
use engine::Handover;

/// Readings after a moment to go on from.
#[derive(Debug)]
pub(crate) struct PastSegment {
    /// The place of the program that runs.
    pub(crate) program: usize,
    pub(crate) begins: Begins,
    /// The memory of the run then; none of a run that begins.
    pub(crate) start: Option<Box<Handover>>,
    /// The first instant of it; all before is closed.
    pub(crate) starts_ms: u64,
    /// The time at which the last reading before it came.
    pub(crate) before_ms: u64,
    pub(crate) tape: Tape,
}

/// The ways in which a segment begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Begins {
    /// A run begins, or goes on from a memory that was recorded.
    Anew,
    /// The run goes on.
    GoesOn,
    /// An edited program goes on.
    Applied,
}

impl PastSegment {
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Self>() + self.tape.bytes() + self.start.as_ref().map_or(0, |start| start.bytes())
    }
}
