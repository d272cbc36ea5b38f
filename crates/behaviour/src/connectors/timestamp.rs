//! The help of timestamp.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "timestamp",
    does: "Writes the time beside every value: v is the value, t the time since Start in milliseconds.",
    when: "Use it before combineLatest, to find out how old a value is and to leave out what was seen too long ago.",
    examples: &[
        Example {
            title: "Each value is passed on together with its time.",
            given: &[Lane("Distance", "100:5 700:8")],
            body: "",
            every_ms: 0,
            then: Lane("Distance and time", "100:5@100 700:8@700"),
            until_ms: 900,
        },
        Example {
            title: "The same value at another time is told apart.",
            given: &[Lane("Touch", "200:true 600:true")],
            body: "",
            every_ms: 0,
            then: Lane("Touch and time", "200:true@200 600:true@600"),
            until_ms: 900,
        },
    ],
};
