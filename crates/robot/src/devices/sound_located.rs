//! Where a loud sound comes from, as ALSoundLocalization hears it (NAOqi 2.8).

use crate::{Device, Field, NextStep, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "SoundLocated",
    kind: StreamKind::Sensor,
    label: "SoundLocated",
    says: "Hears where a loud sound comes from.",
    icon: "ear",
    params: &[Param {
        name: "sensitivity",
        label: "Sensitivity",
        kind: ParamKind::Number { min: 0.0, max: 1.0, step: 0.1, unit: "", default: 0.9 },
    }],
    shape: Shape::Object(&[
        Field { name: "azimuth", says: "angle to the side in radians, left of the head positive" },
        Field { name: "elevation", says: "angle up in radians, above the head positive" },
        Field { name: "confidence", says: "how sure the robot is, from 0 to 1" },
        Field { name: "energy", says: "how loud it is, from 0 to 1" },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time" },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"azimuth":0.5,"elevation":0.0,"confidence":0.8,"energy":0.6,"time":0}"#,
};
