//! Words that somebody says, as ALSpeechRecognition hears them (NAOqi 2.8).

use super::{FRACTION, MILLISECONDS};
use crate::{Device, Field, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "WordRecognized",
    kind: StreamKind::Sensor,
    label: "Word",
    says: "Hears one of the chosen words: which one, and how sure the robot is.",
    icon: "word",
    params: &[
        Param {
            name: "words",
            label: "Words, with commas between",
            kind: ParamKind::Text { max_chars: 500, default: "yes, no", offers: None },
        },
        Param {
            name: "language",
            label: "Language",
            kind: ParamKind::Choice(&[
                ("English", "English"),
                ("Japanese", "Japanese"),
                ("French", "French"),
                ("German", "German"),
                ("Dutch", "Dutch"),
                ("Spanish", "Spanish"),
                ("Italian", "Italian"),
                ("Chinese", "Chinese"),
            ]),
        },
        Param {
            name: "confidence",
            label: "At least as sure as",
            kind: ParamKind::Number { min: 0.0, max: 1.0, step: 0.05, unit: "", default: 0.4 },
        },
    ],
    shape: Shape::Object(&[
        Field { name: "word", says: "the word as it was chosen", of: Shape::Text },
        Field { name: "confidence", says: "how sure the robot is, from 0 to 1", of: FRACTION },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time", of: MILLISECONDS },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"word":"yes","confidence":0.6,"time":0}"#,
    pretend: &[
        Pretend { says: "somebody said “yes”", value: r#"{"word":"yes","confidence":0.6,"time":0}"# },
        Pretend { says: "somebody said “no”", value: r#"{"word":"no","confidence":0.6,"time":0}"# },
    ],
};
