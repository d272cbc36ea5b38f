//! Speaking the value.

use crate::{Device, Resource, Resources, Shape};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "SayInput",
    kind: StreamKind::Actuator,
    label: "SayInput",
    says: "Speaks each value that comes.",
    icon: "speech",
    params: &[],
    shape: Shape::Text,
    resources: Resources::Always(&[Resource::Voice]),
    example: r#""hello""#,
};
