//! Printed marks with a number, as ALLandMarkDetection reads them (NAOqi 2.8): 2 to 23 degrees large, turned less than 45 degrees.

use super::{MILLISECONDS, NUMBER, RADIANS};
use crate::{Device, Field, NextStep, Pace, Param, ParamKind, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Landmark",
    kind: StreamKind::Sensor,
    label: "Printed mark",
    says: "Sees a printed mark: which one, and where it is.",
    icon: "landmark",
    params: &[Param {
        name: "number",
        label: "Number, 0 for any",
        kind: ParamKind::Number { min: 0.0, max: 999.0, step: 1.0, unit: "", default: 0.0 },
    }],
    shape: Shape::Object(&[
        Field { name: "number", says: "number of the mark", of: NUMBER },
        Field { name: "x", says: "angle to the side in radians, left positive", of: RADIANS },
        Field { name: "y", says: "angle up and down in radians, down positive", of: RADIANS },
        Field { name: "size", says: "angle of the radius of the mark in radians", of: RADIANS },
        Field { name: "heading", says: "how far the mark is turned in the picture, in radians", of: RADIANS },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time", of: MILLISECONDS },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::WhileThere,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"number":64,"x":0.1,"y":0.0,"size":0.05,"heading":0.0,"time":0}"#,
    pretend: &[
        Pretend { says: "mark ahead", value: r#"{"number":64,"x":0.0,"y":0.0,"size":0.05,"heading":0.0,"time":0}"# },
        Pretend {
            says: "mark at the left",
            value: r#"{"number":64,"x":0.4,"y":0.2,"size":0.05,"heading":0.5,"time":0}"#,
        },
        Pretend {
            says: "mark at the right",
            value: r#"{"number":64,"x":-0.4,"y":-0.2,"size":0.05,"heading":-0.5,"time":0}"#,
        },
    ],
};
