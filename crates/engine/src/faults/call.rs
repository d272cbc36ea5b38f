//! The reasons why a connector makes no value of one that it took.

use super::{BodyFault, ValueKind};
use behaviour::Value;

/// The reasons why a connector dropped a value. [`std::fmt::Display`] says each, and what to do about it, in a few
/// English words.
#[derive(Clone, Debug, PartialEq)]
pub enum CallFault {
    /// It went wrong in the helper of this name.
    InHelper(String, Box<Self>),
    /// The procedure threw this text.
    Said(String),
    /// The procedure threw this value.
    Thrown(Value),
    /// It divides by zero.
    ByZero,
    /// A whole number became too large.
    Overflow,
    /// Numbers cannot be computed with; as Rhai says it.
    Arithmetic(String),
    /// An object has no field of this name.
    NoField(String),
    /// A value of this kind has no field of this name.
    NoFieldOf(ValueKind, String),
    /// A field cannot be taken; as Rhai says it.
    Field(String),
    /// There is no function with this signature, such as `- (map, i64)`.
    NoFunction(String),
    /// A value of the first kind is needed, not one of the second.
    Mismatch(ValueKind, ValueKind),
    /// A value of this kind has no parts.
    NoParts(ValueKind),
    /// A list of so many items has none at this place.
    NoItem(usize, i64),
    /// A text of so many letters has none at this place.
    NoLetter(usize, i64),
    /// There is no value of this name.
    NoValue(String),
    /// A loop goes through something that has no parts.
    NotIterable,
    /// The caller's interrupt ended it.
    Interrupted,
    /// It takes more steps than it may.
    Steps,
    /// The calls of the procedure are nested too deep.
    Nested,
    /// A text, list or object became too large.
    TooLarge,
    /// It has too many variables.
    Variables,
    /// Anything else, as Rhai says it.
    Rhai(String),
    /// The value that it made cannot flow.
    Value(ValueFault),
    /// It broke Rhai.
    Broken,
    /// It could be read before, and cannot any more.
    Unread(Box<BodyFault>),
    /// A filter answered this.
    NoTruth(Value),
    /// Too many values wait.
    Waiting,
}

/// The reasons why a value of a procedure cannot flow. [`std::fmt::Display`] says each, and what to do about it, in a
/// few English words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ValueFault {
    /// The names of its fields are too long together.
    LongNames,
    /// It is, or has, a number that is none.
    NotANumber,
    /// It is, or has, an infinite number.
    Infinite,
    /// It is nested too deep.
    TooDeep,
    /// It is, or has, something of a kind that no stream carries.
    Kind(ValueKind),
}

impl std::error::Error for CallFault {}
impl std::error::Error for ValueFault {}

impl CallFault {
    /// True if the caller's interrupt ended it.
    pub(crate) fn is_deadline(&self) -> bool {
        match self {
            Self::InHelper(_, inner) => inner.is_deadline(),
            Self::Interrupted => true,
            _ => false,
        }
    }
}
