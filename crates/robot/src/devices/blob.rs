//! A coloured ball, as ALColorBlobDetection sees it.

use super::red_ball::BALL;
use crate::{Device, NextStep, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Blob",
    kind: StreamKind::Sensor,
    label: "Blob",
    says: "Sees a ball of the chosen color: where it is and how large it looks.",
    icon: "blob",
    params: &[Param {
        name: "color",
        label: "Colour",
        kind: ParamKind::Choice(&[("red", "red"), ("green", "green"), ("blue", "blue")]),
    }],
    shape: Shape::Object(BALL),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    next_step: NextStep::NEVER,
    example: r#"{"x":0.1,"y":0.0,"size":0.08,"time":0}"#,
};
