//! Several streams as one.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `merge`.
pub const SPEC: Spec = Spec {
    word: "merge",
    name: "merge",
    says: "Joins several streams into one, as their values come.",
    brief: "with another stream",
    meaning: ConnectorMeaning::PassesOn,
    icon: Icon { name: "merge", strokes: &["M6 4c0 5 6 4 6 9v7", "M18 4c0 5-6 4-6 9"] },
    inputs: Inputs::OneOrMore,
    takes: Takes::NOTHING,
    ends: StreamKind::Ordinary,
    gives: Gives::Each,
    passes: Passes::Same,
    graph: GraphForm { relationship: None, label: "Merge" },
    offered: Offered::NEVER,
    called: &["{input} or {others}"],
    help: Help {
        does: "Joins several streams into one. Every value is passed on as it comes.",
        when: "Use it when several things should lead to the same action: a red ball or a green one.",
        examples: &[
            Example {
                title: "Whatever comes, from either stream, is passed on.",
                given: &[Lane("Red ball", "0:red 600:red"), Lane("Green ball", "300:green")],
                setting: Setting::NOTHING,
                then: Lane("Any ball", "0:red 300:green 600:red"),
                until_ms: 900,
            },
            Example {
                title: "A quiet stream holds nothing up.",
                given: &[Lane("Red ball", "0:red 450:red"), Lane("Green ball", "")],
                setting: Setting::NOTHING,
                then: Lane("Any ball", "0:red 450:red"),
                until_ms: 900,
            },
        ],
    },
};
