//! Showing the value to people.

use crate::{Device, NextStep, Pace, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "Print",
    kind: StreamKind::Actuator,
    label: "Show the value",
    says: "Shows each value beside the room, without moving the robot.",
    icon: "print",
    params: &[],
    shape: Shape::Anything,
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Text, &[])], ..NextStep::NEVER },
    example: r#""hello""#,
    pretend: &[],
};
