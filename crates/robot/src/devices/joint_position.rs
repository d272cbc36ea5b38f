//! The angle of one joint.

use super::{FRACTION, JOINT_CHOICES, RADIANS};
use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "JointPosition",
    kind: StreamKind::Sensor,
    label: "Joint",
    says: "Reads the angle of a joint in radians; a hand reads 0 closed to 1 open.",
    icon: "joint",
    params: &[Param { name: "joint", label: "Joint", kind: ParamKind::Choice(JOINT_CHOICES) }],
    shape: Shape::By { param: "joint", cases: &[("LHand", FRACTION), ("RHand", FRACTION)], usual: &RADIANS },
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Steady,
    button: None,
    next_step: NextStep::NEVER,
    example: "0.1",
    pretend: &[
        Pretend { says: "straight", value: "0.0" },
        Pretend { says: "turned to one side", value: "1.0" },
        Pretend { says: "turned to the other side", value: "-1.0" },
    ],
};
