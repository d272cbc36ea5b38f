//! Why a robot does not do what it is asked for.

use crate::DeviceFault;
use crate::params::shown;
use phrase::{Phrase, Phrased, phrase};

/// Why a robot does not open a device, or drops a value. [`std::fmt::Display`] says it in a few English words.
#[derive(Clone, Debug, PartialEq)]
pub enum RobotFault {
    /// It has no device of this name.
    NoDevice(String),
    /// The body or the software lacks what the device needs; with the reason: "its body has no left hand".
    Lacks(Phrase),
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
    NotNow(Phrase),
    /// The link is gone, or not there yet.
    NoLink,
}

impl std::error::Error for RobotFault {}

impl From<DeviceFault> for RobotFault {
    fn from(fault: DeviceFault) -> Self {
        Self::Device(fault)
    }
}

phrase::shown!(RobotFault);

impl Phrased for RobotFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::NoDevice(name) => {
                phrase!("RobotFault.NoDevice", "this robot has no device called “{name}”", name = shown(name))
            }
            Self::Lacks(why) => why.phrase(),
            Self::Device(fault) => fault.phrase(),
            Self::Unusable(name) => {
                phrase!("RobotFault.Unusable", "this robot cannot use “{name}” with these settings")
            }
            Self::Full(streams) => phrase!("RobotFault.Full", "this robot serves {streams} streams at most"),
            Self::IntoSense => phrase!("RobotFault.IntoSense", "a sense cannot be told a value"),
            Self::NotOpen => phrase!("RobotFault.NotOpen", "no action is open for this stream"),
            Self::Infinite => phrase!("RobotFault.Infinite", "a number that is not finite was left out"),
            Self::NoNumber => phrase!("RobotFault.NoNumber", "this action needs a number"),
            Self::NoColor => phrase!("RobotFault.NoColor", "a color is a name like “red”, or r, g and b from 0 to 1"),
            Self::NotSayable => phrase!("RobotFault.NotSayable", "only a text or a number can be said"),
            Self::NothingToSay => phrase!("RobotFault.NothingToSay", "there is nothing to say"),
            Self::TextTooLong(chars) => phrase!("RobotFault.TextTooLong", "a text to say may have {chars} characters"),
            Self::TextsWait(many) => {
                phrase!("RobotFault.TextsWait", "{many} texts already wait to be said, so this one is left out")
            }
            Self::NoGroup(joints) => phrase!("RobotFault.NoGroup", "this group needs a list of {joints} numbers"),
            Self::NotNow(why) => phrase!("RobotFault.NotNow", "the robot cannot do this now: {why}"),
            Self::NoLink => phrase!("RobotFault.NoLink", "there is no connection to the robot"),
            Self::NoBehavior => {
                phrase!("RobotFault.NoBehavior", "choose a behaviour for it, or let the value name one")
            }
            Self::NoFace => phrase!("RobotFault.NoFace", "no face is in view, so none was remembered"),
        }
    }
}
