//! combineLatest: passes on what its procedure makes of the newest values of all inputs, once all are known.

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
    ConnectorKind { word: "combineLatest", op: NextSteps::Take, make: |choice| Box::new(CombineLatest::of(choice)) };

/// The most inputs that are handed over without a list of their own.
const FEW: usize = 8;

/// Remembers the newest value of each input.
struct CombineLatest {
    known: Vec<Option<Value>>,
}

impl CombineLatest {
    fn of(choice: &ConnectorChoice) -> Self {
        Self { known: vec![None; choice.inputs] }
    }
}

impl RunConnector for CombineLatest {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        copy_some(&mut self.known[turn.slot as usize], cx.stats.value(turn.input));
        with_known(&self.known, |inputs| cx.give_made_of(at, turn, inputs)).unwrap_or(Outcome::Kept)
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        for (known, &input) in self.known.iter_mut().zip(frame.inputs) {
            if let Some(carried) = &frame.now[input] {
                *known = Some(carried.value.clone());
            }
        }
        let made = with_known(&self.known, |inputs| cx.call(frame.at, frame.connector, inputs)).transpose()?;
        Ok(made.map(|value| CarriedValue { value, origin: frame.newest.origin }))
    }

    fn memory(&self) -> ConnectorMemory {
        ConnectorMemory { known: self.known.clone(), ..ConnectorMemory::default() }
    }

    fn resume(&mut self, memory: ConnectorMemory) {
        self.known = memory.known;
    }
}

/// Calls with all inputs, if all are known.
pub(super) fn with_known<R>(known: &[Option<Value>], call: impl FnOnce(&[&Value]) -> R) -> Option<R> {
    static NOTHING: Value = Value::Null;
    let mut few = [&NOTHING; FEW];
    if known.len() > few.len() {
        let inputs: Option<Vec<&Value>> = known.iter().map(Option::as_ref).collect();
        return inputs.map(|inputs| call(&inputs));
    }
    for (input, known) in few.iter_mut().zip(known) {
        *input = known.as_ref()?;
    }
    Some(call(&few[..known.len()]))
}
