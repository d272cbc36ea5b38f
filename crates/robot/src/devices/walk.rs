//! Walking, as ALMotion.move does it (NAOqi 2.8), which goes on until told otherwise: here it ends by itself.

use super::{METRES_PER_SECOND, RADIANS_PER_SECOND};
use crate::{Device, Field, NextStep, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Walk",
    kind: StreamKind::Actuator,
    label: "Walk",
    says: "Walks with the speed of the value for as long as values keep coming, and half a second more; a number walks ahead.",
    icon: "walk",
    params: &[
        Param {
            name: "speed",
            label: "Top speed",
            kind: ParamKind::Number { min: 0.01, max: 0.1, step: 0.01, unit: "m/s", default: 0.05 },
        },
        Param {
            name: "turn",
            label: "Top turn",
            kind: ParamKind::Number { min: 0.05, max: 0.5, step: 0.05, unit: "rad/s", default: 0.3 },
        },
    ],
    shape: Shape::ObjectOrFirst(&[
        Field { name: "x", says: "speed ahead in metres a second, backwards negative", of: METRES_PER_SECOND },
        Field { name: "y", says: "speed to the left in metres a second, to the right negative", of: METRES_PER_SECOND },
        Field { name: "turn", says: "speed of turning in radians a second, left positive", of: RADIANS_PER_SECOND },
    ]),
    resources: Resources::Always(&[Resource::Legs]),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"x":0.05,"y":0.0,"turn":0.0}"#,
    pretend: &[],
};
