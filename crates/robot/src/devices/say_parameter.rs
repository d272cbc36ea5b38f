//! Speaking a fixed text.

use crate::{Device, NextStep, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;
use behaviour::connectors::Carries;

pub(crate) const DEVICE: Device = Device {
    name: "SayParameter",
    kind: StreamKind::Actuator,
    label: "Say a text",
    says: "Speaks its text whenever a value comes.",
    icon: "speech",
    params: &[Param {
        name: "text",
        label: "Text",
        kind: ParamKind::Text { max_chars: 1_000, default: "Hello", offers: None },
    }],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Voice]),
    waiting: Waiting::Every,
    pace: Pace::Lasting,
    button: None,
    next_step: NextStep {
        for_streams: &[
            (Carries::Ball, &[]),
            (Carries::Number, &[]),
            (Carries::Touch, &[]),
            (Carries::Truth, &[]),
            (Carries::Anything, &[]),
        ],
        label: Some("Say…"),
        stream: Some("Say"),
        asks: true,
    },
    example: "true",
    pretend: &[],
};
