//! What timestamp makes: the value and when it was sensed.

use crate::values::in_place::{Made, Number, copy, own_values, put_number};
use behaviour::{Fields, Names, Value};
use robot::Millis;

/// The names of its fields.
pub(crate) fn names() -> Names {
    Names::of(&["t", "v"])
}

pub(crate) fn stamped(names: &Names, at: Millis, value: &Value) -> Value {
    Value::Map(Fields::with(names, [Value::Int(time(at)), value.clone()].into_iter()))
}

/// The same in the place of an older one, where possible.
pub(crate) fn stamp(names: &Names, at: Millis, value: &Value, spare: &mut Value) -> Made {
    match own_values(spare, names) {
        Some([t, v]) => {
            put_number(t, Number::Int(time(at)));
            copy(v, value);
            Made::Spare
        }
        _ => Made::Value(stamped(names, at, value)),
    }
}

fn time(at: Millis) -> i64 {
    i64::try_from(at.0).unwrap_or(i64::MAX)
}
