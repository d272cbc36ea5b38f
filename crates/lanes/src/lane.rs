//! A lane: the values of one stream, or of one number of it, over time.

use crate::dots::{Dot, LaneFilling, RANGE_EMPTY};
use crate::steps::{LaneSteps, SeenValues};

/// The shortest silence that ends a presence, in milliseconds.
const GAP_LEAST_MS: f64 = 500.0;
/// The longest silence that a presence outlasts, in milliseconds: values that come more seldom are moments.
const GAP_MOST_MS: f64 = 5_000.0;
/// The number of usual intervals without a value that end a presence.
const GAP_INTERVALS: f64 = 3.0;

/// The sort of a lane's stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaneKind {
    /// It is sensed.
    Sense,
    /// It is computed.
    Stream,
    /// It is done.
    Action,
}

/// The form in which a lane is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaneShape {
    /// A disc for each value, with its text.
    Marbles,
    /// A bar for as long as values go on coming.
    Bars,
    /// A line through its numbers.
    Plot,
}

/// The values of one stream, or of one number of it, over time.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownLane {
    /// The key of the lane, by which its owner knows it.
    pub key: String,
    /// The sort of its stream.
    pub kind: LaneKind,
    /// The form in which it is drawn.
    pub shape: LaneShape,
    /// The values.
    pub filling: LaneFilling,
    /// The least and the greatest number of the whole: the scale, which stays as it is whatever is seen.
    pub range: (f64, f64),
    /// The longest silence that a presence outlasts, in milliseconds.
    pub gap_ms: f64,
    /// The number with which a condition compares, and how it is said.
    pub limit: Option<(f64, String)>,
    steps: LaneSteps,
}

/// A marked moment or span.
#[derive(Clone, Debug, PartialEq)]
pub struct LaneMark {
    /// The moment, in milliseconds since Start.
    pub t: f64,
    /// The end of a span.
    pub until: Option<f64>,
    /// The word of the mark.
    pub text: String,
}

impl ShownLane {
    /// Makes a lane without values.
    #[must_use]
    pub fn new(key: impl Into<String>, kind: LaneKind, shape: LaneShape) -> Self {
        Self {
            key: key.into(),
            kind,
            shape,
            filling: LaneFilling::Values(Vec::new()),
            range: RANGE_EMPTY,
            gap_ms: GAP_LEAST_MS,
            limit: None,
            steps: LaneSteps::default(),
        }
    }

    /// Takes other values; the scale grows to hold them.
    pub fn fill(&mut self, filling: LaneFilling) {
        let ranges = |range: (f64, f64), other: (f64, f64)| (range.0.min(other.0), range.1.max(other.1));
        self.range = match &filling {
            LaneFilling::Values(dots) => dots
                .iter()
                .filter_map(|dot| dot.number)
                .filter(|number| number.is_finite())
                .fold(self.range, |range, number| ranges(range, (number, number))),
            LaneFilling::Spans(spans) => spans.iter().fold(self.range, |range, span| ranges(range, span.range)),
        };
        if let LaneFilling::Values(dots) = &filling {
            self.gap_ms = self.gap_ms.max(usual_gap(dots));
        }
        self.steps = LaneSteps::of(&filling, self.gap_ms);
        self.filling = filling;
    }

