//! Keys lead from value to value, from mark to mark.

use crate::dots::Dot;
use crate::lane::{LaneMark, ShownLane};

/// The moment of the next value of a lane, or of the one before.
pub(crate) fn value_from(lane: &ShownLane, cursor: f64, forward: bool) -> Option<f64> {
    let index = if forward { lane.until(cursor) } else { lane.before(cursor).checked_sub(1)? };
    lane.moment(index)
}

/// The moment of the next of some values, or of the one before.
pub(crate) fn dot_from(dots: &[Dot], cursor: f64, forward: bool) -> Option<f64> {
    let index = if forward {
        dots.partition_point(|dot| dot.t <= cursor)
    } else {
        dots.partition_point(|dot| dot.t < cursor).checked_sub(1)?
    };
    dots.get(index).map(|dot| dot.t)
}

/// The moment of the next mark, or of the one before. Marks may stand in any order.
pub(crate) fn mark_from(marks: &[LaneMark], cursor: f64, forward: bool) -> Option<f64> {
    let moments = marks.iter().map(|mark| mark.t);
    if forward {
        moments.filter(|t| *t > cursor).min_by(f64::total_cmp)
    } else {
        moments.filter(|t| *t < cursor).max_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::{mark_from, value_from};
    use crate::dots::{Dot, LaneFilling};
    use crate::lane::{LaneKind, LaneMark, LaneShape, ShownLane};

    #[test]
    fn keys_go_from_value_to_value() {
        let mut lane = ShownLane::new("touch", LaneKind::Sense, LaneShape::Marbles);
        let dot = |t| Dot { t, number: None, text: "".into() };
        lane.fill(LaneFilling::Values([10.0, 20.0, 20.0, 30.0].map(dot).into()));
        assert_eq!([value_from(&lane, 10.0, true), value_from(&lane, 20.0, true)], [Some(20.0), Some(30.0)]);
        assert_eq!([value_from(&lane, 20.0, false), value_from(&lane, 10.0, false)], [Some(10.0), None]);
        assert_eq!(value_from(&lane, 30.0, true), None);
    }

    #[test]
    fn keys_go_from_mark_to_mark_in_any_order() {
        let marks = [50.0, 10.0, 30.0].map(|t| LaneMark { t, until: None, text: String::new() });
        assert_eq!([mark_from(&marks, 10.0, true), mark_from(&marks, 50.0, true)], [Some(30.0), None]);
        assert_eq!([mark_from(&marks, 40.0, false), mark_from(&marks, 10.0, false)], [Some(30.0), None]);
    }
}
