//! The line of a plot: at most four points for each pixel, whatever the number of values, and no line over a silence.

use crate::axis::Axis;
use crate::lane::ShownLane;
use crate::steps::SeenValues;

/// The most values that are read for each pixel: they are told together by eight.
const READ_PER_PIXEL: usize = 8;

/// The numbers of one pixel.
#[derive(Clone, Copy)]
struct PixelColumn {
    x: f64,
    first: f64,
    last: f64,
    least: f64,
    most: f64,
    /// The moment of the last of them.
    until: f64,
}

/// A number, or several told together, at their moments.
struct PlotStep {
    t: f64,
    until: f64,
    range: (f64, f64),
    ends: (f64, f64),
}

/// The lines through the numbers that are seen, as points `(x, y)`; a silence begins another line.
pub(crate) fn lines(
    lane: &ShownLane,
    values: SeenValues,
    axis: &Axis,
    (width, rows): (f64, (f64, f64)),
) -> Vec<Vec<(f64, f64)>> {
    let mut drawn = PlotLines { lines: Vec::new(), column: None, y: scale(lane.range, rows), gap_ms: lane.gap_ms };
    match values {
        SeenValues::Each(dots) => dots.iter().for_each(|dot| {
            if let Some(number) = dot.number.filter(|number| number.is_finite()) {
                let (range, ends) = ((number, number), (number, number));
                drawn.add(&PlotStep { t: dot.t, until: dot.t, range, ends }, axis.x(dot.t, width));
            }
        }),
        SeenValues::Together(spans) => spans.iter().for_each(|span| {
            if span.range.0 <= span.range.1 && span.ends.0.is_finite() && span.ends.1.is_finite() {
                let step = PlotStep { t: span.t, until: span.until, range: span.range, ends: span.ends };
                drawn.add(&step, axis.x(span.t, width));
            }
        }),
    }
    drawn.end()
}

/// The values that the lines need; the neighbours just outside are among them, so that a line goes on to the edges.
pub(crate) fn seen<'l>(lane: &'l ShownLane, axis: &Axis, width: f64, before: f64) -> SeenValues<'l> {
    lane.seen((axis.begin(), axis.end()), width.clamp(1.0, 65_536.0) as usize * READ_PER_PIXEL, before)
}

/// The height of a number in a row: the greatest number is at its upper end.
pub(crate) fn scale(range: (f64, f64), rows: (f64, f64)) -> impl Fn(f64) -> f64 + Copy {
    let (least, most) = range;
    let (top, bottom) = rows;
    move |number: f64| {
        let share = if most > least { (number - least) / (most - least) } else { 0.5 };
        bottom - share.clamp(0.0, 1.0) * (bottom - top)
    }
}

struct PlotLines<Y: Fn(f64) -> f64> {
    lines: Vec<Vec<(f64, f64)>>,
    column: Option<PixelColumn>,
    y: Y,
    gap_ms: f64,
}

impl<Y: Fn(f64) -> f64> PlotLines<Y> {
    fn add(&mut self, step: &PlotStep, x: f64) {
        let joins = self.column.is_some_and(|column| step.t - column.until <= self.gap_ms);
        if let Some(column) = self.column.as_mut().filter(|column| joins && x.floor() <= column.x.floor()) {
            (column.last, column.until) = (step.ends.1, step.until);
            (column.least, column.most) = (column.least.min(step.range.0), column.most.max(step.range.1));
            return;
        }
        self.flush();
        if !joins {
            self.lines.push(Vec::new());
        }
        let ((first, last), (least, most)) = (step.ends, step.range);
        self.column = Some(PixelColumn { x, first, last, least, most, until: step.until });
    }

    /// Draws the numbers of the pixel that is done: one vertical through all of them, or one point.
    fn flush(&mut self) {
        let (Some(column), Some(line)) = (self.column.take(), self.lines.last_mut()) else { return };
        let before = line.len();
        for number in [column.first, column.least, column.most, column.last] {
            let point = (column.x, (self.y)(number));
            if line.len() == before || line.last() != Some(&point) {
                line.push(point);
            }
        }
    }

