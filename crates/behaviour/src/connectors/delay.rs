//! Every value, a while later.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `delay`.
pub const SPEC: Spec = Spec {
    word: "delay",
    name: "delay",
    says: "Passes on every value a while later.",
    brief: "a while later",
    meaning: ConnectorMeaning::Later,
    icon: Icon { name: "delay", strokes: &["M12 7v5l3 2", "M12 3a9 9 0 1 0 9 9", "M17 5h4v4"] },
    inputs: Inputs::One,
    takes: Takes { period: Some("Later by"), ..Takes::NOTHING },
    ends: StreamKind::Ordinary,
    gives: Gives::Later,
    passes: Passes::Same,
    graph: GraphForm { relationship: None, label: "Delay" },
    offered: Offered::NEVER,
    called: &["{input} {period} later", "{input} later"],
    help: Help {
        does: "Lets every value wait for the chosen time, then passes it on. Values keep their order.",
        when: "Use it to let the robot answer a moment later: say something a second after the touch.",
        examples: &[
            Example {
                title: "Every value comes later.",
                given: &[Lane("Touch", "0:1 200:2")],
                setting: Setting::period(300),
                then: Lane("Touch later", "300:1 500:2"),
                until_ms: 900,
            },
            Example {
                title: "Values at one moment keep their order.",
                given: &[Lane("Touch", "100:1 100:2")],
                setting: Setting::period(400),
                then: Lane("Touch later", "500:1 500:2"),
                until_ms: 900,
            },
        ],
    },
};
