//! The result of a procedure of each value and the newest of other streams.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Procedural, ResultUse, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `withLatest`.
pub const SPEC: Spec = Spec {
    word: "withLatest",
    name: "with latest",
    says: "Combines each value with the newest values of other streams.",
    brief: "with another’s newest",
    meaning: ConnectorMeaning::Latest,
    icon: Icon { name: "with-latest", strokes: &["M4 7h9", "M4 17h5a4 4 0 0 0 4-4V7", "M13 7h7", "M17 4l3 3-3 3"] },
    inputs: Inputs::TwoOrMore,
    takes: Takes {
        procedure: Some(Procedural { result: ResultUse::Value, is_optional: false, before: &[] }),
        ..Takes::NOTHING
    },
    ends: StreamKind::Ordinary,
    gives: Gives::Some,
    passes: Passes::Result,
    graph: GraphForm { relationship: None, label: "WithLatest" },
    offered: Offered::NEVER,
    called: &["{helper} {input}", "{input} with {others}"],
    help: Help {
        does: "Each value of the first stream is put together with the newest values of the others, once all of them \
               have one. The other streams alone give nothing.",
        when: "Use it to say what was seen last when something happens: touched, say the color.",
        examples: &[
            Example {
                title: "Only the first stream gives.",
                given: &[Lane("Touch", "300:1 600:2"), Lane("Color", "0:red 500:blue")],
                setting: Setting::body("color + touch"),
                then: Lane("Said", "300:red1 600:blue2"),
                until_ms: 900,
            },
            Example {
                title: "Before the others have a value nothing comes out.",
                given: &[Lane("Touch", "0:1 600:2"), Lane("Color", "300:red")],
                setting: Setting::body("color + touch"),
                then: Lane("Said", "600:red2"),
                until_ms: 900,
            },
        ],
    },
};
