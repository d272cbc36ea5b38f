//! The people who are near, as ALPeoplePerception sees them (NAOqi 2.8): up to 3.5 m, not nearer than half a metre.

use super::{METRES, MILLISECONDS, NUMBER, RADIANS};
use crate::{Device, Field, NextStep, Pace, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "People",
    kind: StreamKind::Sensor,
    label: "People",
    says: "Counts the people in view and tells where the nearest one is.",
    icon: "people",
    params: &[],
    shape: Shape::Object(&[
        Field { name: "count", says: "how many people are in view", of: NUMBER },
        Field { name: "id", says: "number of the nearest person, 0 when nobody is in view", of: NUMBER },
        Field {
            name: "distance",
            says: "how far the nearest person is in metres, nothing when nobody is in view",
            of: METRES,
        },
        Field {
            name: "x",
            says: "angle to the nearest face in radians, left positive, nothing when nobody is in view",
            of: RADIANS,
        },
        Field {
            name: "y",
            says: "angle up and down to it in radians, down positive, nothing when nobody is in view",
            of: RADIANS,
        },
        Field { name: "time", says: "when it was sensed, in milliseconds of robot time", of: MILLISECONDS },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"count":1,"id":1,"distance":1.2,"x":0.1,"y":-0.2,"time":0}"#,
    pretend: &[
        Pretend { says: "somebody near", value: r#"{"count":1,"id":1,"distance":0.8,"x":0.2,"y":-0.2,"time":0}"# },
        Pretend { says: "somebody far", value: r#"{"count":1,"id":1,"distance":3.0,"x":-0.2,"y":0.2,"time":0}"# },
        Pretend { says: "nobody", value: r#"{"count":0,"id":0,"distance":null,"x":null,"y":null,"time":0}"# },
    ],
};
