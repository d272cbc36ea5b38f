//! The voice of the robot, as ALTextToSpeech and ALAnimatedSpeech have it (NAOqi 2.8).

use crate::{Device, NextStep, Offers, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Voice",
    kind: StreamKind::Actuator,
    label: "Voice",
    says: "Changes how the robot speaks from when a value comes; at the end its voice is as before.",
    icon: "voice",
    params: &[
        Param {
            name: "volume",
            label: "Volume",
            kind: ParamKind::Number { min: 0.0, max: 100.0, step: 5.0, unit: "%", default: 100.0 },
        },
        Param {
            name: "speed",
            label: "Speed",
            kind: ParamKind::Number { min: 50.0, max: 200.0, step: 5.0, unit: "%", default: 100.0 },
        },
        Param {
            name: "gestures",
            label: "While speaking",
            kind: ParamKind::Choice(&[("no", "without gestures"), ("yes", "with gestures")]),
        },
        Param {
            name: "language",
            label: "Language",
            kind: ParamKind::Text { max_chars: 40, default: "", offers: Some(Offers::Languages) },
        },
    ],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Voice]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[],
};
