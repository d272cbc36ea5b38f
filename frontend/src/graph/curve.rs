//! The ways of connectors: the chip between its streams and the curves through it.

use crate::layout::{CHIP_HEIGHT, GAP, STREAM_HEIGHT};
use behaviour::sort_few;
use behaviour::{Place, StreamKind};
use std::fmt::Write;

/// The length that an edge runs straight down before it ends in what stands aside of its chip.
const STRAIGHT: f64 = 24.0;
/// The height of its bend above that.
const BEND: f64 = 22.0;
/// Below a stream whose action is further down than the next row.
const UNDER: f64 = 32.0;
/// The least distance of a chip from a stream.
const NEAR: f64 = 16.0;

/// Returns the place of a chip: the middle of its top edge. It is half way above its stream; on the way to an action
/// that is far down, under what it comes from, so that the edge runs straight from there. `aside` is how far it stands
/// aside where several lead to that action; then there is room below it for the bend.
pub(super) fn chip_place(inputs: &[Place], output: Place, output_kind: StreamKind, aside: Option<f64>) -> Place {
    let x = output.x + aside.unwrap_or_default();
    if inputs.is_empty() {
        return Place { x, y: output.y - CHIP_HEIGHT - 22.0 };
    }
    let lowest = inputs.iter().map(|place| place.y).fold(f64::MIN, f64::max) + STREAM_HEIGHT;
    let midway = (lowest + output.y) / 2.0 - CHIP_HEIGHT / 2.0;
    let y = match aside {
        Some(_) => {
            let wanted = output.y - STRAIGHT - BEND - CHIP_HEIGHT;
            if midway < wanted { wanted } else { wanted.max(lowest + NEAR).min(midway) }
        }
        None if output_kind == StreamKind::Actuator && output.y > lowest => midway.min(lowest + UNDER),
        None => midway,
    };
    Place { x, y }
}

/// Returns how far each of several chips that lead to one action stands aside of it: beside each other, in the order of
/// where they come from. `chips` has of each where it comes from and how wide it is.
pub(super) fn asides(chips: &[(f64, f64)]) -> Vec<f64> {
    let mut row: Vec<usize> = (0..chips.len()).collect();
    sort_few(&mut row, |one, other| chips[*one].0.total_cmp(&chips[*other].0).is_lt());
    let whole: f64 = chips.iter().map(|(_, width)| width + GAP).sum::<f64>() - GAP;
    let mut asides = vec![0.0; chips.len()];
    let mut left = -whole / 2.0;
    for at in row {
        asides[at] = left + chips[at].1 / 2.0;
        left += chips[at].1 + GAP;
    }
    asides
}

/// The curves from every input to the chip and on to the output.
pub(super) fn ways(inputs: &[Place], chip: Place, output: Place) -> String {
    let mut path = String::new();
    for input in inputs {
        curve(&mut path, (input.x, input.y + STREAM_HEIGHT), (chip.x, chip.y));
    }
    let (from, end) = ((chip.x, chip.y + CHIP_HEIGHT), (output.x, output.y - 2.0));
    let straight = if (from.0 - end.0).abs() < 1.0 { 0.0 } else { STRAIGHT.min((end.1 - from.1) * 0.6).max(0.0) };
    curve(&mut path, from, (end.0, end.1 - straight));
    if straight > 0.0 {
        let _ = write!(path, "L{:.0} {:.0}", end.0, end.1);
    }
    path
}

/// Returns the curves through a chip, with a small head at the end.
pub(super) fn curves(inputs: &[Place], chip: Place, output: Place) -> String {
    let mut path = ways(inputs, chip, output);
    head(&mut path, output);
    path
}

fn head(path: &mut String, output: Place) {
    let (x, y) = (output.x, output.y - 2.0);
    let _ = write!(path, "M{:.0} {:.0}L{x:.0} {y:.0}L{:.0} {:.0}", x - 4.5, y - 6.0, x + 4.5, y - 6.0);
}

/// The curves from every input to an output without a chip between.
pub(super) fn straight_ways(inputs: &[Place], output: Place) -> String {
    let mut path = String::new();
    for input in inputs {
        curve(&mut path, (input.x, input.y + STREAM_HEIGHT), (output.x, output.y - 2.0));
    }
    path
}

/// Returns the curves without a chip, with a small head at the end, if there are any.
pub(super) fn straight(inputs: &[Place], output: Place) -> String {
    let mut path = straight_ways(inputs, output);
    if !inputs.is_empty() {
        head(&mut path, output);
    }
    path
}

