//! Behaviours that somebody has put on the robot, as ALBehaviorManager runs them (NAOqi 2.8).

use crate::{Device, NextStep, Offers, Pace, Param, ParamKind, Resource, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Behavior",
    kind: StreamKind::Actuator,
    label: "Installed behaviour",
    says: "Starts a behaviour that is installed on the robot whenever a value comes; another one takes its place. \
           Without a name it is the one that the value names.",
    icon: "behavior",
    params: &[Param {
        name: "name",
        label: "Behaviour on the robot",
        kind: ParamKind::Text { max_chars: 200, default: "", offers: Some(Offers::Behaviors) },
    }],
    shape: Shape::Anything,
    // Nobody but who made it knows what it moves.
    resources: Resources::Always(&[
        Resource::Head,
        Resource::LeftArm,
        Resource::RightArm,
        Resource::Legs,
        Resource::Voice,
        Resource::Eyes,
    ]),
    waiting: Waiting::Newest,
    pace: Pace::Lasting,
    button: None,
    next_step: NextStep::NEVER,
    example: r#""animations/Stand/Gestures/Hey_1""#,
    pretend: &[],
};
