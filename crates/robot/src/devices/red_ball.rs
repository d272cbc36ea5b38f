//! The red ball, as ALRedBallDetection sees it (NAOqi 2.8): angles from the image centre, left and down positive.

use super::{MILLISECONDS, RADIANS};
use crate::{Device, Field, NextStep, Pace, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

/// Fields of a ball.
pub(crate) const BALL: &[Field] = &[
    Field { name: "x", says: "angle to the side in radians, left positive", of: RADIANS },
    Field { name: "y", says: "angle up and down in radians, down positive", of: RADIANS },
    Field { name: "size", says: "angle of the ball's radius in radians", of: RADIANS },
    Field { name: "time", says: "when it was seen, in milliseconds of robot time", of: MILLISECONDS },
];

/// The balls that can be pretended.
pub(crate) const BALLS: &[Pretend] = &[
    Pretend { says: "ball near", value: r#"{"x":0.0,"y":0.0,"size":0.1,"time":0}"# },
    Pretend { says: "ball far", value: r#"{"x":0.0,"y":0.0,"size":0.02,"time":0}"# },
    Pretend { says: "ball at the left", value: r#"{"x":0.4,"y":0.2,"size":0.05,"time":0}"# },
    Pretend { says: "ball at the right", value: r#"{"x":-0.4,"y":-0.2,"size":0.05,"time":0}"# },
];

pub(crate) const DEVICE: Device = Device {
    name: "RedBall",
    kind: StreamKind::Sensor,
    label: "Red ball",
    says: "Sees the red ball: where it is and how large it looks.",
    icon: "ball",
    params: &[],
    shape: Shape::Object(BALL),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::WhileThere,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"x":0.1,"y":0.0,"size":0.08,"time":0}"#,
    pretend: BALLS,
};
