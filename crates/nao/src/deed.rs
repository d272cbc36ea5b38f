//! The deeds that actions want of the robot: made from a value on the robot's thread, done on the link's.

use qi::Value;
use robot::{TrackMode, TrackTarget};
use std::time::Duration;

/// A call of a service.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ServiceCall {
    pub(crate) service: &'static str,
    pub(crate) method: &'static str,
    pub(crate) arguments: Vec<Value>,
}

impl ServiceCall {
    pub(crate) fn new(service: &'static str, method: &'static str, arguments: impl Into<Vec<Value>>) -> Self {
        Self { service, method, arguments: arguments.into() }
    }
}

/// Ahead, to the left and turning, in metres and radians a second.
pub(crate) type Speeds = [f64; 3];

/// The manner in which to speak.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Manner {
    /// From 0 to 1.
    pub(crate) volume: f32,
    /// In percent of the usual speed.
    pub(crate) speed: f32,
    /// True if it moves its arms meanwhile.
    pub(crate) gestures: bool,
    /// By its English name; none leaves it.
    pub(crate) language: Option<String>,
}

/// The target that is followed, and the parts that follow it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FollowedTrack {
    pub(crate) target: TrackTarget,
    pub(crate) mode: TrackMode,
    pub(crate) arm: WhichArm,
}

/// Which arm points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WhichArm {
    None,
    Left,
    Right,
    Nearest,
}

/// A deed that is to be done.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Action {
    /// The eyes get a colour, red, green and blue from 0 to 1, and keep their brightness; the newest counts.
    Eyes([f32; 3]),
    /// The eyes get a brightness from 0 to 1, and keep their colour; the newest counts.
    Glow(f32),
    /// Joints go to angles; the newest of each joint counts.
    Joints {
        joints: Vec<&'static str>,
        angles: Vec<f64>,
        /// The speed as a fraction of the top speed.
        speed: f64,
    },
    /// Something that takes its time; not begun again while it lasts.
    Lasting {
        /// The name of it, among all that may last.
        what: String,
        /// The calls that begin it, one after the other.
        calls: Vec<ServiceCall>,
        /// The calls that end it early.
        end: Vec<ServiceCall>,
        /// The longest it may take.
        within: Duration,
        /// True if the robot must be awake and on its feet.
        moves: bool,
    },
    /// An installed behaviour; it takes the place of another one.
    Behavior(String),
    /// The manner in which it speaks from now on.
    Voice(Manner),
    /// A light of this group, which is the robot's own again at the end of the use.
    Light {
        /// In ALLeds.
        group: &'static str,
        /// The call that sets the light; the newest counts.
        call: ServiceCall,
    },
    /// The page or picture that the tablet shows, until the end of the use.
    Tablet(ServiceCall),
    /// Words to speak.
    Say(String),
    /// Walking: ahead, to the left and turning, in metres and radians a second.
    Walk(Speeds),
    /// Following.
    Track(FollowedTrack),
    /// A text for the page.
    Print(String),
}

impl Action {
    /// True if the robot must be awake and on its feet for it.
    pub(crate) fn moves(&self) -> bool {
        match self {
            Self::Joints { .. } | Self::Walk(_) | Self::Track(_) | Self::Behavior(_) => true,
            Self::Lasting { moves, .. } => *moves,
            Self::Eyes(_)
            | Self::Glow(_)
            | Self::Voice(_)
            | Self::Light { .. }
            | Self::Tablet(_)
            | Self::Say(_)
            | Self::Print(_) => false,
        }
    }

    /// True if it walks or turns the whole body.
    pub(crate) fn walks(&self) -> bool {
        match self {
            Self::Walk(_) => true,
            Self::Track(track) => track.mode.walks(),
            _ => false,
        }
    }
}
