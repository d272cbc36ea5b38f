//! The values of a lane: one by one, or many told together.

use std::sync::Arc;

/// The range of a lane without numbers.
pub const RANGE_EMPTY: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// One value at its moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Dot {
    /// The moment, in milliseconds since Start.
    pub t: f64,
    /// The value as a number, if it is one.
    pub number: Option<f64>,
    /// The value in few characters; empty if the number says it all.
    pub text: Arc<str>,
}

/// The values of a short stretch, told together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DotSpan {
    /// The moment of the first of them.
    pub t: f64,
    /// The moment of the last of them.
    pub until: f64,
    /// The number of values.
    pub count: u64,
    /// The least and the greatest number; the range is empty if there are none.
    pub range: (f64, f64),
    /// The first and the last number; not finite if there are none.
    pub ends: (f64, f64),
}

/// The values of a lane, in the order of time.
#[derive(Clone, Debug, PartialEq)]
pub enum LaneFilling {
    /// Each value.
    Values(Vec<Dot>),
    /// Many values, told together.
    Spans(Vec<DotSpan>),
}
