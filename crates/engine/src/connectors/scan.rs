//! scan: passes on what its procedure makes of what it made before and the new value.

use super::context::{Outcome, RunContext};
use super::memory::ConnectorMemory;
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorChoice, ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use behaviour::Value;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "scan", op: NextSteps::Take, make: |choice| Box::new(Scan::of(choice)) };

/// Remembers what its procedure made last; at first the value to start from.
struct Scan {
    so_far: Value,
}

impl Scan {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { so_far: choice.start.clone() }
    }
}

impl RunConnector for Scan {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        let value = cx.stats.value(turn.input).clone();
        let outcome = cx.give_made_of(at, turn, &[&self.so_far, &value]);
        if let Outcome::Gave = outcome {
            self.so_far = cx.stats.value(turn.output).clone();
        }
        outcome
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        let CarriedValue { value, origin } = frame.newest;
        self.so_far = cx.call(frame.at, frame.connector, &[&self.so_far, value])?;
        Ok(Some(CarriedValue { value: self.so_far.clone(), origin: *origin }))
    }

    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory { known: vec![Some(self.so_far.clone())], ..ConnectorMemory::default() }
    }

    fn resume(&mut self, memory: ConnectorMemory) {
        self.so_far = memory.known.into_iter().next().flatten().unwrap_or_default();
    }
}
