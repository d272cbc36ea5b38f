//! The colour of the eyes.

use super::COLORS;
use crate::{Device, NextStep, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "EyeLedColor",
    kind: StreamKind::Actuator,
    label: "Eye color",
    says: "Gives the eyes a color whenever a value comes.",
    icon: "light",
    params: &[Param { name: "color", label: "Color", kind: ParamKind::Choice(COLORS) }],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Eyes]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep { for_streams: &[(Carries::Touch, &[]), (Carries::Truth, &[])], ..NextStep::NEVER },
    example: r#""red""#,
    pretend: &[],
};
