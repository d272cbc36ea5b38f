//! The ruler: moments at round times, as many as have room.

use crate::axis::Axis;

/// The width that the time of a tick needs, with the space to the next.
pub const RULER_TEXT_WIDTH: f64 = 84.0;
/// Distances between ticks, in milliseconds.
const STEPS: [f64; 19] = [
    100.0,
    200.0,
    500.0,
    1_000.0,
    2_000.0,
    5_000.0,
    10_000.0,
    15_000.0,
    30_000.0,
    60_000.0,
    120_000.0,
    300_000.0,
    600_000.0,
    900_000.0,
    1_800_000.0,
    3_600_000.0,
    7_200_000.0,
    14_400_000.0,
    43_200_000.0,
];

/// A tick of the ruler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RulerMark {
    /// The moment, in milliseconds since Start.
    pub t: f64,
    /// The place.
    pub x: f64,
    /// True if the ticks are less than a second apart, so that tenths have to be said.
    pub has_tenths: bool,
}

/// The ticks of what is seen, at times that are round on the clock, which read `began` at Start.
pub(crate) fn ticks(axis: &Axis, width: f64, began: f64) -> Vec<RulerMark> {
    let room = (width / RULER_TEXT_WIDTH).floor().max(1.0);
    let wanted = axis.span() / room;
    let step =
        STEPS.into_iter().find(|step| *step >= wanted).unwrap_or_else(|| (wanted / 86_400_000.0).ceil() * 86_400_000.0);
    let first = ((began + axis.begin()) / step).ceil() as i64;
    (first..)
        .map(|at| at as f64 * step - began)
        .take_while(|t| *t <= axis.end())
        .map(|t| RulerMark { t, x: axis.x(t, width), has_tenths: step < 1_000.0 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{RULER_TEXT_WIDTH, ticks};
    use crate::axis::Axis;

    #[test]
    fn ticks_are_round_on_the_clock_and_have_room() {
        let axis = Axis::new(600_000.0, 60_000.0);
        let all = ticks(&axis, 700.0, 43_200_250.0);
        let times: Vec<f64> = all.iter().map(|tick| tick.t + 43_200_250.0).collect();
        assert_eq!(times, [43_210_000.0, 43_220_000.0, 43_230_000.0, 43_240_000.0, 43_250_000.0, 43_260_000.0]);
        for span in [1.0, 250.0, 3_000.0, 1e5, 1e6, 1e8, 1e10] {
            let axis = Axis::new(span, span);
            let all = ticks(&axis, 390.0, 0.0);
            assert!(all.len() <= 6, "{span}: {}", all.len());
            assert!(all.windows(2).all(|two| two[1].x - two[0].x >= RULER_TEXT_WIDTH - 1e-9), "{span}");
        }
    }
}
