//! Speaking a fixed text.

use crate::{Device, Param, ParamKind, Resource, Resources, Shape};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "SayParameter",
    kind: StreamKind::Actuator,
    label: "SayParameter",
    says: "Speaks its text whenever a value comes.",
    icon: "speech",
    params: &[Param { name: "text", label: "Text", kind: ParamKind::Text { max_chars: 1_000, default: "Hello" } }],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Voice]),
    example: "true",
};
