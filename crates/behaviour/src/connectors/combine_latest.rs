//! The help of combineLatest.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "combineLatest",
    does: "Remembers the newest value of each of its streams. Whenever one of them changes, it makes one value out of \
           all of them.",
    when: "Use it when a decision needs several senses: where the ball is and where the head looks.",
    examples: &[
        Example {
            title: "Each new value is taken together with the newest one of the other stream.",
            given: &[Lane("Head", "0:1 600:2"), Lane("Ball", "300:10 900:20")],
            body: "head + ball",
            every_ms: 0,
            then: Lane("Direction", "300:11 600:12 900:22"),
            until_ms: 1_000,
        },
        Example {
            title: "Nothing comes out until every stream has told something.",
            given: &[Lane("Head", "0:1 300:2 600:3"), Lane("Ball", "800:10")],
            body: "head + ball",
            every_ms: 0,
            then: Lane("Direction", "800:13"),
            until_ms: 1_000,
        },
        Example {
            title: "An old value is not forgotten: here the ball was seen long ago. Timestamp and filter can help.",
            given: &[Lane("Ball", "0:10"), Lane("Head", "300:1 600:2 900:3")],
            body: "head + ball",
            every_ms: 0,
            then: Lane("Direction", "300:11 600:12 900:13"),
            until_ms: 1_000,
        },
    ],
};
