//! The two sonars in the chest, 10 readings a second; NAOqi 2.8 trusts 0.2 to 0.8 m, and 2.55 m is their end. Pepper has one
//! ahead, whichever side is chosen, and one behind it.

use super::METRES;
use crate::{Device, NextStep, Pace, Param, ParamKind, Pretend, Resources, Waiting};
use behaviour::StreamKind;

pub(crate) const DEVICE: Device = Device {
    name: "Sonar",
    kind: StreamKind::Sensor,
    label: "Distance ahead",
    says: "Measures how far the nearest thing ahead is; 2.55 when nothing is near.",
    icon: "sonar",
    params: &[Param {
        name: "side",
        label: "Side",
        kind: ParamKind::Choice(&[
            ("nearest", "the nearer one"),
            ("left", "left"),
            ("right", "right"),
            ("back", "behind it"),
        ]),
    }],
    shape: METRES,
    resources: Resources::Always(&[]),
    waiting: Waiting::Newest,
    pace: Pace::Steady,
    button: None,
    next_step: NextStep::NEVER,
    example: "0.5",
    pretend: &[Pretend { says: "something near", value: "0.3" }, Pretend { says: "nothing near", value: "2.5" }],
};
