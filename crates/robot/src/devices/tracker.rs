//! Following a ball or a face, as ALTracker does it.

mod tracking;

pub use tracking::{TrackMode, TrackTarget};

use crate::{Device, NextStep, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::connectors::Carries;
use behaviour::{Params, StreamKind, Value};

/// The parameters that are chosen to follow the ball.
const BALL: &[(&str, &str)] = &[("target", "RedBall")];

pub(crate) const DEVICE: Device = Device {
    name: "Tracker",
    kind: StreamKind::Actuator,
    label: "Tracker",
    says: "Follows the target for as long as values keep coming, and one second more.",
    icon: "target",
    params: &[
        Param {
            name: "target",
            label: "Target",
            kind: ParamKind::Choice(&[("RedBall", "red ball"), ("Face", "face")]),
        },
        Param {
            name: "mode",
            label: "What follows",
            kind: ParamKind::Choice(&[
                ("Head", "head"),
                ("WholeBody", "whole body"),
                ("Move", "move"),
                ("Arm", "arm only"),
            ]),
        },
        Param {
            name: "effector",
            label: "Arm",
            kind: ParamKind::Choice(&[
                ("None", "none"),
                ("LArm", "left arm"),
                ("RArm", "right arm"),
                ("Nearest", "nearest arm"),
                ("Value", "as the value says"),
            ]),
        },
    ],
    shape: Shape::By { param: "effector", cases: &[("Value", Shape::Text)], usual: &Shape::Anything },
    resources: Resources::By(parts),
    waiting: Waiting::Newest,
    pace: Pace::Brief,
    button: None,
    next_step: NextStep {
        for_streams: &[
            (Carries::Ball, BALL),
            (Carries::Face, &[("target", "Face")]),
            (Carries::Number, BALL),
            (Carries::Anything, BALL),
        ],
        ..NextStep::NEVER
    },
    example: "true",
    pretend: &[],
};

fn parts(params: &Params) -> Vec<Resource> {
    let said = |name: &str| params.get(name).and_then(Value::as_text);
    let body: &[Resource] = match said("mode") {
        Some("WholeBody" | "Move") => &[Resource::Head, Resource::Legs],
        Some("Arm") => &[],
        _ => &[Resource::Head],
    };
    let arms: &[Resource] = match said("effector") {
        Some("LArm") => &[Resource::LeftArm],
        Some("RArm") => &[Resource::RightArm],
        Some("Nearest" | "Value") => &[Resource::LeftArm, Resource::RightArm],
        _ => &[],
    };
    [body, arms].concat()
}
