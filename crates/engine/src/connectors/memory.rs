//! The memory of a connector from one instant to the next, in a form that both modes give and take.

use crate::values::Carried;
use behaviour::Value;
use robot::Millis;

/// The memory of a connector. Each kind of connector chooses the fields that it uses, and for what.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Memory {
    /// Values that it knows, each in its place.
    pub(crate) known: Vec<Option<Value>>,
    /// Values that it will give by itself, the first one first.
    pub(crate) waiting: Vec<Waiting>,
}

/// A value that will be given by itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Waiting {
    pub(crate) carried: Carried,
    pub(crate) due: Millis,
}
