//! The two sonars in the chest, 10 readings a second; NAOqi 2.8 trusts 0.2 to 0.8 m, and 2.55 m is their end.

use crate::{Device, NextStep, Param, ParamKind, Resources, Shape, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Sonar",
    kind: StreamKind::Sensor,
    label: "Sonar",
    says: "Measures how far the nearest thing ahead is; 2.55 when nothing is near.",
    icon: "sonar",
    params: &[Param {
        name: "side",
        label: "Side",
        kind: ParamKind::Choice(&[("nearest", "the nearer one"), ("left", "left"), ("right", "right")]),
    }],
    shape: Shape::Number("m"),
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    button: None,
    next_step: NextStep::NEVER,
    example: "0.5",
};
