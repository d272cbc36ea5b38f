//! The knowledge of the rules about a device: the kind of its values, how fast they come, and what it uses.

use super::{Unit, ValueType};

/// A device with its parameters, as far as hints need to know it. Nothing is known by default, and no hint is given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceType {
    /// The kind of value that it gives, or takes.
    pub value: ValueType,
    /// The pace of its values, or the time that one of them keeps it busy.
    pub pace: DevicePace,
    /// True if a sense that tells two moments apart also tells that something ended.
    pub tells_end: bool,
    /// The parts of the robot that it uses.
    pub claims: Claims,
}

/// The parts of the robot that an action uses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Claims {
    /// The parts of the body, by their names in files.
    pub parts: Vec<String>,
    /// True if its commands replace each other, so that two actions on the same part undo each other's work. Else they
    /// are done one after the other.
    pub replaces: bool,
}

/// The pace of a sense's values, or the time that an action is busy with one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DevicePace {
    /// One cannot tell.
    #[default]
    Unknown,
    /// A sense that reads many times a second, always.
    Steady,
    /// A sense that reads many times a second for as long as there is something to sense, and then falls silent.
    WhileThere,
    /// A sense that tells when something happens.
    Happening,
    /// An action that is done at once, or goes on until told otherwise.
    Brief,
    /// An action that is busy for a second or longer with each value.
    Lasting,
}

impl DevicePace {
    /// True if a sense reads many times a second.
    #[must_use]
    pub fn is_fast(self) -> bool {
        matches!(self, Self::Steady | Self::WhileThere)
    }
}

impl ValueType {
    /// The object that a connector with a timestamp makes of a value: `v` with its time `t`.
    #[must_use]
    pub fn with_time(self) -> Self {
        Self::record([("v", self), ("t", Self::in_unit(Unit::Milliseconds))])
    }
}
