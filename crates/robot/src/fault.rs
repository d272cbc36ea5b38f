//! Why a robot does not do what it is asked for.

use crate::DeviceFault;
use crate::params::shown;
use std::fmt;

/// Why a robot does not open a device, or drops a value. [`fmt::Display`] says it in a few English words.
#[derive(Clone, Debug, PartialEq)]
pub enum RobotFault {
    /// It has no device of this name.
    NoDevice(String),
    /// The body or the software lacks what the device needs; with the reason: "its body has no left hand".
    Lacks(String),
    /// The parameters that were chosen for the device do not fit.
    Device(DeviceFault),
    /// It cannot use the device of this name with what was chosen for it.
    Unusable(String),
    /// It serves no more than so many streams.
    Full(usize),
    /// A value is for a sense.
    IntoSense,
    /// A value is for a stream without an open action.
    NotOpen,
    /// A value has a number that is not finite.
    Infinite,
    /// A value is no number, and the action needs one.
    NoNumber,
    /// A value is no colour.
    NoColor,
    /// A value cannot be said.
    NotSayable,
    /// The text to say is empty.
    NothingToSay,
    /// The text to say is longer than so many characters.
    TextTooLong(usize),
    /// The queue of texts to say is full: so many wait already.
    TextsWait(usize),
    /// No behaviour is named, neither for the action nor by the value.
    NoBehavior,
    /// Nobody is in view whose face could be remembered.
    NoFace,
    /// A value is no list of as many numbers as the group has joints.
    NoGroup(usize),
    /// It cannot do this as it is now; with the reason: "it lies on the floor".
    NotNow(String),
    /// The link is gone, or not there yet.
    NoLink,
}

impl std::error::Error for RobotFault {}

impl From<DeviceFault> for RobotFault {
    fn from(fault: DeviceFault) -> Self {
        Self::Device(fault)
    }
}

impl fmt::Display for RobotFault {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoDevice(name) => write!(to, "this robot has no device called “{}”", shown(name)),
            Self::Lacks(why) => write!(to, "{why}"),
            Self::Device(fault) => write!(to, "{fault}"),
            Self::Unusable(name) => write!(to, "this robot cannot use “{name}” with these settings"),
            Self::Full(streams) => write!(to, "this robot serves {streams} streams at most"),
            Self::IntoSense => to.write_str("a sense cannot be told a value"),
            Self::NotOpen => to.write_str("no action is open for this stream"),
            Self::Infinite => to.write_str("a number that is not finite was left out"),
            Self::NoNumber => to.write_str("this action needs a number"),
            Self::NoColor => to.write_str("a color is a name like “red”, or r, g and b from 0 to 1"),
            Self::NotSayable => to.write_str("only a text or a number can be said"),
            Self::NothingToSay => to.write_str("there is nothing to say"),
            Self::TextTooLong(chars) => write!(to, "a text to say may have {chars} characters"),
            Self::TextsWait(many) => write!(to, "{many} texts already wait to be said, so this one is left out"),
            Self::NoGroup(joints) => write!(to, "this group needs a list of {joints} numbers"),
            Self::NotNow(why) => write!(to, "the robot cannot do this now: {why}"),
            Self::NoLink => to.write_str("there is no connection to the robot"),
            Self::NoBehavior => to.write_str("choose a behaviour for it, or let the value name one"),
            Self::NoFace => to.write_str("no face is in view, so none was remembered"),
        }
    }
}
