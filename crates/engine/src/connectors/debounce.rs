//! debounce: passes on a value once nothing else came for a while.

use super::context::{Outcome, RunContext};
use super::memory::{ConnectorMemory, WaitingValue};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorChoice, ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "debounce", op: NextSteps::Take, make: |choice| Box::new(Debounce::of(choice)) };

/// Remembers the newest value until nothing came for long enough.
struct Debounce {
    period: u64,
    held: Option<WaitingValue>,
}

impl Debounce {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { period: choice.period_ms, held: None }
    }

    fn hold(&mut self, carried: CarriedValue, at: Millis) {
        self.held = Some(WaitingValue { carried, due: Millis(at.0.saturating_add(self.period)) });
    }
}

impl RunConnector for Debounce {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        self.hold(CarriedValue { value, origin: (at.0, 0) }, at);
        Outcome::Waits
    }

    fn frame(&mut self, _: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        self.hold(frame.newest.clone(), frame.at);
        Ok(None)
    }

    fn due(&self) -> Option<Millis> {
        self.held.as_ref().map(|held| held.due)
    }

    fn tick(&mut self) -> Option<CarriedValue> {
        self.held.take().map(|held| held.carried)
    }

    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory { waiting: self.held.iter().cloned().collect(), ..ConnectorMemory::default() }
    }

    fn resume(&mut self, memory: ConnectorMemory) {
        self.held = memory.waiting.into_iter().next();
    }
}
