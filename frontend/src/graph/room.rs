//! The room beside a stream for its value, and beside a chip for what it says. Pure.

use super::view::CanvasBounds;
use behaviour::sort_few;
use behaviour::{FillFrom, Id};
use std::collections::{BTreeMap, HashMap};

/// The widest a live value becomes, in canvas units.
const WIDEST: f64 = 300.0;
/// Kept free between a value and what stands at its right.
const APART: f64 = 24.0;
/// The height of a row in which neighbours are looked for.
const ROW: f64 = 24.0;
/// Half of the height of a value.
const HALF: f64 = 10.0;

/// The side of a chip on which it says something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ChipSide {
    Left,
    Right,
}

/// A bubble of three lines reaches so far above and below its chip.
const BUBBLE_OVER: f64 = 16.0;
/// Between a chip and its bubble, and between that and what comes next.
const BUBBLE_APART: f64 = 26.0;
/// The narrowest bubble that can be read, and the widest, in canvas units.
const BUBBLE: [f64; 2] = [112.0, 230.0];

/// On which side of a chip there is room for a sentence, and how wide it may be; none if it would cover something.
pub(super) fn beside_chip(chip: &CanvasBounds, others: &[CanvasBounds]) -> Option<(ChipSide, f64)> {
    let level = |other: &&CanvasBounds| other.bottom > chip.top - BUBBLE_OVER && other.top < chip.bottom + BUBBLE_OVER;
    let near = || others.iter().filter(level);
    let covers = near().any(|other| other.left < chip.right && other.right > chip.left && other != chip);
    let right = near().filter(|other| other.left >= chip.right).map(|other| other.left - chip.right);
    let left = near().filter(|other| other.right <= chip.left).map(|other| chip.left - other.right);
    let width = |free: f64| (free - BUBBLE_APART).min(BUBBLE[1]);
    let right = (ChipSide::Right, width(right.fold(f64::MAX, f64::min)));
    let left = (ChipSide::Left, width(left.fold(f64::MAX, f64::min)));
    let wider = if left.1 > right.1 { left } else { right };
    (wider.1 >= BUBBLE[0] && !covers).then_some(wider)
}

/// For every stream how wide its value may be; `chips` are in the way too.
pub(super) fn rooms(streams: &[(Id, CanvasBounds)], chips: &[CanvasBounds]) -> HashMap<Id, f64> {
    let mut rows: BTreeMap<i64, Vec<f64>> = BTreeMap::new();
    for bounds in streams.iter().map(|(_, bounds)| bounds).chain(chips) {
        for row in row(bounds.top)..=row(bounds.bottom) {
            rows.entry(row).or_default().push(bounds.left);
        }
    }
    rows.values_mut().for_each(|lefts| sort_few(lefts, |one, other| one.total_cmp(other).is_lt()));
    streams.iter().map(|(id, bounds)| (id.clone(), room(&rows, bounds))).filled()
}

fn room(rows: &BTreeMap<i64, Vec<f64>>, bounds: &CanvasBounds) -> f64 {
    let middle = (bounds.top + bounds.bottom) / 2.0;
    let near = rows.range(row(middle - HALF)..=row(middle + HALF));
    let next = near.filter_map(|(_, lefts)| lefts.get(lefts.partition_point(|left| *left < bounds.right)));
    let next = next.copied().fold(f64::MAX, f64::min);
    (next - bounds.right - APART).clamp(0.0, WIDEST)
}

fn row(y: f64) -> i64 {
    (y / ROW).floor() as i64
}

#[cfg(test)]
mod tests {
    use super::{ChipSide, WIDEST, beside_chip, rooms};
    use crate::graph::view::CanvasBounds;
    use behaviour::Id;

    fn at(name: &str, left: f64, top: f64) -> (Id, CanvasBounds) {
        (Id::new(name).unwrap(), CanvasBounds { left, top, right: left + 100.0, bottom: top + 48.0 })
    }

    #[test]
    fn what_a_chip_says_covers_nothing() {
        let chip = CanvasBounds { left: 100.0, top: 100.0, right: 200.0, bottom: 128.0 };
        let at = |left: f64, top: f64| CanvasBounds { left, top, right: left + 100.0, bottom: top + 48.0 };
        assert_eq!(beside_chip(&chip, &[chip]), Some((ChipSide::Right, 230.0)));
        assert_eq!(beside_chip(&chip, &[at(350.0, 160.0)]), Some((ChipSide::Right, 230.0)), "that is below it");
        assert_eq!(beside_chip(&chip, &[at(250.0, 90.0)]), Some((ChipSide::Left, 230.0)));
        assert_eq!(beside_chip(&chip, &[at(250.0, 90.0), at(-40.0, 90.0)]), None);
        assert_eq!(beside_chip(&chip, &[at(360.0, 90.0), at(-40.0, 90.0)]), Some((ChipSide::Right, 134.0)));
    }

    #[test]
    fn a_value_ends_before_its_neighbour() {
        let streams = [at("a", 0.0, 0.0), at("b", 250.0, 10.0), at("c", 0.0, 140.0)];
        let chip = CanvasBounds { left: 180.0, top: 150.0, right: 300.0, bottom: 178.0 };
        let rooms = rooms(&streams, &[chip]);
        let room = |name: &str| rooms[&Id::new(name).unwrap()];
        assert_eq!((room("a"), room("b"), room("c")), (126.0, WIDEST, 56.0));
    }
}
