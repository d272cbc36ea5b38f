//! A lane in coarser and coarser steps: a drawing reads about as many of them as it has pixels, whatever the number of values.

use crate::dots::{Dot, DotSpan, LaneFilling, RANGE_EMPTY};

/// So many of one step are told together in the next.
const TOGETHER: usize = 8;
/// So few need no coarser step.
const FEW: usize = 512;

/// The coarser steps of a lane, the finest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LaneSteps(Vec<Vec<DotSpan>>);

/// The values that a drawing needs, in the order of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SeenValues<'l> {
    Each(&'l [Dot]),
    Together(&'l [DotSpan]),
}

impl SeenValues<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Each(dots) => dots.len(),
            Self::Together(spans) => spans.len(),
        }
    }
}

impl LaneSteps {
    /// Those of a lane in which a silence longer than `gap_ms` is never bridged.
    pub(crate) fn of(filling: &LaneFilling, gap_ms: f64) -> Self {
        let mut steps = Vec::new();
        let mut next = match filling {
            LaneFilling::Values(dots) if dots.len() > FEW => together(dots.iter().map(span), gap_ms),
            LaneFilling::Spans(spans) if spans.len() > FEW => together(spans.iter().copied(), gap_ms),
            LaneFilling::Values(_) | LaneFilling::Spans(_) => return Self::default(),
        };
        loop {
            let coarser = together(next.iter().copied(), gap_ms);
            // Where silences lie everywhere nothing can be told together.
            let is_last = next.len() <= FEW || coarser.len() * 2 > next.len();
            steps.push(std::mem::replace(&mut next, coarser));
            if is_last {
                return Self(steps);
            }
        }
    }

    /// The values from one moment to another and their neighbours, in the finest step in which these are at most `most`, but none
    /// at or after `before`.
    pub(crate) fn seen<'l>(
        &'l self,
        filling: &'l LaneFilling,
        (from, until): (f64, f64),
        (most, before): (usize, f64),
    ) -> SeenValues<'l> {
        let each = match filling {
            LaneFilling::Values(dots) => SeenValues::Each(part(dots, (from, until), before, |dot| (dot.t, dot.t))),
            LaneFilling::Spans(spans) => SeenValues::Together(part(spans, (from, until), before, ends)),
        };
        if each.len() <= most {
            return each;
        }
        let steps = self.0.iter().map(|step| part(step, (from, until), before, ends));
        let mut coarsest = each;
        for step in steps {
            coarsest = SeenValues::Together(step);
            if step.len() <= most {
                break;
            }
        }
        coarsest
    }
}

/// The part of a list between two moments, with the neighbours just outside.
fn part<T>(all: &[T], (from, until): (f64, f64), before: f64, ends: impl Fn(&T) -> (f64, f64)) -> &[T] {
    let first = all.partition_point(|one| ends(one).1 < from).saturating_sub(1);
    let last =
        (all.partition_point(|one| ends(one).0 <= until) + 1).min(all.partition_point(|one| ends(one).0 < before));
    &all[first.min(last)..last]
}

fn ends(span: &DotSpan) -> (f64, f64) {
    (span.t, span.until)
}

fn span(dot: &Dot) -> DotSpan {
    let number = dot.number.filter(|number| number.is_finite());
    let range = number.map_or(RANGE_EMPTY, |number| (number, number));
    let number = number.unwrap_or(f64::NAN);
    DotSpan { t: dot.t, until: dot.t, count: 1, range, ends: (number, number) }
}

fn has_numbers(span: &DotSpan) -> bool {
    span.range.0 <= span.range.1
}

/// Tells spans together, as far as no silence is between them; those with numbers apart from those without.
fn together(all: impl Iterator<Item = DotSpan>, gap_ms: f64) -> Vec<DotSpan> {
    let mut joined: Vec<DotSpan> = Vec::new();
    let mut many = 0;
    for span in all {
        match joined.last_mut() {
            Some(last)
                if many < TOGETHER && span.t - last.until <= gap_ms && has_numbers(last) == has_numbers(&span) =>
            {
                last.until = last.until.max(span.until);
                last.count += span.count;
                last.range = (last.range.0.min(span.range.0), last.range.1.max(span.range.1));
                last.ends.1 = span.ends.1;
                many += 1;
            }
            _ => {
                joined.push(span);
                many = 1;
            }
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::{FEW, LaneSteps, SeenValues, TOGETHER};
    use crate::dots::{Dot, DotSpan, LaneFilling};

    const ALL: (f64, f64) = (0.0, f64::INFINITY);
    const NEVER: f64 = f64::INFINITY;

    fn filling(all: impl Iterator<Item = (f64, f64)>) -> LaneFilling {
        LaneFilling::Values(all.map(|(t, number)| Dot { t, number: Some(number), text: "".into() }).collect())
    }

    #[test]
    fn each_step_is_an_eighth_of_the_one_before_and_no_peak_is_lost() {
        let filling = filling((0..100_000).map(|at| (f64::from(at), f64::from(at % 7))).chain([(1e5, 99.0)]));
        let steps = LaneSteps::of(&filling, 500.0);
        let lengths: Vec<usize> = steps.0.iter().map(Vec::len).collect();
        assert!(lengths.windows(2).all(|two| two[1] == two[0].div_ceil(TOGETHER)), "{lengths:?}");
        assert!(lengths.last().is_some_and(|last| *last <= FEW));
        for step in &steps.0 {
            assert_eq!(step.iter().map(|span| span.count).sum::<u64>(), 100_001);
            assert_eq!(step.iter().map(|span| span.range.1).fold(0.0, f64::max), 99.0);
        }
    }

    #[test]
    fn the_finest_step_is_read_that_is_small_enough() {
        let filling = filling((0..100_000).map(|at| (f64::from(at), 1.0)));
        let steps = LaneSteps::of(&filling, 500.0);
        let seen = |range, most| steps.seen(&filling, range, (most, NEVER));
        assert!(matches!(seen((0.0, 1_000.0), 2_000), SeenValues::Each(dots) if dots.len() == 1_002));
        assert!(matches!(seen(ALL, 2_000), SeenValues::Together(spans) if spans.len() == 1_563));
        assert!(matches!(seen(ALL, 20_000), SeenValues::Together(spans) if spans.len() == 12_500));
        assert_eq!(steps.seen(&filling, ALL, (usize::MAX, 7_000.0)).len(), 7_000, "nothing from there on");
    }

    #[test]
    fn a_silence_is_in_no_step() {
        let pause = |at: u32| f64::from(at) * 100.0 + if at < 5_003 { 0.0 } else { 60_000.0 };
        let filling = filling((0..10_000).map(|at| (pause(at), 1.0)));
        let steps = LaneSteps::of(&filling, 500.0);
        let bridges =
            |step: &Vec<DotSpan>| step.iter().any(|span: &DotSpan| span.t < 500_250.0 && span.until > 550_000.0);
        assert!(steps.0.len() > 1 && !steps.0.iter().any(bridges));
        let seldom = LaneSteps::of(&self::filling((0..10_000).map(|at| (f64::from(at) * 900.0, 1.0))), 500.0);
        assert_eq!(seldom.0.len(), 1, "where all is silences there is nothing to tell together");
    }
}
