//! The help of merge.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "merge",
    does: "Joins several streams into one. Every value is passed on as it comes.",
    when: "Use it when several things should lead to the same action: a red ball or a green one.",
    examples: &[
        Example {
            title: "Whatever comes, from either stream, is passed on.",
            given: &[Lane("Red ball", "0:red 600:red"), Lane("Green ball", "300:green")],
            body: "",
            every_ms: 0,
            then: Lane("Any ball", "0:red 300:green 600:red"),
            until_ms: 900,
        },
        Example {
            title: "A quiet stream holds nothing up.",
            given: &[Lane("Red ball", "0:red 450:red"), Lane("Green ball", "")],
            body: "",
            every_ms: 0,
            then: Lane("Any ball", "0:red 450:red"),
            until_ms: 900,
        },
    ],
};
