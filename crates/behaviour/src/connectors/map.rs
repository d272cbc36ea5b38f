//! A new value out of each value.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Procedural, ResultUse, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `map`.
pub const SPEC: Spec = Spec {
    word: "map",
    name: "map",
    says: "Makes a new value out of each value.",
    brief: "makes another value",
    meaning: ConnectorMeaning::Makes,
    icon: Icon {
        name: "map",
        strokes: &["M3 12h5", "M11 9a3 3 0 1 0 0 6a3 3 0 1 0 0-6", "M14 12h6", "M17.5 9l3 3l-3 3"],
    },
    inputs: Inputs::One,
    takes: Takes {
        procedure: Some(Procedural { result: ResultUse::Value, is_optional: false, before: &[] }),
        ..Takes::NOTHING
    },
    ends: StreamKind::Ordinary,
    gives: Gives::Each,
    passes: Passes::Result,
    graph: GraphForm { relationship: Some("map"), label: "Map" },
    offered: Offered::ALWAYS,
    called: &["{helper}", "{body}"],
    help: Help {
        does: "Makes a new value out of every value, one for one.",
        when: "Use it to turn what a sense tells into what you want to know: a size into a distance, a distance into a word.",
        examples: &[
            Example {
                title: "The larger the ball is seen, the nearer it is.",
                given: &[Lane("Size", "0:2 300:3 600:6")],
                setting: Setting::body("6 / size"),
                then: Lane("Distance", "0:3 300:2 600:1"),
                until_ms: 900,
            },
            Example {
                title: "A word for a number.",
                given: &[Lane("Distance", "0:5 300:30 600:7")],
                setting: Setting::body("if distance < 20 { \"near\" } else { \"far\" }"),
                then: Lane("Where", "0:near 300:far 600:near"),
                until_ms: 900,
            },
            Example {
                title: "When it cannot be worked out, that one value is left out and the next one is tried.",
                given: &[Lane("Size", "0:2 300:0 600:6")],
                setting: Setting::body("6 / size"),
                then: Lane("Distance", "0:3 600:1"),
                until_ms: 900,
            },
        ],
    },
};
