//! The robot in its room as a picture: enough to draw it and to move things in it, in metres and radians.
//! x points ahead of where the robot first stood, y to its left, z up.

use serde::{Deserialize, Serialize};

/// The joints of a NAO in the order of [`Body::joints`]; the last two are hands (0 closed, 1 open).
pub const JOINTS: [&str; 26] = [
    "HeadYaw",
    "HeadPitch",
    "LShoulderPitch",
    "LShoulderRoll",
    "LElbowYaw",
    "LElbowRoll",
    "LWristYaw",
    "RShoulderPitch",
    "RShoulderRoll",
    "RElbowYaw",
    "RElbowRoll",
    "RWristYaw",
    "LHipYawPitch",
    "LHipRoll",
    "LHipPitch",
    "LKneePitch",
    "LAnklePitch",
    "LAnkleRoll",
    "RHipYawPitch",
    "RHipRoll",
    "RHipPitch",
    "RKneePitch",
    "RAnklePitch",
    "RAnkleRoll",
    "LHand",
    "RHand",
];

/// Everything in the room at one moment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Scene {
    /// Robot time in milliseconds.
    pub at_ms: u64,
    /// The robot.
    pub body: Body,
    /// The balls.
    pub balls: Vec<Ball>,
    /// The people.
    pub people: Vec<Person>,
}

/// The robot's body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Body {
    /// Where it stands: x and y in metres, heading in radians, left positive.
    pub base: [f32; 3],
    /// Joint angles in the order of [`JOINTS`].
    pub joints: Vec<f32>,
    /// Colour of the eyes: red, green, blue from 0 to 1, brightness included.
    pub eyes: [f32; 3],
    /// What it is saying, empty when silent.
    pub saying: String,
    /// What it follows and how, empty when it follows nothing: "red ball with head".
    pub tracking: String,
    /// The last texts printed, newest last; at most 20.
    pub printed: Vec<String>,
    /// Where the head's top camera is and its direction in the room: x, y, z, yaw, pitch (down positive).
    pub gaze: [f32; 5],
    /// Half of the camera's horizontal field of view in radians.
    pub gaze_half: f32,
    /// The hands in the room, left then right: x, y, z.
    pub hands: [[f32; 3]; 2],
    /// Whether the head is being touched.
    pub head_touched: bool,
}

/// A ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Ball {
    /// Its name for [`SceneEdit`]: `red`, `green`, `blue`.
    pub id: String,
    /// Its colour: `red`, `green` or `blue`.
    pub color: String,
    /// Its middle.
    pub at: [f32; 3],
    /// Its radius in metres.
    pub radius: f32,
    /// Whether the robot sees it now.
    pub seen: bool,
}

/// A person.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Person {
    /// The person's name for [`SceneEdit`]: `person`.
    pub id: String,
    /// Feet: x and y.
    pub at: [f32; 2],
    /// Height in metres.
    pub height: f32,
    /// Whether the robot sees the face now.
    pub seen: bool,
    /// Whether the robot has learned the face.
    pub known: bool,
    /// Whether the person is in the room.
    pub present: bool,
}

/// Something a person does in the simulated room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", tag = "do")]
pub enum SceneEdit {
    /// Moves a ball there and holds it.
    MoveBall {
        /// Which.
        id: String,
        /// Its middle in metres; clamped to the room.
        at: [f32; 3],
    },
    /// Moves a person there, facing the robot.
    MovePerson {
        /// Who.
        id: String,
        /// Feet in metres.
        at: [f32; 2],
    },
    /// Brings a person in or sends them out.
    SetPresent {
        /// Who.
        id: String,
        /// In the room or not.
        present: bool,
    },
    /// Touches the head or lets go.
    TouchHead {
        /// Down or up.
        down: bool,
    },
    /// Everything as it was at first, the robot included.
    Reset,
}
