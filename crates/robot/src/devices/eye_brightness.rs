//! The brightness of the eyes.

use super::FRACTION;
use crate::{Device, NextStep, Pace, Resource, Resources, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "EyeBrightness",
    kind: StreamKind::Actuator,
    label: "Eye brightness",
    says: "Makes the eyes as bright as the value: 0 dark to 1 bright.",
    icon: "brightness",
    params: &[],
    shape: FRACTION,
    resources: Resources::Always(&[Resource::Eyes]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Number, &[])], ..NextStep::NEVER },
    example: "0.5",
    pretend: &[],
};
