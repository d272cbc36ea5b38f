//! How full the battery is.

use crate::{Device, NextStep, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Battery",
    kind: StreamKind::Sensor,
    label: "Battery",
    says: "Tells how full the battery is: at first, and whenever that changes.",
    icon: "battery",
    params: &[],
    shape: Shape::Number("%"),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: "80",
};
