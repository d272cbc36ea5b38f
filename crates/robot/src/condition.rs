//! The condition of the robot's body: what an operator looks at before pressing Start.

use phrase::Phrase;
use serde::{Deserialize, Serialize};

/// Most names of faces that are told of one robot.
pub const FACES_MAX: usize = 200;

/// The condition of the body; what is not known is none. For people, as plain lights with words.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Condition {
    /// The charge of the battery, from 0 to 100 percent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub battery: Option<u8>,
    /// True if it is charging or on the cable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plugged: Option<bool>,
    /// True if it is awake: its motors are on and it holds a posture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub awake: Option<bool>,
    /// True if the motors are stiff enough to move.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiff: Option<bool>,
    /// The life of its own: what it does of its own accord.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub life: Option<Life>,
    /// Joints that are too hot, by their names in [`crate::JOINTS`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hot: Vec<String>,
    /// True if it lies where it fell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fallen: Option<bool>,
    /// Why it cannot walk or turn its whole body now, in a few English words: "it sits; let it stand up first".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub legs: Option<Phrase>,
    /// The way in which it is in the network.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub network: Option<Network>,
    /// The number of faces that it remembers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<u16>,
}

/// The own life of a NAO: the states of ALAutonomousLife (NAOqi 2.8).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Life {
    /// Nothing: behaviours have it for themselves.
    Disabled,
    /// It protects itself after a fall or from heat, and takes no commands.
    Safeguard,
    /// It moves a little by itself.
    Solitary,
    /// It looks for people and talks to them.
    Interactive,
}

/// The way in which a robot is in the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Network {
    /// By a cable.
    Cable,
    /// By Wi-Fi, as strong as this, from 0 to 100 percent.
    Wifi(u8),
}

/// A change of who has the robot, or something that a person has it do with its body or its memory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Control {
    /// *Take control*: its own life ends, it stands up and its motors are on.
    Take,
    /// *Give back*: its own life goes on as it was before control was taken.
    GiveBack,
    /// *Rest*: everything stops, it crouches and its motors go off.
    Rest,
    /// *Make its eyes blink*: a sign by lights alone, for a moment, by which people see which robot it is.
    Blink,
    /// *Wake up*: its motors go on, and it holds a posture.
    WakeUp,
    /// *Stand up*.
    Stand,
    /// *Sit down*; its motors stay on.
    Sit,
    /// *Forget faces*: whatever it remembers of faces is gone for good.
    ForgetFaces,
    /// *Forget one face*: that which it remembers under this name, one of [`crate::Robot::faces`].
    ForgetFace(String),
}

impl Control {
    /// True if everything that runs is ended for it.
    #[must_use]
    pub fn ends_runs(&self) -> bool {
        matches!(self, Self::GiveBack | Self::Rest)
    }

    /// True if the body may move for it, so that a Stop that comes before it makes it void.
    #[must_use]
    pub fn moves_body(&self) -> bool {
        matches!(self, Self::Take | Self::WakeUp | Self::Stand | Self::Sit)
    }

    /// True if it moves the body, so that it waits until nothing runs.
    #[must_use]
    pub fn needs_quiet(&self) -> bool {
        matches!(self, Self::WakeUp | Self::Stand | Self::Sit)
    }
}

/// A device that a robot does not have. A device of the catalogue is here or in [`crate::Robot::devices`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lacking {
    /// The device's name.
    pub device: String,
    /// The reason in a few words: "it has no wrists".
    pub why: Phrase,
}
