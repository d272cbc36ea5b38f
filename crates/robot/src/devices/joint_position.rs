//! The angle of one joint.

use super::JOINT_CHOICES;
use crate::{Device, NextStep, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "JointPosition",
    kind: StreamKind::Sensor,
    label: "JointPosition",
    says: "Reads the angle of a joint in radians; a hand reads 0 closed to 1 open.",
    icon: "joint",
    params: &[Param { name: "joint", label: "Joint", kind: ParamKind::Choice(JOINT_CHOICES) }],
    shape: Shape::Number("rad"),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: "0.1",
};
