//! delay: passes on every value a while later.

use super::context::{Context, Outcome};
use super::memory::{Memory, Waiting};
use super::op::{Op, Turn};
use super::{Choice, Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use robot::Millis;
use std::collections::VecDeque;

pub(super) const KIND: Kind = Kind { word: "delay", op: Op::Take, make: |choice| Box::new(Delay::of(choice)) };

/// The most values that may wait.
const WAITING_MAX_VALUES: usize = 10_000;

/// Remembers the values that wait, in the order in which they came.
struct Delay {
    period: u64,
    waiting: VecDeque<Waiting>,
}

impl Delay {
    fn of(choice: &Choice) -> Self {
        Self { period: choice.period_ms, waiting: VecDeque::new() }
    }

    /// Lets a value wait, unless too many do.
    fn add(&mut self, carried: Carried, at: Millis) -> Result<(), Box<CallFault>> {
        if self.waiting.len() >= WAITING_MAX_VALUES {
            return Err(Box::new(CallFault::Waiting));
        }
        self.waiting.push_back(Waiting { carried, due: Millis(at.0.saturating_add(self.period)) });
        Ok(())
    }
}

impl Connector for Delay {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        match self.add(Carried { value: value.clone(), origin: (at.0, 0) }, at) {
            Ok(()) => Outcome::Waits,
            Err(failed) => cx.failed(at, turn.connector, failed, &[&value]),
        }
    }

    fn frame(&mut self, cx: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        let added = self.add(frame.newest.clone(), frame.at);
        cx.counted(frame.at, frame.connector, added, &[&frame.newest.value]).map(|()| None)
    }

    fn due(&self) -> Option<Millis> {
        self.waiting.front().map(|first| first.due)
    }

    fn tick(&mut self) -> Option<Carried> {
        self.waiting.pop_front().map(|first| first.carried)
    }

    fn memory(&self) -> Memory {
        Memory { waiting: self.waiting.iter().cloned().collect(), ..Memory::default() }
    }

    fn resume(&mut self, memory: Memory) {
        self.waiting = memory.waiting.into();
    }
}