/// One curve from a point to another.
pub(super) fn curve_between(from: (f64, f64), to: (f64, f64)) -> String {
    let mut path = String::new();
    curve(&mut path, from, to);
    path
}

/// Returns the distance of a point from the curve between two others.
pub(super) fn distance_to_curve(at: (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let bend = bend(from, to);
    let [p0, p1, p2, p3] = [from, (from.0, from.1 + bend), (to.0, to.1 - bend), to];
    let point = |t: f64| {
        let (u, [a, b, c, d]) = (1.0 - t, [p0, p1, p2, p3]);
        let mix =
            |a: f64, b: f64, c: f64, d: f64| u * u * u * a + 3.0 * u * u * t * b + 3.0 * u * t * t * c + t * t * t * d;
        (mix(a.0, b.0, c.0, d.0), mix(a.1, b.1, c.1, d.1))
    };
    let apart = |t: f64| {
        let (x, y) = point(t);
        (x - at.0).hypot(y - at.1)
    };
    (0..=CURVE_POINTS).map(|step| apart(f64::from(step) / f64::from(CURVE_POINTS))).fold(f64::MAX, f64::min)
}

/// The number of points of a curve that are looked at for how far something is from it.
const CURVE_POINTS: u32 = 16;

fn bend(from: (f64, f64), to: (f64, f64)) -> f64 {
    ((to.1 - from.1).abs() / 2.0).clamp(4.0, 120.0)
}

/// An S that leaves and arrives upright.
fn curve(path: &mut String, from: (f64, f64), to: (f64, f64)) {
    let bend = bend(from, to);
    let _ = write!(
        path,
        "M{:.0} {:.0}C{:.0} {:.0} {:.0} {:.0} {:.0} {:.0}",
        from.0,
        from.1,
        from.0,
        from.1 + bend,
        to.0,
        to.1 - bend,
        to.0,
        to.1
    );
}

#[cfg(test)]
mod tests {
    use super::{asides, chip_place, curves, distance_to_curve};
    use behaviour::{Place, StreamKind};

    const TOP: Place = Place { x: 0.0, y: 0.0 };

    #[test]
    fn a_chip_stands_midway() {
        let below = Place { x: 200.0, y: 140.0 };
        for kind in [StreamKind::Ordinary, StreamKind::Actuator] {
            assert_eq!(chip_place(&[TOP], below, kind, None), Place { x: 200.0, y: 80.0 });
        }
        assert_eq!(chip_place(&[], below, StreamKind::Ordinary, None).y, 90.0);
        let far = Place { x: 200.0, y: 700.0 };
        assert_eq!(chip_place(&[TOP], far, StreamKind::Actuator, None), Place { x: 200.0, y: 80.0 });
        assert_eq!(chip_place(&[far], TOP, StreamKind::Actuator, None).y, 360.0, "an action above what leads to it");
    }

    #[test]
    fn several_chips_of_an_action_stand_beside_each_other_and_their_edges_end_straight() {
        assert_eq!(asides(&[(500.0, 100.0), (0.0, 76.0)]), [50.0, -62.0]);
        let below = Place { x: 200.0, y: 140.0 };
        let chip = chip_place(&[TOP], below, StreamKind::Actuator, Some(-62.0));
        assert!(chip.x == 138.0 && chip.y >= 48.0 + 16.0, "{chip:?}");
        let path = curves(&[TOP], chip, below);
        assert!(path.contains(" 200 114L200 138M"), "{path}");
    }

    #[test]
    fn a_point_is_near_a_curve_that_passes_it() {
        let (from, to) = ((0.0, 0.0), (200.0, 160.0));
        assert!(distance_to_curve((100.0, 80.0), from, to) < 1.0);
        assert!(distance_to_curve((0.0, 16.0), from, to) < 8.0);
        assert!(distance_to_curve((200.0, 0.0), from, to) > 80.0);
    }

    #[test]
    fn every_input_has_its_curve() {
        let below = Place { x: 0.0, y: 140.0 };
        let path = curves(&[TOP, Place { x: 90.0, y: 0.0 }], Place { x: 0.0, y: 80.0 }, below);
        assert_eq!(path.matches('C').count(), 3);
        assert!(path.starts_with("M0 48C0 64 0 64 0 80M90 48C90 64 0 64 0 80M0 108C"));
    }
}
