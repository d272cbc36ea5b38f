//! timestamp: passes on each value together with when it was sensed.

use super::context::{Context, Outcome};
use super::op::{Op, Turn};
use super::{Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use crate::values::in_place::{Number, Output, copy, own_values, put_number};
use behaviour::{Fields, Names, Value};
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "timestamp", op: Op::Take, make: |_| Box::new(Timestamp::new()) };

/// Remembers nothing but the names of the fields that it makes.
struct Timestamp {
    names: Names,
}

impl Timestamp {
    fn new() -> Self {
        Self { names: Names::of(&["t", "v"]) }
    }

    fn stamped(&self, at: Millis, value: &Value) -> Value {
        Value::Map(Fields::with(&self.names, [Value::Int(time(at)), value.clone()].into_iter()))
    }

    /// Makes it in the place of an older one, where possible.
    fn stamp(&self, at: Millis, value: &Value, spare: &mut Value) -> Output {
        match own_values(spare, &self.names) {
            Some([t, v]) => {
                put_number(t, Number::Int(time(at)));
                copy(v, value);
                Output::Spare
            }
            _ => Output::Value(self.stamped(at, value)),
        }
    }
}

impl Connector for Timestamp {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        cx.give(at, turn, |value, spare| self.stamp(at, value, spare))
    }

    fn frame(&mut self, _: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        let Carried { value, origin } = frame.newest;
        Ok(Some(Carried { value: self.stamped(frame.at, value), origin: *origin }))
    }
}

fn time(at: Millis) -> i64 {
    i64::try_from(at.0).unwrap_or(i64::MAX)
}
