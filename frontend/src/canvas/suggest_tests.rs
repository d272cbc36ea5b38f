//! What is suggested along the way of the thesis.

use super::{Step, opposite, suggest};
use behaviour::{
    Behaviour, Connector, Id, Kind, Operation, Params, Procedure, Record, RecordId, Stream, StreamKind, Value,
    connectors,
};

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

fn with_stream(made: &mut Behaviour, name: &str, kind: StreamKind, device: Option<&str>) {
    let device = device.map(str::to_owned);
    let (params, name) = (Params::new(), name.to_owned());
    let key = RecordId::new(Kind::Stream, &id(&name));
    let stream = Stream { kind, name, device, params, order: 0, resources: None, priority: None, hold_ms: None };
    made.records.insert(key, Record::Stream(stream));
}

fn with_connector(made: &mut Behaviour, operation: Operation, input: &str, output: &str) {
    let connector = Connector { operation, inputs: vec![id(input)], output: id(output), order: 0 };
    made.records.insert(RecordId::new(Kind::Connector, &id(output)), Record::Connector(connector));
}

fn track() -> Behaviour {
    let mut made = Behaviour::default();
    with_stream(&mut made, "ball", StreamKind::Sensor, Some("RedBall"));
    with_stream(&mut made, "distance", StreamKind::Ordinary, None);
    with_stream(&mut made, "close", StreamKind::Ordinary, None);
    with_stream(&mut made, "tracker", StreamKind::Actuator, Some("Tracker"));
    with_connector(&mut made, connectors::map::SPEC.with(Procedure::Helper("distance".into())), "ball", "distance");
    with_connector(&mut made, connectors::filter::SPEC.with(Procedure::body("distance < 20")), "distance", "close");
    with_connector(&mut made, connectors::subscribe::SPEC.with(()), "close", "tracker");
    made
}

fn touched() -> Behaviour {
    let mut made = Behaviour::default();
    with_stream(&mut made, "touch", StreamKind::Sensor, Some("HeadTouch"));
    for name in ["changed", "far", "count"] {
        with_stream(&mut made, name, StreamKind::Ordinary, None);
    }
    with_connector(&mut made, connectors::distinct::SPEC.with(()), "touch", "changed");
    with_connector(&mut made, connectors::map::SPEC.with(Procedure::body("distance > 20")), "touch", "far");
    with_connector(&mut made, connectors::scan::SPEC.with(Procedure::body("soFar + 1")), "touch", "count");
    made
}

fn words(stream: &str, value: Option<&Value>) -> Vec<String> {
    words_of(&track(), stream, value)
}

fn words_of(behaviour: &Behaviour, stream: &str, value: Option<&Value>) -> Vec<String> {
    let steps = suggest(behaviour, &id(stream), &robot::shipped_helpers(), value);
    let word = |step: Step| match step {
        Step::Helper(name) => name,
        Step::Connector(spec) => spec.word.to_owned(),
        Step::Otherwise(_, body) => format!("otherwise {body}"),
        Step::Action(device, _) => device.name.to_owned(),
    };
    steps.into_iter().map(word).collect()
}

#[test]
fn a_ball_suggests_its_distance() {
    assert_eq!(words("ball", None), ["distance", "Tracker", "SayParameter", "filter", "map"]);
}

#[test]
fn a_distance_suggests_the_other_side_of_its_filter_and_a_filter() {
    let expected = ["otherwise distance >= 20", "filter", "distance_to_brightness", "map", "Tracker", "SayParameter"];
    assert_eq!(words("distance", None), expected);
}

#[test]
fn what_passed_a_filter_suggests_an_action() {
    assert_eq!(words("close", None)[..2], ["Tracker", "SayParameter"]);
    assert_eq!(words("tracker", None), Vec::<String>::new());
}

#[test]
fn a_value_that_is_there_says_more_than_a_guess() {
    assert_eq!(words("close", Some(&Value::text("hi")))[0], "SayInput");
}

#[test]
fn a_touch_suggests_its_changes() {
    let (behaviour, expected) = (touched(), ["filter", "distinct", "map", "SayParameter", "EyeLedColor"]);
    assert_eq!(words_of(&behaviour, "touch", None), expected);
    assert_eq!(words_of(&behaviour, "touch", Some(&Value::Bool(true))), expected, "also while it runs");
    let changed = words_of(&behaviour, "changed", None);
    assert_eq!(changed, ["filter", "map", "SayParameter", "EyeLedColor"], "its changes are offered once");
}

#[test]
fn a_truth_suggests_to_remember() {
    let expected = ["filter", "scan", "map", "SayParameter", "EyeLedColor"];
    assert_eq!(words_of(&touched(), "far", None), expected);
    assert_eq!(words_of(&touched(), "count", Some(&Value::Bool(false)))[..2], ["filter", "map"], "but not twice");
    assert_eq!(words_of(&touched(), "count", Some(&Value::Int(2)))[0], "filter");
}

#[test]
fn the_opposite_of_a_test_is_readable() {
    let cases = [
        ("a < 20", "a >= 20"),
        ("a == 1", "a != 1"),
        ("a < 20 && b > 1", "!(a < 20 && b > 1)"),
        ("near(a)", "!(near(a))"),
    ];
    for (test, other) in cases {
        assert_eq!(opposite(test), other);
    }
}
