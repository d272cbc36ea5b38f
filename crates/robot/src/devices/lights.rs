//! The lights that are no eyes, as ALLeds has them (NAOqi 2.8).

use super::COLORS;
use crate::{Device, NextStep, Pace, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Lights",
    kind: StreamKind::Actuator,
    label: "Other lights",
    says: "Lights the ears, the chest or the head whenever a value comes: ears shine blue only, the head white only. \
           At the end they are the robot’s own again.",
    icon: "lights",
    params: &[
        Param {
            name: "part",
            label: "Where",
            kind: ParamKind::Choice(&[
                ("ears", "ears"),
                ("chest", "chest"),
                ("head", "top of the head"),
                ("shoulders", "shoulders of a Pepper"),
            ]),
        },
        Param { name: "color", label: "Color", kind: ParamKind::Choice(COLORS) },
    ],
    shape: Shape::Anything,
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep::NEVER,
    example: r#""blue""#,
    pretend: &[],
};
