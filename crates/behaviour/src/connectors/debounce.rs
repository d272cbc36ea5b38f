//! A value after which nothing else came for a while.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `debounce`.
pub const SPEC: Spec = Spec {
    word: "debounce",
    name: "settle",
    says: "Passes on a value once nothing new has come for a while.",
    brief: "when it has settled",
    meaning: ConnectorMeaning::Settles,
    icon: Icon { name: "debounce", strokes: &["M3 12h3l2-6 3 12 2-6h8"] },
    inputs: Inputs::One,
    takes: Takes { period: Some("Nothing new for"), ..Takes::NOTHING },
    ends: StreamKind::Ordinary,
    gives: Gives::Later,
    passes: Passes::Same,
    graph: GraphForm { relationship: None, label: "Debounce" },
    offered: Offered::NEVER,
    called: &["{input} settled"],
    help: Help {
        does: "Holds the newest value. When nothing new has come for the chosen time, it passes that value on. Every \
               new value begins the waiting anew.",
        when: "Use it to notice that something has stopped: nobody has been seen for five seconds.",
        examples: &[
            Example {
                title: "Only the last value of a quick row is passed on.",
                given: &[Lane("Touch", "0:1 100:2 200:3")],
                setting: Setting::period(300),
                then: Lane("Touch settled", "500:3"),
                until_ms: 900,
            },
            Example {
                title: "A value that comes at the very moment replaces the one that waits.",
                given: &[Lane("Touch", "0:1 300:2")],
                setting: Setting::period(300),
                then: Lane("Touch settled", "600:2"),
                until_ms: 900,
            },
        ],
    },
};
