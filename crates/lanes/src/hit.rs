//! The thing that a finger or a pointer is on.

use crate::axis::Axis;
use crate::lane::{LaneMark, ShownLane};

/// The farthest from a value that a finger may be, in pixels: half of 44.
pub const FINGER_REACH: f64 = 22.0;
/// The farthest from a value that the pointer of a mouse may be, in pixels.
pub const MOUSE_REACH: f64 = 8.0;

/// The thing that was hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hit {
    /// A value of a lane, at its moment.
    Value {
        /// The lane, counted from the top.
        lane: usize,
        /// The moment of the value.
        t: f64,
    },
    /// A mark, at its moment.
    LaneMark {
        /// The moment of the mark.
        t: f64,
    },
    /// A lane, beside its values.
    ShownLane {
        /// The lane, counted from the top.
        lane: usize,
        /// The moment.
        t: f64,
    },
}

/// The value of a lane that is nearest to a place and within reach.
pub(crate) fn nearest(lane: &ShownLane, axis: &Axis, width: f64, x: f64, reach: f64) -> Option<f64> {
    let t = axis.t(x, width);
    let after = lane.before(t);
    let candidates = [after.checked_sub(1), Some(after)].into_iter().flatten().filter_map(|index| lane.moment(index));
    within_reach(candidates, axis, width, x, reach)
}

/// The mark that is nearest to a place and within reach.
pub(crate) fn nearest_mark(marks: &[LaneMark], axis: &Axis, width: f64, x: f64, reach: f64) -> Option<f64> {
    within_reach(marks.iter().map(|mark| mark.t), axis, width, x, reach)
}

fn within_reach(all: impl Iterator<Item = f64>, axis: &Axis, width: f64, x: f64, reach: f64) -> Option<f64> {
    let distance = |t: &f64| (axis.x(*t, width) - x).abs();
    all.filter(|t| distance(t) <= reach).min_by(|one, other| distance(one).total_cmp(&distance(other)))
}
