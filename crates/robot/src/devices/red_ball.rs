//! The red ball, as ALRedBallDetection sees it (NAOqi 2.8): angles from the image centre, left and down positive.

use crate::{Device, Field, NextStep, Resources, Shape, Waiting};
use behaviour::StreamKind;

/// Fields of a ball.
pub(crate) const BALL: &[Field] = &[
    Field { name: "x", says: "angle to the side in radians, left positive" },
    Field { name: "y", says: "angle up and down in radians, down positive" },
    Field { name: "size", says: "angle of the ball's radius in radians" },
    Field { name: "time", says: "when it was seen, in milliseconds of robot time" },
];

pub(crate) const DEVICE: Device = Device {
    name: "RedBall",
    kind: StreamKind::Sensor,
    label: "RedBall",
    says: "Sees the red ball: where it is and how large it looks.",
    icon: "ball",
    params: &[],
    shape: Shape::Object(BALL),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"x":0.1,"y":0.0,"size":0.08,"time":0}"#,
};
