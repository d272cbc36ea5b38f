//! Anything of a color, round or not, as ALColorBlobDetection finds it (NAOqi 2.8).

use super::red_ball::{BALL, BALLS};
use crate::{Device, NextStep, Pace, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Blob",
    kind: StreamKind::Sensor,
    label: "Colored thing",
    says: "Sees the largest thing of the chosen color, whatever its form: where it is and how large it looks.",
    icon: "blob",
    params: &[
        Param {
            name: "color",
            label: "Color",
            kind: ParamKind::Choice(&[("red", "red"), ("green", "green"), ("blue", "blue")]),
        },
        Param {
            name: "size",
            label: "Smallest size",
            kind: ParamKind::Number { min: 0.0, max: 0.5, step: 0.01, unit: "rad", default: 0.0 },
        },
    ],
    shape: Shape::Object(BALL),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::WhileThere,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"x":0.1,"y":0.0,"size":0.08,"time":0}"#,
    pretend: BALLS,
};
