//! The time beside each value.

use super::{ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, Passes, Spec, Takes};
use crate::StreamKind;
use crate::flow::Gives;
use crate::marbles::{Example, Lane, Setting};

/// The connector `timestamp`.
pub const SPEC: Spec = Spec {
    word: "timestamp",
    name: "timestamp",
    says: "Puts the time beside each value.",
    brief: "with the time",
    meaning: ConnectorMeaning::Stamps,
    icon: Icon { name: "timestamp", strokes: &["M12 4a8 8 0 1 0 0 16a8 8 0 1 0 0-16", "M12 7.5V12l3 2"] },
    inputs: Inputs::One,
    takes: Takes::NOTHING,
    ends: StreamKind::Ordinary,
    gives: Gives::Each,
    passes: Passes::Other,
    graph: GraphForm { relationship: Some("timestamp"), label: "Timestamp" },
    offered: Offered::NEVER,
    called: &["{input} with time"],
    help: Help {
        does: "Writes the time beside every value: v is the value, t the time since Start in milliseconds.",
        when: "Use it before combineLatest, to find out how old a value is and to leave out what was seen too long ago.",
        examples: &[
            Example {
                title: "Each value is passed on together with its time.",
                given: &[Lane("Distance", "100:5 700:8")],
                setting: Setting::NOTHING,
                then: Lane("Distance and time", "100:5@100 700:8@700"),
                until_ms: 900,
            },
            Example {
                title: "The same value at another time is told apart.",
                given: &[Lane("Touch", "200:true 600:true")],
                setting: Setting::NOTHING,
                then: Lane("Touch and time", "200:true@200 600:true@600"),
                until_ms: 900,
            },
        ],
    },
};
