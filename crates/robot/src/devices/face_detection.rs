//! Faces, as ALFaceDetection sees them.

use crate::{Device, Field, NextStep, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "FaceDetection",
    kind: StreamKind::Sensor,
    label: "FaceDetection",
    says: "Sees a face, and whether the robot has met it before.",
    icon: "face",
    params: &[],
    shape: Shape::Object(&[
        Field { name: "id", says: "number of the face" },
        Field { name: "label", says: "name it was remembered under, or an empty text" },
        Field { name: "new", says: "true if the face was not remembered before" },
        Field { name: "recognized_new_face", says: "true if it is new and seen well enough to remember" },
        Field { name: "x", says: "angle to the side in radians, left positive" },
        Field { name: "y", says: "angle up and down in radians, down positive" },
        Field { name: "size", says: "angle of half its height in radians" },
        Field { name: "time", says: "when it was seen, in milliseconds of robot time" },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"id":1,"label":"","new":true,"recognized_new_face":true,"x":0.0,"y":-0.1,"size":0.1,"time":0}"#,
};
