//! Values over time as lanes: the axis of time, what stands where, what is drawn, and what a hand or a key does there.
//!
//! A [`Viewer`] holds what is looked at. It changes by an [`LaneAct`], and [`Viewer::draw`] answers with a list of [`DrawnForm`]s,
//! which a page draws in the colours of its theme. Time is handed in, in milliseconds since Start; lengths are in pixels.
#![warn(missing_docs)]

mod around;
mod axis;
mod compared;
mod dots;
mod draw;
mod hit;
mod lane;
mod layout;
mod overview;
mod play;
mod plot;
mod question;
mod ruler;
mod spans;
mod steps;
mod viewer;
mod walk;

pub use around::AROUND_MAX;
pub use axis::{Axis, SPAN_LEAST_MS};
pub use compared::{ComparedDot, ComparedLane, ComparedLanes, ComparedLimit, DotChange, LimitPlace};
pub use dots::{Dot, DotSpan, LaneFilling, RANGE_EMPTY};
pub use draw::{Align, DrawnForm, Ink, MARBLES_MAX};
pub use hit::{FINGER_REACH, Hit, MOUSE_REACH};
pub use lane::{LaneKind, LaneMark, LaneShape, ShownLane};
pub use layout::{Density, Row};
pub use play::SPEEDS;
pub use ruler::{RULER_TEXT_WIDTH, RulerMark};
pub use viewer::{LANES_MAX, LaneAct, MARKS_MAX, Viewer};