    /// The values between two moments and their neighbours, so many of them told together that they are about `most`; none at or
    /// after `before`.
    pub(crate) fn seen(&self, range: (f64, f64), most: usize, before: f64) -> SeenValues<'_> {
        self.steps.seen(&self.filling, range, (most, before))
    }

    /// True if a line can be drawn: there are numbers.
    #[must_use]
    pub fn has_numbers(&self) -> bool {
        self.range.0 <= self.range.1
    }

    /// The number of values; those that are told together count once.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.filling {
            LaneFilling::Values(dots) => dots.len(),
            LaneFilling::Spans(spans) => spans.len(),
        }
    }

    /// True if there are no values.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The moment of the value at a place in the order.
    #[must_use]
    pub fn moment(&self, index: usize) -> Option<f64> {
        match &self.filling {
            LaneFilling::Values(dots) => dots.get(index).map(|dot| dot.t),
            LaneFilling::Spans(spans) => spans.get(index).map(|span| span.t),
        }
    }

    /// The number of values that came before a moment.
    #[must_use]
    pub fn before(&self, t: f64) -> usize {
        match &self.filling {
            LaneFilling::Values(dots) => dots.partition_point(|dot| dot.t < t),
            LaneFilling::Spans(spans) => spans.partition_point(|span| span.t < t),
        }
    }

    /// The number of values that came until a moment, with those at it.
    #[must_use]
    pub fn until(&self, t: f64) -> usize {
        match &self.filling {
            LaneFilling::Values(dots) => dots.partition_point(|dot| dot.t <= t),
            LaneFilling::Spans(spans) => spans.partition_point(|span| span.t <= t),
        }
    }
}

/// The longest silence within a presence: half a second, or three times the usual interval.
fn usual_gap(dots: &[Dot]) -> f64 {
    let mut intervals: Vec<f64> = dots.windows(2).map(|two| two[1].t - two[0].t).filter(|ms| *ms > 0.0).collect();
    if intervals.is_empty() {
        return GAP_LEAST_MS;
    }
    let middle = (intervals.len() - 1) / 2;
    let (_, usual, _) = intervals.select_nth_unstable_by(middle, f64::total_cmp);
    (*usual * GAP_INTERVALS).clamp(GAP_LEAST_MS, GAP_MOST_MS)
}

#[cfg(test)]
mod tests {
    use super::{Dot, LaneFilling, LaneKind, LaneShape, ShownLane};

    fn dots(all: &[(f64, f64)]) -> LaneFilling {
        LaneFilling::Values(
            all.iter().map(|(t, number)| Dot { t: *t, number: Some(*number), text: "".into() }).collect(),
        )
    }

    #[test]
    fn the_scale_only_grows() {
        let mut lane = ShownLane::new("face.distance", LaneKind::Sense, LaneShape::Plot);
        assert!(!lane.has_numbers());
        lane.fill(dots(&[(0.0, 5.0), (1.0, 9.0)]));
        lane.fill(dots(&[(2.0, 7.0), (3.0, f64::NAN)]));
        assert_eq!(lane.range, (5.0, 9.0));
        assert!(lane.has_numbers());
    }

    #[test]
    fn a_presence_outlasts_three_usual_intervals() {
        let mut slow = ShownLane::new("slow", LaneKind::Sense, LaneShape::Bars);
        slow.fill(dots(&[(0.0, 1.0), (1_000.0, 1.0), (2_000.0, 1.0), (60_000.0, 1.0)]));
        assert_eq!(slow.gap_ms, 3_000.0);
        let mut seldom = ShownLane::new("seldom", LaneKind::Action, LaneShape::Bars);
        seldom.fill(dots(&[(0.0, 1.0), (60_000.0, 1.0)]));
        assert_eq!(seldom.gap_ms, 5_000.0);
        let mut fast = ShownLane::new("fast", LaneKind::Sense, LaneShape::Bars);
        fast.fill(dots(&[(0.0, 1.0), (20.0, 1.0), (40.0, 1.0)]));
        assert_eq!(fast.gap_ms, 500.0);
    }

    #[test]
    fn values_are_counted_before_and_until_a_moment() {
        let mut lane = ShownLane::new("touch", LaneKind::Sense, LaneShape::Marbles);
        lane.fill(dots(&[(10.0, 1.0), (20.0, 1.0), (20.0, 2.0), (30.0, 1.0)]));
        assert_eq!((lane.before(20.0), lane.until(20.0), lane.moment(9)), (1, 3, None));
    }
}
