//! The brightness of the eyes.

use crate::{Device, Resource, Resources, Shape};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "EyeBrightness",
    kind: StreamKind::Actuator,
    label: "EyeBrightness",
    says: "Makes the eyes as bright as the value: 0 dark to 1 bright.",
    icon: "brightness",
    params: &[],
    shape: Shape::Number("0 to 1"),
    resources: Resources::Always(&[Resource::Eyes]),
    example: "0.5",
};
