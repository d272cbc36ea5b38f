//! The newest value at a steady beat.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `sample`.
pub const SPEC: Spec = Spec {
    word: "sample",
    name: "sample",
    says: "Passes on the newest value at a steady beat.",
    brief: "every second",
    meaning: ConnectorMeaning::Every,
    icon: Icon { name: "sample", strokes: &["M4 19h16", "M7 19v-6", "M12 19V6", "M17 19v-9"] },
    inputs: Inputs::One,
    takes: Takes { period: Some("One value every"), ..Takes::NOTHING },
    ends: StreamKind::Ordinary,
    gives: Gives::Later,
    passes: Passes::Same,
    graph: GraphForm { relationship: Some("sample"), label: "Sample" },
    offered: Offered::NEVER,
    called: &["{input} {every}", "{input} at times"],
    help: Help {
        does: "Waits for a steady beat. At each beat it passes on the newest value, once.",
        when: "Use it when a sense tells more often than an action can follow: one word a second, not thirty.",
        examples: &[
            Example {
                title: "Only the newest value is passed on, and only at the beat.",
                given: &[Lane("Distance", "100:5 250:8 500:7")],
                setting: Setting::period(300),
                then: Lane("Newest distance", "300:8 600:7"),
                until_ms: 900,
            },
            Example {
                title: "A value that comes at the very moment of the beat still counts.",
                given: &[Lane("Distance", "300:5 600:8")],
                setting: Setting::period(300),
                then: Lane("Newest distance", "300:5 600:8"),
                until_ms: 900,
            },
        ],
    },
};
