//! Gestures that the robot brings along, as ALAnimationPlayer plays them (NAOqi 2.8).

use crate::{Device, NextStep, Offers, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Animation",
    kind: StreamKind::Actuator,
    label: "Gesture",
    says: "Plays the gesture whenever a value comes; one that plays already is not begun again.",
    icon: "animation",
    params: &[
        Param {
            name: "animation",
            label: "Gesture",
            kind: ParamKind::Choice(&[
                ("Hey", "waving"),
                ("Yes", "nodding"),
                ("No", "shaking the head"),
                ("Bow", "bowing"),
                ("Me", "pointing to itself"),
                ("Explain", "explaining"),
                ("Happy", "cheering"),
                ("Dance", "dancing"),
                ("Clap", "clapping"),
                ("Surprised", "acting surprised"),
                ("HighFive", "giving a high five"),
                ("HeyLeft", "waving the left hand"),
                ("robot", "another of the robot’s"),
            ]),
        },
        Param {
            name: "gesture",
            label: "The robot’s gesture",
            kind: ParamKind::Text { max_chars: 200, default: "", offers: Some(Offers::Gestures) },
        },
    ],
    shape: Shape::Anything,
    resources: Resources::Always(&[Resource::Head, Resource::LeftArm, Resource::RightArm]),
    waiting: Waiting::Every,
    pace: Pace::Lasting,
    button: None,
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[],
};
