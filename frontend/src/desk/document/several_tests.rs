//! What becomes of several things at once.

use super::super::{ConnectPlan, Output, Selected, Spot, build};
use super::{LineUp, lined_up, without};
use behaviour::{Behaviour, Change, Id, Params, Place, Procedure, connectors};
use std::collections::{BTreeMap, BTreeSet};

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

fn start() -> Change {
    Change::of(id("op"), "Aiko", "Test")
}

fn places(behaviour: &Behaviour) -> BTreeMap<Id, Place> {
    behaviour.streams().filter_map(|(id, _)| Some((id.clone(), behaviour.place(id)?))).collect()
}

/// RedBall -> Distance -> Close.
fn graph() -> Behaviour {
    let mut made = Behaviour::default();
    made.apply(&build::sensor(
        &made,
        &BTreeMap::new(),
        start(),
        (&id("ball"), "RedBall", "RedBall", Params::new()),
        None,
    ));
    let ways = [
        ("ball", "distance", "Distance", connectors::map::SPEC.with(Procedure::Helper("distance".into()))),
        ("distance", "close", "Close", connectors::filter::SPEC.with(Procedure::body("distance < 20"))),
    ];
    for (from, to, name, operation) in ways {
        let output = Output::New { name: name.into(), device: None, params: Params::new() };
        let plan = ConnectPlan { operation, inputs: vec![id(from)], output, spot: Spot::Below };
        let change = build::connected(&made, &places(&made), start(), (&id(to), &id(&format!("to-{to}"))), plan);
        made.apply(&change);
    }
    made
}

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
    let row = lined_up(&made, &places(&made), &both(), LineUp::Row);
    assert_eq!(row[0].1.y, row[1].1.y);
    assert!((row[0].1.x - row[1].1.x).abs() > 200.0, "{row:?}");
    let column = lined_up(&made, &places(&made), &both(), LineUp::Column);
    assert!(column[0].1.x == column[1].1.x && column[1].1.y - column[0].1.y >= 140.0, "{column:?}");
}
