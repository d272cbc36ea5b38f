//! Speaking the value.

use crate::{Device, NextStep, Pace, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "SayInput",
    kind: StreamKind::Actuator,
    label: "Say the value",
    says: "Speaks each value that comes.",
    icon: "speech",
    params: &[],
    shape: Shape::Text,
    resources: Resources::Always(&[Resource::Voice]),
    waiting: Waiting::Every,
    pace: Pace::Lasting,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Text, &[])], ..NextStep::NEVER },
    example: r#""hello""#,
    pretend: &[],
};
