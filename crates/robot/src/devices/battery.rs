//! The charge of the battery.

use super::PERCENT;
use crate::{Device, NextStep, Pace, Pretend, Resources, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Battery",
    kind: StreamKind::Sensor,
    label: "Battery",
    says: "Tells how full the battery is: at first, and whenever that changes.",
    icon: "battery",
    params: &[],
    shape: PERCENT,
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: "80",
    pretend: &[Pretend { says: "battery full", value: "100" }, Pretend { says: "battery low", value: "10" }],
};
