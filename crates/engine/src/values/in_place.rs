//! Putting a value where another one was. A number goes over a number in place: most of what flows is numbers, and
//! building a whole value in one place and moving it to another costs more than computing it.

use behaviour::{FieldNames, Value};

/// A number, as procedures compute it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ComputedNumber {
    Int(i64),
    Float(f64),
}

/// The value that a procedure made, and where it is.
pub(crate) enum ProcedureOutput {
    /// In the spare that was handed in.
    Spare,
    /// In here.
    Value(Value),
}

impl ComputedNumber {
    #[inline]
    pub(crate) fn value(self) -> Value {
        match self {
            Self::Int(whole) => Value::Int(whole),
            Self::Float(number) => Value::Float(number),
        }
    }

    #[inline]
    pub(crate) fn is_finite(self) -> bool {
        match self {
            Self::Int(_) => true,
            Self::Float(number) => number.is_finite(),
        }
    }
}

/// Puts a number over what was there.
#[inline(always)]
pub(crate) fn put_number(to: &mut Value, number: ComputedNumber) {
    match (to, number) {
        (Value::Int(to), ComputedNumber::Int(whole)) => *to = whole,
        (Value::Float(to), ComputedNumber::Float(number)) => *to = number,
        (to, number) => replace(to, number.value()),
    }
}

/// Drops what was there. Seldom what flows, so that it does not make the way of numbers longer.
#[cold]
fn replace(to: &mut Value, value: Value) {
    *to = value;
}

/// Copies what takes more than a few bytes.
#[inline(never)]
fn copy_any(to: &mut Value, from: &Value) {
    *to = from.clone();
}

/// Copies a value over what was there.
#[inline(always)]
pub(crate) fn copy(to: &mut Value, from: &Value) {
    match (to, from) {
        (Value::Int(to), Value::Int(from)) => *to = *from,
        (Value::Float(to), Value::Float(from)) => *to = *from,
        (Value::Bool(to), Value::Bool(from)) => *to = *from,
        (to, from) => copy_any(to, from),
    }
}

/// Copies a value over what was there, if anything was.
#[inline]
pub(crate) fn copy_some(to: &mut Option<Value>, from: &Value) {
    match to {
        Some(to) => copy(to, from),
        None => *to = Some(from.clone()),
    }
}

/// The values of an object that has these names and that nobody else has.
#[inline]
pub(crate) fn own_values<'v>(object: &'v mut Value, names: &FieldNames) -> Option<&'v mut [Value]> {
    match object {
        Value::Map(fields) if fields.shape() == names.shape() => fields.own_values(),
        _ => None,
    }
}
