//! The help of subscribe.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "subscribe",
    does: "Hands every value to an action of the robot, as soon as it comes.",
    when: "Use it at the end: nothing moves, shines or speaks without it.",
    examples: &[
        Example {
            title: "The robot says each word.",
            given: &[Lane("Word", "0:Hello 600:Bye")],
            body: "",
            every_ms: 0,
            then: Lane("Say", "0:Hello 600:Bye"),
            until_ms: 900,
        },
        Example {
            title: "The same value twice is two commands.",
            given: &[Lane("Follow", "0:true 450:true")],
            body: "",
            every_ms: 0,
            then: Lane("Tracker", "0:true 450:true"),
            until_ms: 900,
        },
    ],
};
