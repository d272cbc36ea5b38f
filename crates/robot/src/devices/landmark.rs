//! Printed marks with a number, as ALLandMarkDetection reads them (NAOqi 2.8): 2 to 23 degrees large, turned less than 45 degrees.

use crate::{Device, Field, NextStep, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Landmark",
    kind: StreamKind::Sensor,
    label: "Landmark",
    says: "Sees a printed mark: which one, and where it is.",
    icon: "landmark",
    params: &[Param {
        name: "number",
        label: "Number, 0 for any",
        kind: ParamKind::Number { min: 0.0, max: 999.0, step: 1.0, unit: "", default: 0.0 },
    }],
    shape: Shape::Object(&[
        Field { name: "number", says: "number of the mark" },
        Field { name: "x", says: "angle to the side in radians, left positive" },
        Field { name: "y", says: "angle up and down in radians, down positive" },
        Field { name: "size", says: "angle of the radius of the mark in radians" },
        Field { name: "heading", says: "how far the mark is turned in the picture, in radians" },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time" },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"number":64,"x":0.1,"y":0.0,"size":0.05,"heading":0.0,"time":0}"#,
};
