//! Falling, as the fall manager of ALMotion notices it (NAOqi 2.8).

use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Fall",
    kind: StreamKind::Sensor,
    label: "Fall",
    says: "Notices that the robot falls: gives true then and, if wanted, false when it stands again.",
    icon: "fall",
    params: &[Param {
        name: "release",
        label: "Also told",
        kind: ParamKind::Choice(&[("no", "none"), ("yes", "standing again")]),
    }],
    shape: Shape::Truth,
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[Pretend { says: "it falls", value: "true" }, Pretend { says: "it stands again", value: "false" }],
};
