//! Showing the value to people.

use crate::{Device, Resources, Shape};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Print",
    kind: StreamKind::Actuator,
    label: "Print",
    says: "Shows each value beside the room, without moving the robot.",
    icon: "print",
    params: &[],
    shape: Shape::Anything,
    resources: Resources::Always(&[]),
    example: r#""hello""#,
};
