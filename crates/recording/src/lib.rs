//! A run as a file: `rrp-recording/2`, its lines written and read again, and a check if a file alone gives its own
//! actions again.
//!
//! The first line is the [`Header`]. Every other line is one [`Entry`]; who reads meets lines that they do not know, and leaves
//! them out. A file is never rewritten: it only grows at its end.
#![warn(missing_docs)]

mod check;
mod header;
mod json;
mod lines;
mod marks;
mod memory;
mod past;
mod private;
mod read;
mod spans;
mod timeline;
mod words;

pub use check::{CheckedRecording, Different, Ending, Replay, ToldValue, check};
pub use header::{FORMAT, Header, Lack};
pub use json::json;
pub use lines::{EndLine, Hand, Line, LineNames, NoteLine, RefusedLine, RobotLine};
pub use marks::{all_marks, mark, marks, run_marks, run_note};
pub use past::{PlayedPast, past};
pub use private::{Private, PrivateParts};
pub use read::{Entry, NoRecording, OpenRecording, open, read_line};
pub use spans::{Span, SpanTrack, tracks};
pub use timeline::{Happening, Timeline, TimelineEvent, timeline};
pub use words::SinceStart;
