//! The values that differ from the one before.

use super::{
    Carries, ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Procedural, ResultUse, Spec, Takes,
};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `distinct`.
pub const SPEC: Spec = Spec {
    word: "distinct",
    name: "changed",
    says: "Passes on a value only when it has changed.",
    brief: "only when it changes",
    meaning: ConnectorMeaning::Changes,
    icon: Icon { name: "distinct", strokes: &["M4 9h16", "M4 15h16", "M15 5L9 19"] },
    inputs: Inputs::One,
    takes: Takes {
        procedure: Some(Procedural { result: ResultUse::Key, is_optional: true, before: &[] }),
        ..Takes::NOTHING
    },
    ends: StreamKind::Ordinary,
    gives: Gives::Some,
    passes: Passes::Same,
    graph: GraphForm { relationship: None, label: "Distinct" },
    offered: Offered { first_for: &[Carries::Touch], always: false },
    called: &["{input} changed"],
    help: Help {
        does: "Compares every value with the last one that it passed on, and passes on only what is different. With a \
               procedure it compares what the procedure makes of the values.",
        when: "Use it to act once, not thirty times a second: once per touch, once per new face.",
        examples: &[
            Example {
                title: "Equal values in a row are passed on once.",
                given: &[Lane("Touched", "0:true 200:true 400:false 600:true")],
                setting: Setting::NOTHING,
                then: Lane("Touched changed", "0:true 400:false 600:true"),
                until_ms: 900,
            },
            Example {
                title: "With a procedure: only what it makes is compared.",
                given: &[Lane("Distance", "0:5 200:8 400:30 600:7")],
                setting: Setting::body("distance < 20"),
                then: Lane("Distance changed", "0:5 400:30 600:7"),
                until_ms: 900,
            },
        ],
    },
};
