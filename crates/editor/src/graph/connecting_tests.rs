//! Tests of the gestures that build a behaviour.

use super::super::graph_tests::{ground, id, places};
use super::super::{ConnectPlan, Gap, NewSpot, Output};
use super::{connected, connected_twice, sensor};
use crate::build::{connector_edited, free_name, stream_edited, without_stream};
use behaviour::{Behaviour, Change, Params, Procedure, Stream, StreamKind, connectors};
use std::collections::BTreeMap;

fn start(op: &str) -> Change {
    Change::of(id(op), "Aiko", "Test")
}

/// RedBall, filtered to Close, which Tracker follows.
fn track() -> Behaviour {
    let mut made = Behaviour::default();
    made.apply(&sensor(
        ground(&made, &BTreeMap::new()),
        start("1"),
        (&id("ball"), "RedBall", "Red ball", Params::new()),
        None,
    ));
    let filter = connectors::filter::SPEC.with(Procedure::body("redBall.size > 0.1"));
    let output = Output::New { name: "Close".into(), device: None, params: Params::new() };
    let plan = ConnectPlan { operation: filter, inputs: vec![id("ball")], output, spot: NewSpot::Below };
    made.apply(&connected(ground(&made, &places(&made)), start("2"), (&id("close"), &id("filter")), plan));
    let output = Output::New { name: "Tracker".into(), device: Some("Tracker".into()), params: Params::new() };
    let plan = ConnectPlan {
        operation: connectors::subscribe::SPEC.with(()),
        inputs: vec![id("close")],
        output,
        spot: NewSpot::Below,
    };
    made.apply(&connected(ground(&made, &places(&made)), start("3"), (&id("tracker"), &id("subscribe")), plan));
    made
}

#[test]
fn streams_are_made_with_kind_order_and_place() {
    let made = track();
    let tracker = made.stream(&id("tracker")).unwrap();
    assert_eq!((tracker.kind, tracker.order), (StreamKind::Actuator, 3));
    assert!(made.place(&id("tracker")).unwrap().y > made.place(&id("close")).unwrap().y);
    assert_eq!(free_name(&made, "Tracker"), "Tracker 2");
}

#[test]
fn two_connectors_one_after_the_other_are_one_change() {
    let start_of = track();
    let plan = |name: &str, body: &str, spot| ConnectPlan {
        operation: connectors::map::SPEC.with(Procedure::body(body)),
        inputs: vec![id("ball")],
        output: Output::New { name: name.into(), device: None, params: Params::new() },
        spot,
    };
    let ids = [id("metres"), id("c1"), id("bright"), id("c2")];
    let both = [(&ids[0], &ids[1]), (&ids[2], &ids[3])];
    for spot in [NewSpot::Below, NewSpot::Into(Gap { connector: id("filter"), input: id("ball") })] {
        let plans = (plan("In m", "redBall.size", spot.clone()), plan("Bright", "inM * 2.0", NewSpot::Below));
        let change = connected_twice(ground(&start_of, &places(&start_of)), start("4"), both, plans);
        let mut made = start_of.clone();
        made.apply(&change);
        assert_eq!(made.connector(&id("c2")).unwrap().inputs, [id("metres")]);
        assert!(made.place(&id("bright")).unwrap().y > made.place(&id("metres")).unwrap().y);
        let goes_on = made.connector(&id("filter")).unwrap().inputs[0].clone();
        assert_eq!(goes_on, if spot == NewSpot::Below { id("ball") } else { id("bright") });
        made.apply(&change.swapped(id("5"), "Undo"));
        assert_eq!(made, start_of);
    }
}

#[test]
fn renaming_a_stream_rewrites_the_bodies_that_use_it() {
    let mut made = track();
    let renamed = Stream { name: "Near ball".into(), ..made.stream(&id("ball")).unwrap().clone() };
    let change = stream_edited(&made, start("4"), &id("ball"), renamed);
    assert_eq!(change.edits.len(), 2);
    made.apply(&change);
    let filter = made.connector(&id("filter")).unwrap();
    assert_eq!(filter.operation.procedure(), Some(&Procedure::body("nearBall.size > 0.1")));
}

#[test]
fn what_a_text_says_stays_when_the_stream_of_its_name_is_renamed() {
    let mut made = track();
    let said = connectors::filter::SPEC.with(Procedure::body("`the red ball is at ${redBall.x}` == \"redBall\""));
    let seen = made.connector(&id("filter")).unwrap().clone();
    made.apply(&connector_edited(&made, start("4"), (&id("filter"), &seen), (said, vec![id("ball")]), None));
    let renamed = Stream { name: "Kite".into(), ..made.stream(&id("ball")).unwrap().clone() };
    made.apply(&stream_edited(&made, start("5"), &id("ball"), renamed));
    let now = Procedure::body("`the red ball is at ${kite.x}` == \"redBall\"");
    assert_eq!(made.connector(&id("filter")).unwrap().operation.procedure(), Some(&now));
}

#[test]
fn editing_a_connector_may_rename_its_output_in_the_same_change() {
    let made = track();
    let filter = connectors::filter::SPEC.with(Procedure::body("redBall.size > 0.2"));
    let seen = made.connector(&id("filter")).unwrap();
    let of = (&id("filter"), seen);
    let change = connector_edited(&made, start("4"), of, (filter, vec![id("ball")]), Some("Very close"));
    assert_eq!(change.edits.len(), 2);
}

#[test]
fn a_removed_stream_takes_its_connectors_along() {
    let mut made = track();
    let change = without_stream(&made, start("4"), &id("close"));
    assert_eq!(change.edits.len(), 4);
    made.apply(&change);
    assert_eq!((made.streams().count(), made.connectors().count()), (2, 0));
    made.apply(&change.swapped(id("5"), "Undo"));
    assert_eq!(made, track());
}
