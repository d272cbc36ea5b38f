//! The touch fields on the backs and sides of the hands.

use super::LETTING_GO;
use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "HandTouch",
    kind: StreamKind::Sensor,
    label: "Hand touch",
    says: "Feels a touch on a hand: gives true when touched and, if wanted, false when let go.",
    icon: "hand",
    params: &[
        Param {
            name: "hand",
            label: "Hand",
            kind: ParamKind::Choice(&[("any", "either"), ("left", "left"), ("right", "right")]),
        },
        Param {
            name: "part",
            label: "Part of the hand",
            kind: ParamKind::Choice(&[
                ("any", "anywhere"),
                ("back", "back of the hand"),
                ("left", "left side"),
                ("right", "right side"),
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
    pretend: &[Pretend { says: "touched", value: "true" }, Pretend { says: "let go", value: "false" }],
};
