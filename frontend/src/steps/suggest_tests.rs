//! Tests of the suggestions along the way of the thesis.

use super::{Step, suggest};
use crate::steps::known::StreamKnowledge;
use behaviour::{
    Behaviour, Connector, Declared, Helper, Id, Kind, Operation, Params, Procedure, Record, RecordId, Stream,
    StreamKind, Unit, Value, ValueType, connectors,
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
    words_with(behaviour, stream, &robot::shipped_helpers(), &StreamKnowledge { value, kind: None })
}

/// The likely ones, without what stands only in the list of all.
fn words_with(behaviour: &Behaviour, stream: &str, helpers: &[Helper], known: &StreamKnowledge) -> Vec<String> {
    suggest(behaviour, &id(stream), helpers, known).into_iter().map(word).collect()
}

fn word(step: Step) -> String {
    match step {
        Step::Helper(name) => name,
        Step::Connector(spec) => spec.word.to_owned(),
        Step::Otherwise(_, body, _) => format!("otherwise {body}"),
        Step::Action(device, _) => device.name.to_owned(),
        Step::Converted(_, to, Some(then)) => format!("in {}: {}", to.symbol(), word(*then)),
        Step::Converted(_, to, None) => format!("in {}", to.symbol()),
    }
}

#[test]
fn a_ball_suggests_its_distance() {
    let expected = ["distance", "Tracker", "SayParameter", "filter", "map", "ball_to_distance", "ball_x_and_distance"];
    assert_eq!(words("ball", None)[..7], expected);
}

#[test]
fn a_distance_suggests_the_other_side_of_its_filter_and_a_filter() {
    let expected =
        ["otherwise distance >= 20", "filter", "map", "Tracker", "in m: distance_to_brightness", "SayParameter"];
    assert_eq!(words("distance", None)[..6], expected, "a brightness wants metres, and these are centimetres");
    assert_eq!(words("distance", None).last().map(String::as_str), Some("in m"));
    let mut metres = track();
    let made = connectors::map::SPEC.with(Procedure::Helper("ball_to_distance".into()));
    with_connector(&mut metres, made, "ball", "distance");
    let expected = ["otherwise distance >= 20", "filter", "distance_to_brightness", "map", "Tracker", "SayParameter"];
    assert_eq!(words_of(&metres, "distance", None)[..6], expected);
}

#[test]
fn what_passed_a_filter_suggests_an_action() {
    assert_eq!(words("close", None)[..3], ["Tracker", "SayParameter", "otherwise distance >= 20"]);
}

#[test]
fn an_action_of_what_passes_suggests_what_does_not_pass() {
    let mut made = track();
    assert_eq!(words("tracker", None), ["otherwise distance >= 20"]);
    let steps = suggest(&made, &id("tracker"), &robot::shipped_helpers(), &StreamKnowledge::default());
    assert!(matches!(&steps[..], [Step::Otherwise(_, _, tested)] if *tested == id("distance")));
    with_stream(&mut made, "far", StreamKind::Ordinary, None);
    with_connector(&mut made, connectors::filter::SPEC.with(Procedure::body("distance >= 20")), "distance", "far");
    assert_eq!(words_of(&made, "tracker", None), Vec::<String>::new(), "it is there");
    assert_eq!(words_of(&touched(), "count", None)[..1], ["filter"], "nothing is tested there");
}

#[test]
fn a_value_that_is_there_says_more_than_a_guess() {
    assert_eq!(words("close", Some(&Value::text("hi")))[0], "SayInput");
}

#[test]
fn a_touch_suggests_its_changes() {
    let (behaviour, expected) = (touched(), ["filter", "distinct", "map", "SayParameter", "EyeLedColor"]);
    assert_eq!(words_of(&behaviour, "touch", None)[..5], expected);
    assert_eq!(words_of(&behaviour, "touch", Some(&Value::Bool(true)))[..5], expected, "also while it runs");
    let changed = words_of(&behaviour, "changed", None);
    assert_eq!(changed[..4], ["filter", "map", "SayParameter", "EyeLedColor"], "its changes are offered once");
}

#[test]
fn a_truth_suggests_to_remember() {
    let expected = ["filter", "scan", "map", "SayParameter", "EyeLedColor"];
    assert_eq!(words_of(&touched(), "far", None)[..5], expected);
    assert_eq!(words_of(&touched(), "count", Some(&Value::Bool(false)))[..2], ["filter", "map"], "but not twice");
    assert_eq!(words_of(&touched(), "count", Some(&Value::Int(2)))[0], "filter");
}

#[test]
fn what_a_stream_carries_decides_whoever_made_it() {
    let mut made = track();
    with_connector(&mut made, connectors::map::SPEC.with(Procedure::body("100.0 * ball.x")), "ball", "distance");
    let own = |name: &str, takes| Helper {
        name: name.to_owned(),
        params: vec!["how_far".to_owned()],
        body: "how_far < 1.0".to_owned(),
        takes: vec![takes],
        ..Helper::default()
    };
    let helpers =
        [own("near", Declared::In(Unit::Metres)), own("words", Declared::Text), own("nobody_said", Declared::Auto)];
    let offered =
        |of: ValueType| words_with(&made, "distance", &helpers, &StreamKnowledge { kind: Some(&of), value: None });
    let helpers_of = |all: Vec<String>| -> Vec<String> {
        all.into_iter().filter(|word| helpers.iter().any(|helper| word.ends_with(&helper.name))).collect()
    };
    assert_eq!(helpers_of(offered(ValueType::in_unit(Unit::Metres))), ["near"]);
    assert_eq!(helpers_of(offered(ValueType::in_unit(Unit::Centimetres))), ["in m: near"]);
    assert_eq!(helpers_of(offered(ValueType::in_unit(Unit::Seconds))), Vec::<String>::new());
    assert_eq!(helpers_of(offered(ValueType::Text)), ["words"]);
}

#[test]
fn actions_are_offered_by_their_unit() {
    let mut made = Behaviour::default();
    with_stream(&mut made, "battery", StreamKind::Sensor, Some("Battery"));
    with_stream(&mut made, "light", StreamKind::Ordinary, None);
    let known = |kind| StreamKnowledge { kind: Some(kind), value: None };
    let percent = words_of(&made, "battery", None);
    assert!(percent.contains(&"in 0 to 1: EyeBrightness".to_owned()), "{percent:?}");
    assert!(!percent.contains(&"EyeBrightness".to_owned()), "not as it is: {percent:?}");
    let fraction = words_with(&made, "light", &robot::shipped_helpers(), &known(&ValueType::in_unit(Unit::Fraction)));
    let first_action =
        fraction.iter().find(|word| word.chars().all(char::is_alphanumeric) && word.starts_with(char::is_uppercase));
    assert_eq!(first_action.map(String::as_str), Some("EyeBrightness"));
}

#[test]
fn what_was_seen_last_is_better_than_nothing() {
    let mut made = track();
    with_connector(&mut made, connectors::map::SPEC.with(Procedure::Helper("gone".into())), "ball", "distance");
    assert_eq!(words_of(&made, "distance", Some(&Value::text("hi")))[1..3], ["SayInput", "Print"]);
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
        assert_eq!(behaviour::opposite(test), other);
    }
}
