//! sample: passes on the newest value at each beat, if one came since the last.

use super::context::{Outcome, RunContext};
use super::memory::{ConnectorMemory, WaitingValue};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorChoice, ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "sample", op: NextSteps::Take, make: |choice| Box::new(Sample::of(choice)) };

/// Remembers the newest value until its beat.
struct Sample {
    period: u64,
    held: Option<WaitingValue>,
}

impl Sample {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { period: choice.period_ms.max(1), held: None }
    }

    /// Holds a value, for the first beat after an instant if it held none.
    fn hold(&mut self, carried: CarriedValue, after: u64) {
        let beat = Millis((after / self.period + 1).saturating_mul(self.period));
        let due = self.held.take().map_or(beat, |held| held.due);
        self.held = Some(WaitingValue { carried, due });
    }
}

impl RunConnector for Sample {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        self.hold(CarriedValue { value, origin: (at.0, 0) }, at.0.saturating_sub(1));
        Outcome::Waits
    }

    /// A beat in the frame comes after the value.
    fn frame(&mut self, _: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        self.hold(frame.newest.clone(), frame.at.0 - frame.length);
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
