//! The help of sample.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "sample",
    does: "Waits for a steady beat. At each beat it passes on the newest value, once.",
    when: "Use it when a sense tells more often than an action can follow: one word a second, not thirty.",
    examples: &[
        Example {
            title: "Only the newest value is passed on, and only at the beat.",
            given: &[Lane("Distance", "100:5 250:8 500:7")],
            body: "",
            every_ms: 300,
            then: Lane("Newest distance", "300:8 600:7"),
            until_ms: 900,
        },
        Example {
            title: "A value that comes at the very moment of the beat still counts.",
            given: &[Lane("Distance", "300:5 600:8")],
            body: "",
            every_ms: 300,
            then: Lane("Newest distance", "300:5 600:8"),
            until_ms: 900,
        },
    ],
};
