//! The result of a procedure of its last result and the new value.

use super::{
    Carries, ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Procedural, ResultUse, Spec, Takes,
};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `scan`.
pub const SPEC: Spec = Spec {
    word: "scan",
    name: "remember",
    says: "Remembers a result and makes the next one of it and each value.",
    brief: "counts, remembers",
    meaning: ConnectorMeaning::Remembers,
    icon: Icon { name: "scan", strokes: &["M5 12a7 7 0 1 1 2 5", "M5 20v-4h4", "M12 8v4l3 2"] },
    inputs: Inputs::One,
    takes: Takes {
        procedure: Some(Procedural { result: ResultUse::Value, is_optional: false, before: &["soFar"] }),
        start: Some("It starts from"),
        ..Takes::NOTHING
    },
    ends: StreamKind::Ordinary,
    gives: Gives::Each,
    passes: Passes::Result,
    graph: GraphForm { relationship: None, label: "Scan" },
    offered: Offered { first_for: &[Carries::Truth], always: false },
    called: &["{helper} {input}", "{input} so far"],
    help: Help {
        does: "Remembers what its procedure made last and hands it to the procedure as soFar, together with the next \
               value. What comes out is passed on and remembered.",
        when: "Use it to count, to switch between two states, or to keep the best so far.",
        examples: &[
            Example {
                title: "Counting: every touch adds one.",
                given: &[Lane("Touch", "0:true 300:true 600:true")],
                setting: Setting { body: "if touch { soFar + 1 } else { soFar }", start: "0", ..Setting::NOTHING },
                then: Lane("Touches so far", "0:1 300:2 600:3"),
                until_ms: 900,
            },
            Example {
                title: "The largest value so far.",
                given: &[Lane("Size", "0:5 300:9 600:7")],
                setting: Setting { body: "max(soFar, size)", start: "0", ..Setting::NOTHING },
                then: Lane("Size so far", "0:5 300:9 600:9"),
                until_ms: 900,
            },
        ],
    },
};
