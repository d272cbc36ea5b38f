//! Speaking the value.

use crate::{Device, NextStep, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "SayInput",
    kind: StreamKind::Actuator,
    label: "SayInput",
    says: "Speaks each value that comes.",
    icon: "speech",
    params: &[],
    shape: Shape::Text,
    resources: Resources::Always(&[Resource::Voice]),
    waiting: Waiting::Every,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Text, &[])], ..NextStep::NEVER },
    example: r#""hello""#,
};
