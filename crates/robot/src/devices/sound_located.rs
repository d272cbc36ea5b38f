//! Where a loud sound comes from, as ALSoundLocalization hears it (NAOqi 2.8).

use super::{FRACTION, MILLISECONDS, RADIANS};
use crate::{Device, Field, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "SoundLocated",
    kind: StreamKind::Sensor,
    label: "Loud sound",
    says: "Hears where a loud sound comes from.",
    icon: "ear",
    params: &[Param {
        name: "sensitivity",
        label: "Sensitivity",
        kind: ParamKind::Number { min: 0.0, max: 1.0, step: 0.1, unit: "", default: 0.9 },
    }],
    shape: Shape::Object(&[
        Field { name: "azimuth", says: "angle to the side in radians, left of the head positive", of: RADIANS },
        Field { name: "elevation", says: "angle up in radians, above the head positive", of: RADIANS },
        Field { name: "confidence", says: "how sure the robot is, from 0 to 1", of: FRACTION },
        Field { name: "energy", says: "how loud it is, from 0 to 1", of: FRACTION },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time", of: MILLISECONDS },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"azimuth":0.5,"elevation":0.0,"confidence":0.8,"energy":0.6,"time":0}"#,
    pretend: &[
        Pretend {
            says: "a sound at the left",
            value: r#"{"azimuth":0.8,"elevation":0.2,"confidence":0.8,"energy":0.6,"time":0}"#,
        },
        Pretend {
            says: "a sound at the right",
            value: r#"{"azimuth":-0.8,"elevation":-0.2,"confidence":0.8,"energy":0.6,"time":0}"#,
        },
    ],
};
