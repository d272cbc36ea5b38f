//! Tests of several things at once.

use super::super::graph_tests::{graph, ground, id, places, start};
use super::{LineUp, lined_up, without};
use crate::Selected;
use std::collections::BTreeSet;

fn both() -> BTreeSet<Selected> {
    [Selected::Stream(id("distance")), Selected::Stream(id("close"))].into()
}

#[test]
fn several_are_removed_in_one_change() {
    let mut made = graph();
    let before = made.records.clone();
    let change = without(&made, start(), &both());
    made.apply(&change);
    assert_eq!((made.streams().count(), made.connectors().count()), (1, 0));
    made.apply(&change.swapped(id("undo"), "Undo"));
    assert_eq!(made.records, before);
}

#[test]
fn streams_are_lined_up_without_covering_each_other() {
    let made = graph();
    let row = lined_up(ground(&made, &places(&made)), &both(), LineUp::Row);
    assert_eq!(row[0].1.y, row[1].1.y);
    assert!((row[0].1.x - row[1].1.x).abs() > 200.0, "{row:?}");
    let column = lined_up(ground(&made, &places(&made)), &both(), LineUp::Column);
    assert!(column[0].1.x == column[1].1.x && column[1].1.y - column[0].1.y >= 120.0, "{column:?}");
}
