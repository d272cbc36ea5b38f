//! Which posture the robot is in, in the families of ALRobotPosture (NAOqi 2.8).

use crate::{Device, NextStep, Pace, Pretend, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "PostureChanged",
    kind: StreamKind::Sensor,
    label: "Posture",
    says: "Tells the posture of the robot, like “Standing”, “Sitting” or “LyingBelly”: at first, and whenever it changes.",
    icon: "posture",
    params: &[],
    shape: Shape::Text,
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: r#""Standing""#,
    pretend: &[
        Pretend { says: "it stands", value: r#""Standing""# },
        Pretend { says: "it sits", value: r#""Sitting""# },
    ],
};
