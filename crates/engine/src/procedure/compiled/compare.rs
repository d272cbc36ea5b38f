//! Comparisons as Rhai makes them: measured numbers within a tolerance, different kinds never equal.

use super::Unsure;
use super::numbers::ComputedNumber;
use behaviour::Value;
use std::cmp::Ordering;

/// A comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CompiledComparison {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

impl CompiledComparison {
    #[inline]
    pub(super) fn holds(self, left: &Value, right: &Value) -> Result<bool, Unsure> {
        match (left, right) {
            (Value::Int(left), Value::Int(right)) => Ok(self.allows(left.cmp(right))),
            (Value::Float(left), Value::Float(right)) => Ok(self.measured(*left, *right)),
            (Value::Float(left), Value::Int(right)) => Ok(self.measured(*left, *right as f64)),
            (Value::Int(left), Value::Float(right)) => Ok(self.measured(*left as f64, *right)),
            (left, right) => self.others(left, right),
        }
    }

    /// True if it holds with a number on the right: no other kind is equal to it, smaller or larger.
    #[inline(always)]
    pub(crate) fn holds_number(self, left: &Value, right: ComputedNumber) -> bool {
        match (left, right) {
            (Value::Int(left), ComputedNumber::Int(right)) => self.allows(left.cmp(&right)),
            (Value::Float(left), right) => self.measured(*left, right.float()),
            (Value::Int(left), ComputedNumber::Float(right)) => self.measured(*left as f64, right),
            _ => self == Self::NotEqual,
        }
    }

    fn others(self, left: &Value, right: &Value) -> Result<bool, Unsure> {
        match (left, right) {
            (Value::Bool(left), Value::Bool(right)) => Ok(self.allows(left.cmp(right))),
            (Value::Text(left), Value::Text(right)) => Ok(self.allows(left.cmp(right))),
            (Value::Null, Value::Null) => Ok(self == Self::Equal),
            (Value::List(_), Value::List(_)) | (Value::Map(_), Value::Map(_)) => Err(Unsure),
            _ => Ok(self == Self::NotEqual),
        }
    }

    #[inline]
    fn allows(self, order: Ordering) -> bool {
        match self {
            Self::Equal => order.is_eq(),
            Self::NotEqual => order.is_ne(),
            Self::Less => order.is_lt(),
            Self::LessEqual => order.is_le(),
            Self::Greater => order.is_gt(),
            Self::GreaterEqual => order.is_ge(),
        }
    }

    /// Equal is what differs by less than the last bit of the larger one. Written as in Rhai, since with NaN and
    /// infinity no comparison is the opposite of another.
    #[inline]
    fn measured(self, x: f64, y: f64) -> bool {
        let scale = if x * y == 0.0 { 1.0 } else { x.abs().max(y.abs()) };
        if scale == 0.0 {
            // Only NaN and zero: they count as equal.
            return self.allows(Ordering::Equal);
        }
        match self {
            Self::Equal => (x - y).abs() / scale <= f64::EPSILON,
            Self::NotEqual => (x - y).abs() / scale > f64::EPSILON,
            Self::Less => (y - x) / scale > f64::EPSILON,
            Self::LessEqual => (y - x) / scale > -f64::EPSILON,
            Self::Greater => (x - y) / scale > f64::EPSILON,
            Self::GreaterEqual => (x - y) / scale > -f64::EPSILON,
        }
    }
}
