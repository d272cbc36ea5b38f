//! The help of map.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "map",
    does: "Makes a new value out of every value, one for one.",
    when: "Use it to turn what a sense tells into what you want to know: a size into a distance, a distance into a word.",
    examples: &[
        Example {
            title: "The larger the ball is seen, the nearer it is.",
            given: &[Lane("Size", "0:2 300:3 600:6")],
            body: "6 / size",
            every_ms: 0,
            then: Lane("Distance", "0:3 300:2 600:1"),
            until_ms: 900,
        },
        Example {
            title: "A word for a number.",
            given: &[Lane("Distance", "0:5 300:30 600:7")],
            body: "if distance < 20 { \"near\" } else { \"far\" }",
            every_ms: 0,
            then: Lane("Where", "0:near 300:far 600:near"),
            until_ms: 900,
        },
        Example {
            title: "When it cannot be worked out, that one value is left out and the next one is tried.",
            given: &[Lane("Size", "0:2 300:0 600:6")],
            body: "6 / size",
            every_ms: 0,
            then: Lane("Distance", "0:3 600:1"),
            until_ms: 900,
        },
    ],
};
