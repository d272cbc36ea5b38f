//! Faces, as ALFaceDetection sees them.

use super::{MILLISECONDS, NUMBER, RADIANS};
use crate::{Device, Field, NextStep, Pace, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "FaceDetection",
    kind: StreamKind::Sensor,
    label: "Face",
    says: "Sees a face, and whether the robot has met it before.",
    icon: "face",
    params: &[],
    shape: Shape::Object(&[
        Field { name: "id", says: "number of the face", of: NUMBER },
        Field { name: "label", says: "name it was remembered under, or an empty text", of: Shape::Text },
        Field { name: "new", says: "true if the face was not remembered before", of: Shape::Truth },
        Field {
            name: "recognized_new_face",
            says: "true if it is new and seen well enough to remember",
            of: Shape::Truth,
        },
        Field { name: "x", says: "angle to the side in radians, left positive", of: RADIANS },
        Field { name: "y", says: "angle up and down in radians, down positive", of: RADIANS },
        Field { name: "size", says: "angle of half its height in radians", of: RADIANS },
        Field { name: "time", says: "when it was seen, in milliseconds of robot time", of: MILLISECONDS },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::WhileThere,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"id":1,"label":"","new":true,"recognized_new_face":true,"x":0.0,"y":-0.1,"size":0.1,"time":0}"#,
    pretend: &[
        Pretend {
            says: "a new face",
            value: r#"{"id":2,"label":"","new":true,"recognized_new_face":true,"x":0.2,"y":-0.2,"size":0.1,"time":0}"#,
        },
        Pretend {
            says: "a face it knows",
            value: r#"{"id":1,"label":"Aiko","new":false,"recognized_new_face":false,"x":-0.2,"y":0.2,"size":0.1,"time":0}"#,
        },
    ],
};
