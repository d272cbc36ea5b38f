//! The tablet of a Pepper, as ALTabletService has it (NAOqi 2.5 and later).

use crate::{Device, NextStep, Pace, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Tablet",
    kind: StreamKind::Actuator,
    label: "Tablet of a Pepper",
    says: "Shows a text or a picture on the tablet whenever a value comes; at the end it is hidden.",
    icon: "tablet",
    params: &[
        Param {
            name: "shows",
            label: "Shows",
            kind: ParamKind::Choice(&[
                ("text", "a text"),
                ("value", "the value"),
                ("picture", "a picture on the robot"),
            ]),
        },
        Param { name: "text", label: "Text", kind: ParamKind::Text { max_chars: 200, default: "Hello", offers: None } },
        Param {
            name: "picture",
            label: "Picture on the robot",
            kind: ParamKind::Text { max_chars: 200, default: "", offers: None },
        },
    ],
    shape: Shape::Anything,
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep::NEVER,
    example: r#""Well done""#,
    pretend: &[],
};
