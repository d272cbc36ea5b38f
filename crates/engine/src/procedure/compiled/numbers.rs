//! Whole and measured numbers, computed as Rhai computes them; whatever would be a fault is left to Rhai.

use super::Unsure;
use behaviour::Value;

pub(super) use crate::values::in_place::ComputedNumber;

/// An operator between numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Rest,
}

impl ComputedNumber {
    #[inline]
    pub(crate) fn of(value: &Value) -> Result<Self, Unsure> {
        match value {
            Value::Int(whole) => Ok(Self::Int(*whole)),
            Value::Float(number) => Ok(Self::Float(*number)),
            Value::Null | Value::Bool(_) | Value::Text(_) | Value::List(_) | Value::Map(_) => Err(Unsure),
        }
    }

    #[inline]
    pub(super) fn float(self) -> f64 {
        match self {
            Self::Int(whole) => whole as f64,
            Self::Float(number) => number,
        }
    }

    #[inline]
    pub(super) fn negative(self) -> Result<Self, Unsure> {
        match self {
            Self::Int(whole) => whole.checked_neg().map(Self::Int).ok_or(Unsure),
            Self::Float(number) => Ok(Self::Float(-number)),
        }
    }
}

impl Operator {
    #[inline]
    pub(crate) fn apply(self, left: ComputedNumber, right: ComputedNumber) -> Result<ComputedNumber, Unsure> {
        match (left, right) {
            (ComputedNumber::Int(left), ComputedNumber::Int(right)) => {
                self.whole(left, right).map(ComputedNumber::Int).ok_or(Unsure)
            }
            (left, right) => Ok(ComputedNumber::Float(self.measured(left.float(), right.float()))),
        }
    }

    #[inline]
    fn whole(self, left: i64, right: i64) -> Option<i64> {
        match self {
            Self::Plus => left.checked_add(right),
            Self::Minus => left.checked_sub(right),
            Self::Times => left.checked_mul(right),
            Self::Over => left.checked_div(right),
            Self::Rest => left.checked_rem(right),
        }
    }

    #[inline]
    fn measured(self, left: f64, right: f64) -> f64 {
        match self {
            Self::Plus => left + right,
            Self::Minus => left - right,
            Self::Times => left * right,
            Self::Over => left / right,
            Self::Rest => left % right,
        }
    }
}
