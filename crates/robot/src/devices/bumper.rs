//! The bumpers on the feet; Pepper has a third one at its back.

use super::LETTING_GO;
use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Bumper",
    kind: StreamKind::Sensor,
    label: "Bumper",
    says: "Feels something at a foot: gives true when pressed and, if wanted, false when let go.",
    icon: "bumper",
    params: &[
        Param {
            name: "foot",
            label: "Foot",
            kind: ParamKind::Choice(&[
                ("any", "either"),
                ("left", "left"),
                ("right", "right"),
                ("back", "at the back"),
            ]),
        },
        LETTING_GO,
    ],
    shape: Shape::Truth,
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[Pretend { says: "bumped", value: "true" }, Pretend { says: "let go", value: "false" }],
};
