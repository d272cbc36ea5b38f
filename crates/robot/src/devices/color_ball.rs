//! A round ball of a color, as ALColorBlobDetection finds it (NAOqi 2.8) when told to look for circles.

use super::red_ball::{BALL, BALLS};
use crate::{Device, NextStep, Pace, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "ColorBall",
    kind: StreamKind::Sensor,
    label: "Colored ball",
    says: "Sees a ball of the chosen color: where it is and how large it looks.",
    icon: "ball",
    params: &[Param {
        name: "color",
        label: "Color",
        kind: ParamKind::Choice(&[("red", "red"), ("green", "green"), ("blue", "blue")]),
    }],
    shape: Shape::Object(BALL),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::WhileThere,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"x":0.1,"y":0.0,"size":0.08,"time":0}"#,
    pretend: BALLS,
};
