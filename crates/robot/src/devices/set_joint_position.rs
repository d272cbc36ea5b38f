//! Moving one joint, or those of a group.

use super::{FRACTION, MOVED_CHOICES, NUMBER, RADIANS};
use crate::{Device, NextStep, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::{Params, StreamKind, Value};

pub(crate) const DEVICE: Device = Device {
    name: "SetJointPosition",
    kind: StreamKind::Actuator,
    label: "Move a joint",
    says: "Moves a joint to the value in radians, a hand to 0 closed or 1 open; a group takes a list of its joints' values.",
    icon: "joint",
    params: &[
        Param { name: "joint", label: "Joint", kind: ParamKind::Choice(MOVED_CHOICES) },
        Param {
            name: "speed",
            label: "Speed",
            kind: ParamKind::Number { min: 0.01, max: 1.0, step: 0.05, unit: "of the top speed", default: 0.3 },
        },
    ],
    shape: Shape::By {
        param: "joint",
        cases: &[
            ("LHand", FRACTION),
            ("RHand", FRACTION),
            ("Head", Shape::List(&RADIANS)),
            ("LArm", Shape::List(&NUMBER)),
            ("RArm", Shape::List(&NUMBER)),
        ],
        usual: &RADIANS,
    },
    resources: Resources::By(parts),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep::NEVER,
    example: "0.5",
    pretend: &[],
};

fn parts(params: &Params) -> Vec<Resource> {
    match params.get("joint").and_then(Value::as_text) {
        Some(joint) if joint.starts_with("Head") => vec![Resource::Head],
        Some(joint) if joint.starts_with('L') => vec![Resource::LeftArm],
        Some(joint) if joint.starts_with('R') => vec![Resource::RightArm],
        _ => vec![Resource::Head, Resource::LeftArm, Resource::RightArm],
    }
}
