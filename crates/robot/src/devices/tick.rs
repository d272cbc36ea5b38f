//! A clock that ticks.

use crate::{Device, NextStep, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Tick",
    kind: StreamKind::Sensor,
    label: "Tick",
    says: "Gives 1, 2, 3 ... at a steady beat.",
    icon: "clock",
    params: &[Param {
        name: "period_ms",
        label: "Every",
        kind: ParamKind::Number { min: 10.0, max: 3_600_000.0, step: 10.0, unit: "ms", default: 1_000.0 },
    }],
    shape: Shape::Number(""),
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    button: None,
    next_step: NextStep::NEVER,
    example: "1",
};
