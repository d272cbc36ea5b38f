//! Which posture the robot is in, in the families of ALRobotPosture (NAOqi 2.8).

use crate::{Device, NextStep, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "PostureChanged",
    kind: StreamKind::Sensor,
    label: "PostureChanged",
    says: "Tells the posture of the robot, like “Standing”, “Sitting” or “LyingBelly”: at first, and whenever it changes.",
    icon: "posture",
    params: &[],
    shape: Shape::Text,
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: r#""Standing""#,
};
