//! A clock that ticks.

use super::NUMBER;
use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Tick",
    kind: StreamKind::Sensor,
    label: "Clock",
    says: "Gives 1, 2, 3 ... at a steady beat.",
    icon: "clock",
    params: &[Param {
        name: "period_ms",
        label: "Every",
        kind: ParamKind::Number { min: 10.0, max: 3_600_000.0, step: 10.0, unit: "ms", default: 1_000.0 },
    }],
    shape: NUMBER,
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Beat("period_ms"),
    button: None,
    next_step: NextStep::NEVER,
    example: "1",
    pretend: &[Pretend { says: "a beat", value: "1" }],
};
