//! How much room a live value has before it would meet what stands at its right. Pure.

use super::view::Bounds;
use behaviour::Id;
use std::collections::BTreeMap;

/// The widest a live value becomes, in canvas units.
const WIDEST: f64 = 300.0;
/// Kept free between a value and what stands at its right.
const APART: f64 = 24.0;
/// The height of a row in which neighbours are looked for.
const ROW: f64 = 24.0;
/// Half of the height of a value.
const HALF: f64 = 10.0;

/// For every stream how wide its value may be; `chips` are in the way too.
pub(super) fn rooms(streams: &[(Id, Bounds)], chips: &[Bounds]) -> BTreeMap<Id, f64> {
    let mut rows: BTreeMap<i64, Vec<f64>> = BTreeMap::new();
    for bounds in streams.iter().map(|(_, bounds)| bounds).chain(chips) {
        for row in row(bounds.top)..=row(bounds.bottom) {
            rows.entry(row).or_default().push(bounds.left);
        }
    }
    rows.values_mut().for_each(|lefts| lefts.sort_by(f64::total_cmp));
    streams.iter().map(|(id, bounds)| (id.clone(), room(&rows, bounds))).collect()
}

fn room(rows: &BTreeMap<i64, Vec<f64>>, bounds: &Bounds) -> f64 {
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
    use super::{WIDEST, rooms};
    use crate::canvas::view::Bounds;
    use behaviour::Id;

    fn at(name: &str, left: f64, top: f64) -> (Id, Bounds) {
        (Id::new(name).unwrap(), Bounds { left, top, right: left + 100.0, bottom: top + 48.0 })
    }

    #[test]
    fn a_value_ends_before_its_neighbour() {
        let streams = [at("a", 0.0, 0.0), at("b", 250.0, 10.0), at("c", 0.0, 140.0)];
        let chip = Bounds { left: 180.0, top: 150.0, right: 300.0, bottom: 178.0 };
        let rooms = rooms(&streams, &[chip]);
        let room = |name: &str| rooms[&Id::new(name).unwrap()];
        assert_eq!((room("a"), room("b"), room("c")), (126.0, WIDEST, 56.0));
    }
}
