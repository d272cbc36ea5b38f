//! The rows of `nao_body.toml`, as they are written there.

use phrase::{Phrase, Phrased, phrase};
use serde::Deserialize;

/// Why the file is no table of the robot.
#[derive(Debug)]
pub(crate) enum TableFault {
    /// It is not written as one.
    Unreadable(toml::de::Error),
    /// The joints are not in the order of [`robot::JOINTS`].
    Order,
    /// A posture has too few angles, or too many.
    Posture,
    /// It has no link of this name.
    NoLink(String),
    NoCamera,
    /// It has not two sonars.
    Sonars,
}

phrase::shown!(TableFault);

impl Phrased for TableFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Unreadable(error) => Phrase::Text(error.to_string()),
            Self::Order => phrase!("TableFault.Order", "the joints of the table are not in the order of robot::JOINTS"),
            Self::Posture => phrase!("TableFault.Posture", "a posture has 26 angles"),
            Self::NoLink(name) => phrase!("TableFault.NoLink", "no link {name}"),
            Self::NoCamera => phrase!("TableFault.NoCamera", "no top camera"),
            Self::Sonars => phrase!("TableFault.Sonars", "a NAO has two sonars"),
        }
    }
}

/// The contents of the file.
#[derive(Deserialize)]
pub(crate) struct BodyTable {
    pub(crate) links: Vec<BodyPart>,
    pub(crate) joints: Vec<JointRow>,
    pub(crate) hands: Vec<HandRow>,
    pub(crate) head_pitch_by_yaw: Vec<[f32; 3]>,
    pub(crate) cameras: Vec<CameraRow>,
    pub(crate) sonars: Vec<SonarRow>,
    pub(crate) postures: Postures,
}

/// A rigid part of the body.
#[derive(Deserialize)]
pub(crate) struct BodyPart {
    pub(crate) name: String,
    pub(crate) shapes: Vec<Primitive>,
}

/// A primitive shape in the frame of its link, in metres.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(crate) enum Primitive {
    Box { at: [f32; 3], half: [f32; 3] },
    Sphere { at: [f32; 3], r: f32 },
    Capsule { a: [f32; 3], b: [f32; 3], r: f32 },
}

#[derive(Deserialize)]
pub(crate) struct JointRow {
    pub(crate) name: String,
    pub(crate) parent: String,
    pub(crate) child: String,
    pub(crate) at: [f32; 3],
    pub(crate) axis: [f32; 3],
    pub(crate) limits: [f32; 2],
    pub(crate) vmax: f32,
    pub(crate) couple: Option<String>,
}

#[derive(Deserialize)]
pub(crate) struct HandRow {
    pub(crate) range: [f32; 2],
    pub(crate) vmax: f32,
}

#[derive(Deserialize)]
pub(crate) struct CameraRow {
    pub(crate) name: String,
    pub(crate) link: String,
    pub(crate) at: [f32; 3],
    pub(crate) pitch_down: f32,
    pub(crate) hfov: f32,
    pub(crate) vfov: f32,
}

#[derive(Deserialize)]
pub(crate) struct SonarRow {
    pub(crate) link: String,
    pub(crate) at: [f32; 3],
    pub(crate) yaw: f32,
    pub(crate) pitch_down: f32,
    pub(crate) half_cone: f32,
}

#[derive(Deserialize)]
#[serde(rename_all = "PascalCase")]
pub(crate) struct Postures {
    pub(crate) stand: Vec<f32>,
    pub(crate) stand_init: Vec<f32>,
    pub(crate) crouch: Vec<f32>,
    pub(crate) sit: Vec<f32>,
}
