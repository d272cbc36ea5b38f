//! Postures of the whole body, as ALRobotPosture takes them (NAOqi 2.8).

use crate::{Device, NextStep, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Posture",
    kind: StreamKind::Actuator,
    label: "Take a posture",
    says: "Takes the posture whenever a value comes.",
    icon: "posture",
    params: &[
        Param {
            name: "posture",
            label: "Posture",
            kind: ParamKind::Choice(&[
                ("Stand", "standing"),
                ("StandInit", "standing, ready to walk"),
                ("Crouch", "crouching"),
                ("Sit", "sitting"),
            ]),
        },
        Param {
            name: "speed",
            label: "Speed",
            kind: ParamKind::Number { min: 0.1, max: 1.0, step: 0.1, unit: "of the top speed", default: 0.5 },
        },
    ],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Head, Resource::LeftArm, Resource::RightArm, Resource::Legs]),
    waiting: Waiting::Newest,
    pace: Pace::Lasting,
    button: None,
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[],
};
