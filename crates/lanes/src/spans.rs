//! Presence: for how long values went on coming. A silence is never bridged.

use crate::lane::ShownLane;
use crate::steps::SeenValues;

/// The most values that are read for each step: they are told together by eight.
const READ_PER_STEP: usize = 8;
/// No drawing has more steps.
const STEPS_MAX: f64 = 65_536.0;

/// The stretches in which values went on coming, of those that touch `from` to `until`, at most one a `step`.
pub(crate) fn presences(lane: &ShownLane, from: f64, until: f64, step: f64) -> Vec<(f64, f64)> {
    of_seen(seen(lane, (from, until), step, f64::INFINITY), lane.gap_ms, (from, until), step)
}

/// The values that tell them, none at or after `before`.
pub(crate) fn seen(lane: &ShownLane, (from, until): (f64, f64), step: f64, before: f64) -> SeenValues<'_> {
    let most = ((until - from) / step.max(f64::MIN_POSITIVE)).clamp(0.0, STEPS_MAX) as usize * READ_PER_STEP;
    lane.seen((from - lane.gap_ms, until + lane.gap_ms), most.max(READ_PER_STEP), before)
}

/// The stretches of some values.
pub(crate) fn of_seen(values: SeenValues, gap_ms: f64, (from, until): (f64, f64), step: f64) -> Vec<(f64, f64)> {
    let mut all: Vec<(f64, f64)> = Vec::new();
    let mut add = |begin: f64, end: f64| match all.last_mut() {
        // Shorter than a step the silence cannot be seen, and so many bars would be drawn for nothing.
        Some(last) if begin - last.1 <= gap_ms.max(step) => last.1 = end.max(last.1),
        _ => all.push((begin, end)),
    };
    match values {
        SeenValues::Each(dots) => dots.iter().for_each(|dot| add(dot.t, dot.t)),
        SeenValues::Together(spans) => spans.iter().for_each(|span| add(span.t, span.until)),
    }
    all.retain(|(begin, end)| *end >= from && *begin <= until);
    all
}

#[cfg(test)]
mod tests {
    use super::presences;
    use crate::dots::{Dot, DotSpan, LaneFilling, RANGE_EMPTY};
    use crate::lane::{LaneKind, LaneShape, ShownLane};

    fn lane(filling: LaneFilling) -> ShownLane {
        let mut lane = ShownLane::new("face", LaneKind::Sense, LaneShape::Bars);
        lane.fill(filling);
        lane
    }

    fn at(all: &[f64]) -> LaneFilling {
        LaneFilling::Values(all.iter().map(|t| Dot { t: *t, number: None, text: "".into() }).collect())
    }

    #[test]
    fn values_near_each_other_are_one_presence_and_a_silence_stays() {
        let lane = lane(at(&[0.0, 200.0, 400.0, 2_000.0, 2_200.0]));
        assert_eq!(presences(&lane, 0.0, 10_000.0, 1.0), [(0.0, 400.0), (2_000.0, 2_200.0)]);
        assert_eq!(presences(&lane, 300.0, 1_000.0, 1.0), [(0.0, 400.0)], "it began before what is seen");
        assert_eq!(presences(&lane, 500.0, 1_900.0, 1.0), [], "nothing came then");
    }

    #[test]
    fn there_are_never_more_bars_than_steps() {
        let lane = lane(at(&(0..10_000).map(|at| f64::from(at) * 1_000.0).collect::<Vec<_>>()));
        assert_eq!(presences(&lane, 0.0, 1e7, 20_000.0).len(), 1);
    }

    #[test]
    fn what_is_told_together_keeps_its_silences() {
        let span = |t, until| DotSpan { t, until, count: 9, range: RANGE_EMPTY, ends: (f64::NAN, f64::NAN) };
        let lane = lane(LaneFilling::Spans(vec![span(0.0, 900.0), span(1_000.0, 1_900.0), span(5_000.0, 5_000.0)]));
        assert_eq!(presences(&lane, 0.0, 9_000.0, 10.0), [(0.0, 1_900.0), (5_000.0, 5_000.0)]);
    }
}
