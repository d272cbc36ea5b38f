//! Sounds, as ALAudioPlayer plays them (NAOqi 2.8).

use crate::{Device, NextStep, Offers, Pace, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Sound",
    kind: StreamKind::Actuator,
    label: "Sound",
    says: "Plays the sound whenever a value comes; one that plays already is not begun again.",
    icon: "sound",
    params: &[
        Param {
            name: "sound",
            label: "Sound",
            kind: ParamKind::Choice(&[
                ("beep", "beep"),
                ("low", "low beep"),
                ("high", "high beep"),
                ("file", "one of the robot’s, or a file on it"),
            ]),
        },
        Param {
            name: "file",
            label: "The robot’s sound or file",
            kind: ParamKind::Text { max_chars: 200, default: "", offers: Some(Offers::Sounds) },
        },
        Param {
            name: "volume",
            label: "Volume",
            kind: ParamKind::Number { min: 0.0, max: 100.0, step: 5.0, unit: "%", default: 50.0 },
        },
    ],
    shape: Shape::Anything,
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep::NEVER,
    example: "true",
    pretend: &[],
};
