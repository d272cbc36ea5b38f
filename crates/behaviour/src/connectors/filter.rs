//! The help of filter.

use super::{Example, Lane, Page};

pub(super) const PAGE: Page = Page {
    connector: "filter",
    does: "Asks a question about every value and keeps the values for which the answer is true. The values themselves \
           stay as they are.",
    when: "Use it to act only sometimes: only when the ball is near, only when the head is touched.",
    examples: &[
        Example {
            title: "Only what is near is kept.",
            given: &[Lane("Distance", "0:5 300:30 600:7")],
            body: "distance < 20",
            every_ms: 0,
            then: Lane("Near", "0:5 600:7"),
            until_ms: 900,
        },
        Example {
            title: "Two questions at once: both must be true.",
            given: &[Lane("Distance", "0:5 300:15 600:30")],
            body: "distance > 10 && distance < 20",
            every_ms: 0,
            then: Lane("In between", "300:15"),
            until_ms: 900,
        },
        Example {
            title: "A value that is true or false can answer for itself.",
            given: &[Lane("Touch", "0:true 300:false 600:true")],
            body: "touch",
            every_ms: 0,
            then: Lane("Touched", "0:true 600:true"),
            until_ms: 900,
        },
    ],
};
