//! One value out of the newest values of several streams.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Procedural, ResultUse, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `combineLatest`.
pub const SPEC: Spec = Spec {
    word: "combineLatest",
    name: "combine",
    says: "Makes one value out of the newest values of several streams.",
    brief: "with another stream",
    meaning: ConnectorMeaning::Together,
    icon: Icon {
        name: "combine",
        strokes: &["M9 6.5a5.5 5.5 0 1 0 0 11a5.5 5.5 0 1 0 0-11", "M15 6.5a5.5 5.5 0 1 0 0 11a5.5 5.5 0 1 0 0-11"],
    },
    inputs: Inputs::OneOrMore,
    takes: Takes {
        procedure: Some(Procedural { result: ResultUse::Value, is_optional: false, before: &[] }),
        ..Takes::NOTHING
    },
    ends: StreamKind::Ordinary,
    gives: Gives::Each,
    passes: Passes::Result,
    graph: GraphForm { relationship: None, label: "CombineLatest" },
    offered: Offered::NEVER,
    called: &["{helper}", "{body}"],
    help: Help {
        does: "Remembers the newest value of each of its streams. Whenever one of them changes, it makes one value out of \
               all of them.",
        when: "Use it when a decision needs several senses: where the ball is and where the head looks.",
        examples: &[
            Example {
                title: "Each new value is taken together with the newest one of the other stream.",
                given: &[Lane("Head", "0:1 600:2"), Lane("Ball", "300:10 900:20")],
                setting: Setting::body("head + ball"),
                then: Lane("Direction", "300:11 600:12 900:22"),
                until_ms: 1_000,
            },
            Example {
                title: "Nothing comes out until every stream has told something.",
                given: &[Lane("Head", "0:1 300:2 600:3"), Lane("Ball", "800:10")],
                setting: Setting::body("head + ball"),
                then: Lane("Direction", "800:13"),
                until_ms: 1_000,
            },
            Example {
                title: "An old value is not forgotten: here the ball was seen long ago. Timestamp and filter can help.",
                given: &[Lane("Ball", "0:10"), Lane("Head", "300:1 600:2 900:3")],
                setting: Setting::body("head + ball"),
                then: Lane("Direction", "300:11 600:12 900:13"),
                until_ms: 1_000,
            },
        ],
    },
};
