//! The help of every connector is true: each marble example, played by the engine.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::connectors::{self, Spec};
use behaviour::marbles::{Example, Lane, Marble, Setting};
use behaviour::{BehaviourFile, Value};
use engine::{Emission, Limits, Run};
use robot::Millis;
use serde_json::{Value as Json, json};

#[test]
fn every_example_comes_out_as_it_is_shown() {
    for spec in connectors::ALL {
        for example in spec.help.examples {
            let wanted: Vec<_> = example.then.marbles().map(|marble| (marble.at_ms, value(marble))).collect();
            assert_eq!(play(spec, example), wanted, "{spec:?}: {}", example.title);
        }
    }
}

#[test]
fn an_example_that_is_wrong_would_be_seen() {
    let (spec, example) = (&connectors::filter::SPEC, connectors::filter::SPEC.help.examples[0]);
    assert_eq!(example.setting, Setting::body("distance < 20"));
    let other = Example { setting: Setting::body("distance < 6"), ..example };
    assert_ne!(play(spec, &other), play(spec, &example));
}

/// Returns the values that come out of the connector, with their times.
fn play(spec: &Spec, example: &Example) -> Vec<(u64, Value)> {
    let mut run = Run::build(&file(spec, example), Limits::default()).unwrap_or_else(|faults| panic!("{}", faults[0]));
    let output = run.stream_index("out").unwrap();
    let mut told = Vec::new();
    let mut note = |emission: Emission| match emission {
        Emission::Value { at, stream, value, .. } if stream == output => told.push((at.0, value.clone())),
        Emission::Value { .. } | Emission::Fault { .. } => {}
    };
    for (stream, marble) in in_time(example.given) {
        run.feed(Millis(marble.at_ms), run.stream_index(&stream).unwrap(), value(marble), &mut note);
    }
    run.finish(Millis(example.until_ms), &mut note);
    told
}

/// All marbles of the inputs in order of time; at one time in order of the lanes.
fn in_time(lanes: &[Lane]) -> Vec<(String, Marble)> {
    let lane = |(at, lane): (usize, &Lane)| lane.marbles().map(move |marble| (format!("in{at}"), marble)).collect();
    let mut all: Vec<(String, Marble)> =
        lanes.iter().enumerate().flat_map(|lane_at| -> Vec<_> { lane(lane_at) }).collect();
    all.sort_by_key(|(_, marble)| marble.at_ms);
    all
}

/// One connector between its streams.
fn file(spec: &Spec, example: &Example) -> BehaviourFile {
    let ids: Vec<_> = (0..example.given.len()).map(|at| format!("in{at}")).collect();
    let sensor = |(id, lane): (&String, &Lane)| json!({"id": id, "kind": "sensor", "name": lane.0});
    let mut streams: Vec<Json> = ids.iter().zip(example.given).map(sensor).collect();
    let kind = if spec.acts() { "actuator" } else { "ordinary" };
    streams.push(json!({"id": "out", "kind": kind, "name": example.then.0}));
    let mut connector = json!({"id": "it", "type": spec.word, "inputs": ids, "output": "out"});
    let Setting { body, period_ms, start } = example.setting;
    if !body.is_empty() {
        connector["body"] = body.into();
    }
    if period_ms > 0 {
        connector["periodMs"] = period_ms.into();
    }
    if !start.is_empty() {
        connector["start"] = serde_json::from_str(start).unwrap();
    }
    let file = json!({
        "format": "rrp-behaviour/1", "name": example.title, "helpers": [], "streams": streams,
        "connectors": [connector],
    });
    serde_json::from_value(file).unwrap()
}

/// Returns the value that a marble stands for: a number, true or false, else a word.
fn value(marble: Marble) -> Value {
    let plain = |text: &str| serde_json::from_str(text).unwrap_or_else(|_| Value::text(text));
    match marble.parts() {
        (value, None) => plain(value),
        (value, Some(time)) => Value::object([("v", plain(value)), ("t", plain(time))]),
    }
}
