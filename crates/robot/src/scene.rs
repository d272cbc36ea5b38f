//! The robot in its room as a picture: enough to draw it and to move things in it, in metres and radians.
//! x points ahead of where the robot first stood, y to its left, z up.

use crate::Use;
use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
#[serde(rename_all = "camelCase", default)]
pub struct Scene {
    /// Robot time in milliseconds.
    pub at_ms: u64,
    /// The robot.
    pub body: Body,
    /// The balls.
    pub balls: Vec<Ball>,
    /// The people.
    pub people: Vec<ScenePerson>,
    /// The things that stand in the way.
    pub obstacles: Vec<Obstacle>,
    /// The printed marks.
    pub landmarks: Vec<PrintedMark>,
}

/// A value that the robot was told to show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Printed {
    /// The running behaviour, and its stream.
    pub by: Use,
    /// Robot time in milliseconds.
    pub at_ms: u64,
    /// The value, as a text.
    pub text: String,
}

/// The robot's body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Body {
    /// Where it stands: x and y in metres, heading in radians, left positive.
    pub base: [f32; 3],
    /// Joint angles in the order of [`JOINTS`].
    pub joints: Vec<f32>,
    /// Colour of the eyes: red, green, blue from 0 to 1, brightness included.
    pub eyes: [f32; 3],
    /// The text that it is saying, empty when silent.
    pub saying: String,
    /// The target that it follows and how, empty when it follows nothing: "red ball with head".
    pub tracking: String,
    /// The texts that were printed last, newest last; at most 20.
    pub printed: Vec<Printed>,
    /// Where the head's top camera is and its direction in the room: x, y, z, yaw, pitch (down positive).
    pub gaze: [f32; 5],
    /// Half of the camera's horizontal field of view in radians.
    pub gaze_half: f32,
    /// The hands in the room, left then right: x, y, z.
    pub hands: [[f32; 3]; 2],
    /// The height of the middle of the torso above the floor, in metres, and its lean ahead, in radians.
    pub torso: [f32; 2],
    /// Where it is being touched or pressed, in the order of [`Touchable::ALL`].
    pub touched: Vec<Touchable>,
    /// The charge of the battery, in percent; 0 if that is not known.
    pub battery: u8,
    /// True if it is on the cable.
    pub plugged: bool,
    /// The posture of the robot, in the families of NAOqi: "Standing", "Crouching", "Sitting", "LyingBelly", or
    /// "Unknown" between them.
    pub posture: String,
    /// True if it lies where it fell.
    pub fallen: bool,
    /// The gesture and the sounds that it plays, for people; empty when it plays nothing: "waving, beep".
    pub playing: String,
    /// The words that it heard last; empty before any.
    pub heard: String,
    /// The colours of its lights beside the eyes, by the parts of the action *Lights*, as far as a program has lit
    /// them.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub lights: BTreeMap<String, [f32; 3]>,
}

/// Where a NAO feels a touch: three fields on the head, three on each hand, and a bumper on each foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Touchable {
    /// The front of the head.
    HeadFront,
    /// The middle of the head.
    HeadMiddle,
    /// The rear of the head.
    HeadRear,
    /// The back of the left hand.
    HandLeftBack,
    /// The left side of the left hand.
    HandLeftLeft,
    /// The right side of the left hand.
    HandLeftRight,
    /// The back of the right hand.
    HandRightBack,
    /// The left side of the right hand.
    HandRightLeft,
    /// The right side of the right hand.
    HandRightRight,
    /// The bumper of the left foot.
    BumperLeft,
    /// The bumper of the right foot.
    BumperRight,
}

impl Touchable {
    /// All of them, from the head down.
    pub const ALL: [Self; 11] = [
        Self::HeadFront,
        Self::HeadMiddle,
        Self::HeadRear,
        Self::HandLeftBack,
        Self::HandLeftLeft,
        Self::HandLeftRight,
        Self::HandRightBack,
        Self::HandRightLeft,
        Self::HandRightRight,
        Self::BumperLeft,
        Self::BumperRight,
    ];
}

/// In the middle of a sentence: "the front of the head".
impl Phrased for Touchable {
    fn phrase(&self) -> Phrase {
        match self {
            Self::HeadFront => phrase!("Touchable.HeadFront", "front of the head"),
            Self::HeadMiddle => phrase!("Touchable.HeadMiddle", "middle of the head"),
            Self::HeadRear => phrase!("Touchable.HeadRear", "rear of the head"),
            Self::HandLeftBack => phrase!("Touchable.HandLeftBack", "back of the left hand"),
            Self::HandLeftLeft => phrase!("Touchable.HandLeftLeft", "left side of the left hand"),
            Self::HandLeftRight => phrase!("Touchable.HandLeftRight", "right side of the left hand"),
            Self::HandRightBack => phrase!("Touchable.HandRightBack", "back of the right hand"),
            Self::HandRightLeft => phrase!("Touchable.HandRightLeft", "left side of the right hand"),
            Self::HandRightRight => phrase!("Touchable.HandRightRight", "right side of the right hand"),
            Self::BumperLeft => phrase!("Touchable.BumperLeft", "bumper of the left foot"),
            Self::BumperRight => phrase!("Touchable.BumperRight", "bumper of the right foot"),
        }
    }
}

