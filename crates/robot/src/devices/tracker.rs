//! Following a ball or a face, as ALTracker does it.

use crate::{Device, Param, ParamKind, Resource, Shape};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Tracker",
    kind: StreamKind::Actuator,
    label: "Tracker",
    says: "Follows the target for as long as values keep coming, and one second more.",
    icon: "target",
    params: &[
        Param {
            name: "target",
            label: "Target",
            kind: ParamKind::Choice(&[("RedBall", "red ball"), ("Face", "face")]),
        },
        Param {
            name: "mode",
            label: "Tracking mode",
            kind: ParamKind::Choice(&[
                ("Head", "head"),
                ("WholeBody", "whole body"),
                ("Move", "move"),
                ("Arm", "arm only"),
            ]),
        },
        Param {
            name: "effector",
            label: "Effector",
            kind: ParamKind::Choice(&[
                ("None", "none"),
                ("LArm", "left arm"),
                ("RArm", "right arm"),
                ("Nearest", "nearest arm"),
                ("Value", "as the value says"),
            ]),
        },
    ],
    shape: Shape::Anything,
    resources: &[Resource::Head],
    example: "true",
};
