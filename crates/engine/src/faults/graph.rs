//! The reasons why a behaviour, or a part of it, cannot run or goes no further.

use super::BodyFault;
use behaviour::FlawKind;
use behaviour::connectors::Inputs;

/// One reason why a behaviour is refused. [`std::fmt::Display`] says it in one line: `id: reason`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GraphFault {
    /// The stream, connector or helper.
    pub id: String,
    /// The reason why it is refused.
    pub reason: Reason,
}

/// The reasons why a part of a behaviour is refused. [`std::fmt::Display`] says each in a few English words, without a
/// dot at the end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The file is wrong there.
    Flaw(FlawKind),
    /// A frame is too short or too long.
    FrameLength,
    /// The connector of this word takes another number of inputs.
    Inputs {
        /// The connector's word in files.
        word: &'static str,
        /// The number of inputs that it takes.
        takes: Inputs,
        /// The number of inputs that it has.
        gets: usize,
    },
    /// It has this input twice.
    InputTwice(String),
    /// It takes from this actuator stream.
    OutOfActuator(String),
    /// It leads into this sensor stream.
    IntoSensor(String),
    /// It leads into this actuator stream, and is no subscribe.
    OnlySubscribe(String),
    /// The connector of this word leads to this stream, which is no actuator stream.
    NoActuator(&'static str, String),
    /// It leads to this stream, which another connector leads to already.
    SecondInput(String),
    /// Values would come back to it.
    Circle,
    /// It names this helper, which is not there.
    NoHelper(String),
    /// The helper takes another number of values.
    HelperInputs {
        /// The helper.
        helper: String,
        /// The number of values that the helper takes.
        takes: usize,
        /// The number of values that it would get.
        gets: usize,
    },
    /// It names more or fewer arguments than its procedure has.
    Arguments {
        /// The number of arguments that it names.
        names: usize,
        /// The number of inputs that it has.
        inputs: usize,
    },
    /// Another helper has this name too.
    NameTwice,
    /// The helper of this name calls itself, perhaps through others.
    CallsItself(String),
    /// The procedure of the connector cannot run.
    Body(BodyFault),
}

/// The reasons why a run ended by itself although nobody stopped it. [`std::fmt::Display`] says each, and what to do
/// about it, without a dot at the end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RunFault {
    /// One reading, or one tick, became too many values at the stream of this name.
    Multiplied(String),
}

impl std::error::Error for GraphFault {}
impl std::error::Error for RunFault {}

impl From<FlawKind> for Reason {
    fn from(flaw: FlawKind) -> Self {
        Self::Flaw(flaw)
    }
}

impl From<BodyFault> for Reason {
    fn from(fault: BodyFault) -> Self {
        Self::Body(fault)
    }
}
