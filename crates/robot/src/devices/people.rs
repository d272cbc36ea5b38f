//! Who is near, as ALPeoplePerception sees them (NAOqi 2.8): up to 3.5 m, not nearer than half a metre.

use crate::{Device, Field, NextStep, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "People",
    kind: StreamKind::Sensor,
    label: "People",
    says: "Counts the people in view and tells where the nearest one is.",
    icon: "people",
    params: &[],
    shape: Shape::Object(&[
        Field { name: "count", says: "how many people are in view" },
        Field { name: "id", says: "number of the nearest person, 0 when nobody is in view" },
        Field { name: "distance", says: "how far the nearest person is in metres, nothing when nobody is in view" },
        Field {
            name: "x",
            says: "angle to the nearest face in radians, left positive, nothing when nobody is in view",
        },
        Field { name: "y", says: "angle up and down to it in radians, down positive, nothing when nobody is in view" },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time" },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"count":1,"id":1,"distance":1.2,"x":0.1,"y":-0.2,"time":0}"#,
};
