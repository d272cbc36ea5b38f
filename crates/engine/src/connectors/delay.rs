//! delay: passes on every value a while later.

use super::context::{Outcome, RunContext};
use super::memory::{ConnectorMemory, WaitingValue};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorChoice, ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use robot::Millis;
use std::collections::VecDeque;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "delay", op: NextSteps::Take, make: |choice| Box::new(Delay::of(choice)) };

/// The most values that may wait.
const WAITING_MAX_VALUES: usize = 10_000;

/// Remembers the values that wait, in the order in which they came.
struct Delay {
    period: u64,
    waiting: VecDeque<WaitingValue>,
}

impl Delay {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { period: choice.period_ms, waiting: VecDeque::new() }
    }

    /// Lets a value wait, unless too many do.
    fn add(&mut self, carried: CarriedValue, at: Millis) -> Result<(), Box<CallFault>> {
        if self.waiting.len() >= WAITING_MAX_VALUES {
            return Err(Box::new(CallFault::Waiting));
        }
        self.waiting.push_back(WaitingValue { carried, due: Millis(at.0.saturating_add(self.period)) });
        Ok(())
    }
}

impl RunConnector for Delay {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        match self.add(CarriedValue { value: value.clone(), origin: (at.0, 0) }, at) {
            Ok(()) => Outcome::Waits,
            Err(failed) => cx.failed(at, turn.connector, failed, &[&value]),
        }
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        let added = self.add(frame.newest.clone(), frame.at);
        cx.counted(frame.at, frame.connector, added, &[&frame.newest.value]).map(|()| None)
    }

    fn due(&self) -> Option<Millis> {
        self.waiting.front().map(|first| first.due)
    }

    fn tick(&mut self) -> Option<CarriedValue> {
        self.waiting.pop_front().map(|first| first.carried)
    }

    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory { waiting: self.waiting.iter().cloned().collect(), ..ConnectorMemory::default() }
    }

    fn resume(&mut self, memory: ConnectorMemory) {
        self.waiting = memory.waiting.into();
    }
}
