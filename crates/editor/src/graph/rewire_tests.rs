//! Tests of other ways through a graph.

use super::super::graph_tests::{ground, id, places, start};
use super::super::insert::inserted;
use super::super::{ConnectPlan, Gap, NewSpot, Output, connected, sensor};
use super::{Joining, WireEnd, healed, healed_by, wire_ends, wired};
use behaviour::{Behaviour, Params, Procedure, StreamKind, connectors};

fn add(made: &mut Behaviour, ids: (&str, &str), plan: ConnectPlan) {
    let change = connected(ground(made, &places(made)), start(), (&id(ids.0), &id(ids.1)), plan);
    made.apply(&change);
}

fn plan(from: &str, operation: behaviour::Operation, name: &str, device: Option<&str>) -> ConnectPlan {
    let output = Output::New { name: name.into(), device: device.map(str::to_owned), params: Params::new() };
    ConnectPlan { operation, inputs: vec![id(from)], output, spot: NewSpot::Below }
}

/// RedBall -> Distance -> Close (distance < 20) -> Tracker, and a Touch that leads nowhere.
fn graph() -> Behaviour {
    let mut made = Behaviour::default();
    for (name, device) in [("ball", "RedBall"), ("touch", "HeadTouch")] {
        let change = sensor(ground(&made, &places(&made)), start(), (&id(name), device, device, Params::new()), None);
        made.apply(&change);
    }
    let distance = connectors::map::SPEC.with(Procedure::body("redBall.size * 2"));
    add(&mut made, ("distance", "map"), plan("ball", distance, "Distance", None));
    let close = connectors::filter::SPEC.with(Procedure::body("distance < 20"));
    add(&mut made, ("close", "filter"), plan("distance", close, "Close", None));
    add(
        &mut made,
        ("tracker", "subscribe"),
        plan("close", connectors::to_action().with(()), "Tracker", Some("Tracker")),
    );
    made
}

fn wire(made: &mut Behaviour, from: &str, end: WireEnd) {
    let change =
        wired(ground(made, &places(made)), start(), (&id("new-stream"), &id("new-connector")), (&id(from), &end));
    assert!(!change.edits.is_empty(), "{end:?}");
    made.apply(&change);
    assert_eq!(behaviour::Graph::of(made).cycle(), None);
}

fn body(made: &Behaviour, connector: &str) -> String {
    let operation = &made.connector(&id(connector)).unwrap().operation;
    let Some(Procedure::Body { body, .. }) = operation.procedure() else { return String::new() };
    body.clone()
}

#[test]
fn a_wire_may_end_where_no_circle_comes_of_it() {
    let ends = wire_ends(&graph(), &id("distance"));
    let stream = |name: &str| WireEnd::Stream(id(name));
    let connector = |name: &str| WireEnd::Connector(id(name));
    let wanted = [
        (stream("close"), Joining::Merges),
        (stream("tracker"), Joining::Acts),
        (connector("subscribe"), Joining::Replaces),
    ];
    assert_eq!(ends, wanted);
    assert!(wire_ends(&graph(), &id("tracker")).is_empty(), "nothing comes out of an action");
    let ends = wire_ends(&graph(), &id("touch"));
    assert!(
        ends.contains(&(connector("map"), Joining::Replaces)) && !ends.iter().any(|(end, _)| *end == stream("ball"))
    );
}

#[test]
fn a_wire_to_an_action_tells_it_too() {
    let mut made = graph();
    wire(&mut made, "touch", WireEnd::Stream(id("tracker")));
    let new = made.connector(&id("new-connector")).unwrap();
    assert!(new.operation.spec().acts() && new.inputs == [id("touch")]);
    assert!(
        !wire_ends(&made, &id("touch")).contains(&(WireEnd::Stream(id("tracker")), Joining::Acts)),
        "once is enough"
    );
}

