//! The three touch fields on the head.

use super::LETTING_GO;
use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "HeadTouch",
    kind: StreamKind::Sensor,
    label: "Head touch",
    says: "Feels a hand on the head: gives true when touched and, if wanted, false when let go.",
    icon: "touch",
    params: &[
        Param {
            name: "part",
            label: "Part of the head",
            kind: ParamKind::Choice(&[("any", "anywhere"), ("front", "front"), ("middle", "middle"), ("rear", "rear")]),
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
    pretend: &[Pretend { says: "touched", value: "true" }, Pretend { says: "let go", value: "false" }],
};