    fn end(mut self) -> Vec<Vec<(f64, f64)>> {
        self.flush();
        self.lines
    }
}

#[cfg(test)]
mod tests {
    use super::{scale, seen};
    use crate::axis::Axis;
    use crate::dots::{Dot, DotSpan, LaneFilling};
    use crate::lane::{LaneKind, LaneShape, ShownLane};

    const ROWS: (f64, f64) = (0.0, 50.0);

    fn lines(lane: &ShownLane, axis: &Axis, width: f64, rows: (f64, f64)) -> Vec<Vec<(f64, f64)>> {
        super::lines(lane, seen(lane, axis, width, f64::INFINITY), axis, (width, rows))
    }

    fn lane(all: impl Iterator<Item = (f64, f64)>) -> ShownLane {
        let mut lane = ShownLane::new("face.distance", LaneKind::Sense, LaneShape::Plot);
        lane.fill(LaneFilling::Values(
            all.map(|(t, number)| Dot { t, number: Some(number), text: "".into() }).collect(),
        ));
        lane
    }

    #[test]
    fn few_numbers_are_points_and_a_silence_begins_another_line() {
        let lane = lane([(0.0, 0.0), (400.0, 10.0), (2_000.0, 5.0)].into_iter());
        let mut lane = lane;
        lane.gap_ms = 500.0;
        let drawn = lines(&lane, &Axis::new(2_000.0, 2_000.0), 100.0, ROWS);
        assert_eq!(drawn, [vec![(0.0, 50.0), (20.0, 0.0)], vec![(100.0, 25.0)]]);
    }

    #[test]
    fn a_million_numbers_are_a_few_points_for_each_pixel_and_no_peak_is_lost() {
        let peak = 777_777.0;
        let number = |at: f64| if at == peak { 100.0 } else { at % 7.0 };
        let lane = lane((0..1_000_000).map(f64::from).map(|at| (at, number(at))));
        let drawn = lines(&lane, &Axis::new(1e6, 1e6), 700.0, ROWS);
        let points: usize = drawn.iter().map(Vec::len).sum();
        assert!(drawn.len() == 1 && points <= 4 * 701, "{points} points");
        assert!(drawn[0].iter().any(|(_, y)| *y == 0.0), "the peak is drawn");
    }

    #[test]
    fn a_line_goes_on_to_the_edges_of_what_is_seen() {
        let lane = lane((0..100).map(|at| (f64::from(at) * 100.0, f64::from(at))));
        let mut axis = Axis::new(10_000.0, 1_000.0);
        axis.pan(3_050.0);
        let drawn = lines(&lane, &axis, 100.0, ROWS);
        assert!(drawn[0].first().unwrap().0 <= 0.0 && drawn[0].last().unwrap().0 >= 100.0);
        assert_eq!(drawn[0].len(), 12, "and no further");
    }

    #[test]
    fn what_is_told_together_is_drawn_with_its_least_and_greatest() {
        let mut lane = ShownLane::new("x", LaneKind::Stream, LaneShape::Plot);
        let span = |t| DotSpan { t, until: t + 90.0, count: 50, range: (0.0, 10.0), ends: (2.0, 5.0) };
        lane.fill(LaneFilling::Spans((0..3).map(|at| span(f64::from(at) * 100.0)).chain([span(5_000.0)]).collect()));
        let drawn = lines(&lane, &Axis::new(6_000.0, 6_000.0), 600.0, ROWS);
        assert_eq!(drawn.iter().map(Vec::len).collect::<Vec<_>>(), [12, 4], "the silence stays");
        assert_eq!(drawn[1], [(500.0, 40.0), (500.0, 50.0), (500.0, 0.0), (500.0, 25.0)]);
    }

    #[test]
    fn equal_numbers_are_in_the_middle() {
        assert_eq!(scale((3.0, 3.0), (0.0, 50.0))(3.0), 25.0);
    }
}