#[test]
fn a_wire_to_a_stream_that_is_fed_merges_and_keeps_what_is_below() {
    let mut made = graph();
    wire(&mut made, "touch", WireEnd::Stream(id("distance")));
    let merge = made.connector(&id("new-connector")).unwrap();
    assert_eq!((merge.inputs.as_slice(), &merge.output), ([id("new-stream"), id("touch")].as_slice(), &id("distance")));
    assert_eq!(made.connector(&id("map")).unwrap().output, id("new-stream"));
    assert_eq!(body(&made, "filter"), "distance < 20");
    assert!(made.place(&id("distance")).unwrap().y > made.place(&id("new-stream")).unwrap().y);
    let ball = made.stream(&id("new-stream")).unwrap();
    assert_eq!((ball.kind, ball.name.as_str()), (StreamKind::Ordinary, "Distance 2"));
    made.records.retain(|key, _| key.id != id("subscribe"));
    let before = made.connectors().count();
    wire(&mut made, "ball", WireEnd::Stream(id("distance")));
    assert_eq!(made.connectors().count(), before, "the merge that is there takes one more");
}

#[test]
fn a_stream_without_source_is_fed_again() {
    let mut made = graph();
    made.apply(&crate::build::without_connector(&made, start(), &id("map")));
    assert!(wire_ends(&made, &id("ball")).contains(&(WireEnd::Stream(id("distance")), Joining::Feeds)));
    wire(&mut made, "touch", WireEnd::Stream(id("distance")));
    assert_eq!(made.connector(&id("new-connector")).unwrap().inputs, [id("touch")]);
}

#[test]
fn a_wire_to_a_connector_replaces_its_input_and_its_body_follows() {
    let mut made = graph();
    wire(&mut made, "touch", WireEnd::Connector(id("filter")));
    assert_eq!(made.connector(&id("filter")).unwrap().inputs, [id("touch")]);
    assert_eq!(body(&made, "filter"), "headTouch < 20");
}

#[test]
fn a_connector_goes_into_an_edge_and_what_is_below_makes_room() {
    let mut made = graph();
    let before = made.place(&id("tracker")).unwrap().y;
    let gap = Gap { connector: id("filter"), input: id("distance") };
    let sample = connectors::sample::SPEC.with(());
    let plan =
        ConnectPlan { spot: NewSpot::Into(gap.clone()), ..plan("distance", sample, "Distance every second", None) };
    let change = inserted(ground(&made, &places(&made)), start(), (&id("beat"), &id("sample")), (&gap, plan));
    made.apply(&change);
    assert_eq!(made.connector(&id("sample")).unwrap().inputs, [id("distance")]);
    assert_eq!(made.connector(&id("filter")).unwrap().inputs, [id("beat")]);
    assert_eq!(body(&made, "filter"), "distanceEverySecond < 20");
    assert!(made.place(&id("tracker")).unwrap().y > before);
    let order = [("distance", "beat"), ("beat", "close"), ("close", "tracker")];
    for (above, below) in order {
        assert!(made.place(&id(above)).unwrap().y < made.place(&id(below)).unwrap().y, "{above} {below}");
    }
}

#[test]
fn a_way_is_healed_where_a_stream_is_taken_out() {
    let mut made = graph();
    assert_eq!(healed_by(&made, &id("distance")), Some(&id("ball")));
    assert_eq!(healed_by(&made, &id("ball")), None, "a sense has nothing above it");
    assert_eq!(healed_by(&made, &id("touch")), None);
    let change = healed(&made, start(), &id("distance"));
    let undo = change.swapped(id("undo"), "Undo");
    let before = made.records.clone();
    made.apply(&change);
    assert!(made.stream(&id("distance")).is_none() && made.connector(&id("map")).is_none());
    assert_eq!(made.connector(&id("filter")).unwrap().inputs, [id("ball")]);
    assert_eq!(body(&made, "filter"), "redBall < 20");
    made.apply(&undo);
    assert_eq!(made.records, before, "one undo brings all of it back");
}
