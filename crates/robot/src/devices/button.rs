//! A button on the page that an operator presses.

use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Button",
    kind: StreamKind::Sensor,
    label: "Button",
    says: "Gives true when somebody presses a button on the page, beside Start and Stop.",
    icon: "button",
    params: &[Param {
        name: "label",
        label: "On the button",
        kind: ParamKind::Text { max_chars: 40, default: "Go on", offers: None },
    }],
    shape: Shape::Truth,
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Happening,
    button: Some("label"),
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[Pretend { says: "button pressed", value: "true" }],
};
