//! withLatest: passes on what its procedure makes of a value of the first input and the newest values of the others.

use super::combine_latest::with_known;
use super::context::{Outcome, RunContext};
use super::memory::ConnectorMemory;
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorChoice, ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use crate::values::in_place::copy_some;
use behaviour::Value;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "withLatest", op: NextSteps::Take, make: |choice| Box::new(WithLatest::of(choice)) };

/// Remembers the newest value of each input; the first one counts only while it comes.
struct WithLatest {
    known: Vec<Option<Value>>,
}

impl WithLatest {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { known: vec![None; choice.inputs] }
    }
}

impl RunConnector for WithLatest {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        copy_some(&mut self.known[turn.slot as usize], cx.stats.value(turn.input));
        if turn.slot > 0 {
            return Outcome::Kept;
        }
        with_known(&self.known, |inputs| cx.give_made_of(at, turn, inputs)).unwrap_or(Outcome::Kept)
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        for (known, &input) in self.known.iter_mut().zip(frame.inputs) {
            if let Some(carried) = &frame.now[input] {
                *known = Some(carried.value.clone());
            }
        }
        let first = frame.inputs.first().and_then(|&first| frame.now[first].as_ref());
        let Some(origin) = first.map(|first| first.origin) else { return Ok(None) };
        let made = with_known(&self.known, |inputs| cx.call(frame.at, frame.connector, inputs)).transpose()?;
        Ok(made.map(|value| CarriedValue { value, origin }))
    }

    fn trigger(&self, _: u32) -> u32 {
        0
    }

    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory { known: self.known.clone(), ..ConnectorMemory::default() }
    }

    fn resume(&mut self, memory: ConnectorMemory) {
        self.known = memory.known;
    }
}
