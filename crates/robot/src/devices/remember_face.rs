//! Learning a face.

use crate::{Device, NextStep, Pace, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "RememberFace",
    kind: StreamKind::Actuator,
    label: "Remember a face",
    says: "Remembers the face it sees whenever a value comes.",
    icon: "remember",
    params: &[],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Memory]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Face, &[])], ..NextStep::NEVER },
    example: "true",
    pretend: &[],
};
