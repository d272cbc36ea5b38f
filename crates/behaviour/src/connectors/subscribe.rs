//! Values to an action of the robot.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `subscribe`.
pub const SPEC: Spec = Spec {
    word: "subscribe",
    name: "subscribe",
    says: "Hands each value to an action of the robot.",
    brief: "to an action",
    meaning: ConnectorMeaning::PassesOn,
    icon: Icon { name: "subscribe", strokes: &["M12 4v11", "M7.5 11L12 15.5L16.5 11", "M5 20h14"] },
    inputs: Inputs::One,
    takes: Takes::NOTHING,
    ends: StreamKind::Actuator,
    gives: Gives::Each,
    passes: Passes::Same,
    graph: GraphForm { relationship: Some("subscribe"), label: "Subscribe" },
    offered: Offered::NEVER,
    called: &[],
    help: Help {
        does: "Hands every value to an action of the robot, as soon as it comes.",
        when: "Use it at the end: nothing moves, shines or speaks without it.",
        examples: &[
            Example {
                title: "The robot says each word.",
                given: &[Lane("Word", "0:Hello 600:Bye")],
                setting: Setting::NOTHING,
                then: Lane("Say", "0:Hello 600:Bye"),
                until_ms: 900,
            },
            Example {
                title: "The same value twice is two commands.",
                given: &[Lane("Follow", "0:true 450:true")],
                setting: Setting::NOTHING,
                then: Lane("Tracker", "0:true 450:true"),
                until_ms: 900,
            },
        ],
    },
};