/// A ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Ball {
    /// The name of the ball for [`SceneEdit`]: `red`, `green`, `blue`.
    pub id: String,
    /// The colour of the ball: `red`, `green` or `blue`.
    pub color: String,
    /// The middle of the ball: x, y and z in metres.
    pub at: [f32; 3],
    /// The radius of the ball in metres.
    pub radius: f32,
    /// True if the robot sees it now.
    pub seen: bool,
}

/// A person.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ScenePerson {
    /// The person's name for [`SceneEdit`]: `person`, `friend`.
    pub id: String,
    /// Feet: x and y.
    pub at: [f32; 2],
    /// Height in metres.
    pub height: f32,
    /// True if the robot sees the face now.
    pub seen: bool,
    /// True if the robot has learned the face.
    pub known: bool,
    /// True if the person is in the room.
    pub present: bool,
}

/// A box that stands in the way, its sides along the walls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Obstacle {
    /// The name of the obstacle for [`SceneEdit`]: `box`, `block`.
    pub id: String,
    /// The colour of the obstacle: `red`, `green`, `blue` or `grey`.
    pub color: String,
    /// The middle of the obstacle on the floor: x and y in metres.
    pub at: [f32; 2],
    /// The length along x and y, and the height, in metres.
    pub size: [f32; 3],
    /// True if it is in the room.
    pub present: bool,
}

/// A printed mark with a number, upright.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PrintedMark {
    /// The name of the mark for [`SceneEdit`]: `mark64`, `mark80`.
    pub id: String,
    /// The number of the mark.
    pub number: u16,
    /// The middle of the mark: x, y and z in metres.
    pub at: [f32; 3],
    /// Where its front looks: a heading in radians, 0 along x, left positive.
    pub facing: f32,
    /// The radius of the mark in metres.
    pub radius: f32,
    /// True if the robot sees it well enough to read it now.
    pub seen: bool,
    /// True if it is in the room.
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
        /// The new middle of the ball in metres; clamped to the room.
        at: [f32; 3],
    },
    /// Moves a person there, facing the robot.
    MovePerson {
        /// The person who moves.
        id: String,
        /// Feet in metres.
        at: [f32; 2],
    },
    /// Moves what stands in the way.
    MoveObstacle {
        /// Which.
        id: String,
        /// The new middle of the obstacle on the floor in metres; clamped to the room.
        at: [f32; 2],
    },
    /// Moves a printed mark.
    MoveLandmark {
        /// Which.
        id: String,
        /// The new middle of the mark in metres; clamped to the room.
        at: [f32; 3],
        /// Where its front looks: a heading in radians.
        facing: f32,
    },
    /// Brings a person, an obstacle or a printed mark in, or sends it out.
    SetPresent {
        /// The person, obstacle or mark.
        id: String,
        /// In the room or not.
        present: bool,
    },
    /// Touches the robot somewhere, or lets go.
    Touch {
        /// Where.
        part: Touchable,
        /// Down or up.
        down: bool,
    },
    /// Somebody says something: the nearest person, or somebody a metre ahead if nobody is there.
    Speak {
        /// The words, at most [`SPOKEN_MAX_CHARS`] characters.
        words: String,
    },
    /// A loud noise, like clapping.
    Noise {
        /// Where, in metres; clamped to the room.
        at: [f32; 3],
    },
    /// Makes the battery so full.
    SetBattery {
        /// From 0 to 100 percent.
        percent: u8,
    },
    /// Puts the robot on the cable, or takes it off.
    Plug {
        /// On the cable or not.
        plugged: bool,
    },
    /// Lets the clock on the wall go on, for programs that go by the time of day.
    PassTime {
        /// By so many minutes.
        minutes: u16,
    },
    /// Pushes the robot over: it falls ahead.
    Push,
    /// Helps the robot up after a fall.
    HelpUp,
    /// Everything as it was at first, the robot included.
    Reset,
}

/// The longest that somebody says at once in [`SceneEdit::Speak`], in characters.
pub const SPOKEN_MAX_CHARS: usize = 200;

#[cfg(test)]
mod tests {
    use super::Touchable;
    use phrase::Phrased;

    #[test]
    fn what_can_be_touched_is_told_apart_in_words_and_listed_in_order() {
        assert!(Touchable::ALL.is_sorted());
        let mut words = Touchable::ALL.map(|part| part.phrase().to_string()).to_vec();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), Touchable::ALL.len());
    }
}
