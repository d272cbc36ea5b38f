//! The values that pass a test.

use super::{
    Carries, ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Procedural, ResultUse, Spec, Takes,
};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `filter`.
pub const SPEC: Spec = Spec {
    word: "filter",
    name: "filter",
    says: "Keeps the values that pass a test.",
    brief: "keeps some",
    meaning: ConnectorMeaning::Keeps,
    icon: Icon { name: "filter", strokes: &["M4 5h16l-6 7.5V19l-4-2.2v-4.3z"] },
    inputs: Inputs::One,
    takes: Takes {
        procedure: Some(Procedural { result: ResultUse::Test, is_optional: false, before: &[] }),
        ..Takes::NOTHING
    },
    ends: StreamKind::Ordinary,
    gives: Gives::Some,
    passes: Passes::Same,
    graph: GraphForm { relationship: Some("filter"), label: "Filter" },
    offered: Offered { first_for: &[Carries::Number, Carries::Touch, Carries::Truth], always: true },
    called: &["{helper} {input}", "{body}"],
    help: Help {
        does: "Asks a question about every value and keeps the values for which the answer is true. The values themselves \
               stay as they are.",
        when: "Use it to act only sometimes: only when the ball is near, only when the head is touched.",
        examples: &[
            Example {
                title: "Only what is near is kept.",
                given: &[Lane("Distance", "0:5 300:30 600:7")],
                setting: Setting::body("distance < 20"),
                then: Lane("Near", "0:5 600:7"),
                until_ms: 900,
            },
            Example {
                title: "Two questions at once: both must be true.",
                given: &[Lane("Distance", "0:5 300:15 600:30")],
                setting: Setting::body("distance > 10 && distance < 20"),
                then: Lane("In between", "300:15"),
                until_ms: 900,
            },
            Example {
                title: "A value that is true or false can answer for itself.",
                given: &[Lane("Touch", "0:true 300:false 600:true")],
                setting: Setting::body("touch"),
                then: Lane("Touched", "0:true 600:true"),
                until_ms: 900,
            },
        ],
    },
};
