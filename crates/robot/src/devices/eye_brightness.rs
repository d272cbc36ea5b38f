//! The brightness of the eyes.

use crate::{Device, NextStep, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "EyeBrightness",
    kind: StreamKind::Actuator,
    label: "EyeBrightness",
    says: "Makes the eyes as bright as the value: 0 dark to 1 bright.",
    icon: "brightness",
    params: &[],
    shape: Shape::Number("0 to 1"),
    resources: Resources::Always(&[Resource::Eyes]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Number, &[])], ..NextStep::NEVER },
    example: "0.5",
};
