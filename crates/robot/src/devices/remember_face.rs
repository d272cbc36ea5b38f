//! Learning a face.

use crate::{Device, Resource, Resources, Shape};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "RememberFace",
    kind: StreamKind::Actuator,
    label: "RememberFace",
    says: "Remembers the face it sees whenever a value comes.",
    icon: "remember",
    params: &[],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Memory]),
    example: "true",
};
