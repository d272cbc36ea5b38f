//! timestamp: passes on each value together with when it was sensed.

use super::context::{Outcome, RunContext};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use crate::values::in_place::{ComputedNumber, ProcedureOutput, copy, own_values, put_number};
use behaviour::{FieldNames, Fields, Value};
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "timestamp", op: NextSteps::Take, make: |_| Box::new(Timestamp::new()) };

/// Remembers nothing but the names of the fields that it makes.
struct Timestamp {
    names: FieldNames,
}

impl Timestamp {
    fn new() -> Self {
        Self { names: FieldNames::of(&["t", "v"]) }
    }

    fn stamped(&self, at: Millis, value: &Value) -> Value {
        Value::Map(Fields::with(&self.names, [Value::Int(time(at)), value.clone()].into_iter()))
    }

    /// Makes it in the place of an older one, where possible.
    fn stamp(&self, at: Millis, value: &Value, spare: &mut Value) -> ProcedureOutput {
        match own_values(spare, &self.names) {
            Some([t, v]) => {
                put_number(t, ComputedNumber::Int(time(at)));
                copy(v, value);
                ProcedureOutput::Spare
            }
            _ => ProcedureOutput::Value(self.stamped(at, value)),
        }
    }
}

impl RunConnector for Timestamp {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        cx.give(at, turn, |value, spare| self.stamp(at, value, spare))
    }

    fn frame(&mut self, _: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        let CarriedValue { value, origin } = frame.newest;
        Ok(Some(CarriedValue { value: self.stamped(frame.at, value), origin: *origin }))
    }
}

fn time(at: Millis) -> i64 {
    i64::try_from(at.0).unwrap_or(i64::MAX)
}
