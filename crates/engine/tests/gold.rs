//! Every case of `tests/gold`, in both modes, compared line by line as the specification says.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{BehaviourFile, Engine, Value};
use engine::{Emission, Limits, Run, try_body};
use robot::Millis;
use serde_json::Value as Json;
use std::fs::read_to_string;
use std::path::{Path, PathBuf};

fn gold() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/gold")
}

fn cases() -> Vec<PathBuf> {
    let mut cases: Vec<_> = std::fs::read_dir(gold()).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.is_dir());
    cases.sort();
    assert!(cases.len() >= 15);
    cases
}

fn lines(path: &Path) -> Vec<Json> {
    read_to_string(path).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Runs a case with all streams and faults shown.
fn play(case: &Path, mode: Engine, compiled: bool) -> Vec<Json> {
    let mut file: BehaviourFile = serde_json::from_str(&read_to_string(case.join("behaviour.json")).unwrap()).unwrap();
    file.engine = Some(mode);
    let mut run =
        Run::build(&file, Limits { compiled, ..Limits::default() }).map_err(|faults| faults[0].to_string()).unwrap();
    let connectors: Vec<_> = run.connectors().iter().map(|connector| connector.id.clone()).collect();
    let streams: Vec<_> = run.streams().iter().map(|stream| stream.id.clone()).collect();
    let mut shown = Vec::new();
    let mut show = |emission: Emission| {
        shown.push(match emission {
            Emission::Value { at, stream, value, .. } => {
                serde_json::json!({"t": at.0, "stream": streams[stream.index()], "value": value})
            }
            Emission::Fault { at, connector, error, .. } => {
                serde_json::json!({"t": at.0, "connector": connectors[connector.index()], "error": error.to_string()})
            }
        });
    };
    let until = &serde_json::from_str::<Json>(&read_to_string(case.join("case.json")).unwrap()).unwrap()["until"];
    for reading in lines(&case.join("trace.jsonl")) {
        let at = Millis(reading["t"].as_u64().unwrap());
        let stream = run.stream_index(reading["stream"].as_str().unwrap()).unwrap();
        let value: Value = serde_json::from_value(reading["value"].clone()).unwrap();
        run.feed(at, stream, value, &mut show);
    }
    run.finish(Millis(until.as_u64().unwrap()), &mut show);
    shown
}

/// Numbers by value, whole and measured kept apart, the text of faults ignored.
fn same(made: &Json, wanted: &Json) -> bool {
    match (made, wanted) {
        (Json::Number(a), Json::Number(b)) => a.is_f64() == b.is_f64() && (a == b || a.as_f64() == b.as_f64()),
        (Json::Array(a), Json::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        (Json::Object(a), Json::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(name, a)| b.get(name).is_some_and(|b| name == "error" || same(a, b)))
        }
        (a, b) => a == b,
    }
}

fn check_all(expected: &str, mode: impl Fn(&Path) -> Engine) {
    for (case, compiled) in cases().into_iter().flat_map(|case| [(case.clone(), true), (case, false)]) {
        let (made, wanted) = (play(&case, mode(&case), compiled), lines(&case.join(expected)));
        for (at, (made, wanted)) in made.iter().zip(&wanted).enumerate() {
            assert!(same(made, wanted), "{} line {}: {made} instead of {wanted}", case.display(), at + 1);
        }
        assert_eq!(made.len(), wanted.len(), "{}", case.display());
    }
}

fn frames(case: &Path) -> Engine {
    let about: Json = serde_json::from_str(&read_to_string(case.join("case.json")).unwrap()).unwrap();
    Engine::Frame { frame_ms: about["frameMs"].as_u64().unwrap() }
}

#[test]
fn every_case_gives_what_is_expected_event_by_event() {
    check_all("expected-event.jsonl", |_| Engine::Event);
}

#[test]
fn every_case_gives_what_is_expected_frame_by_frame() {
    check_all("expected-frame.jsonl", frames);
}

#[test]
fn two_runs_are_equal_to_the_byte_compiled_or_not() {
    for case in cases() {
        for mode in [Engine::Event, frames(&case)] {
            let text = |lines: Vec<Json>| lines.iter().map(Json::to_string).collect::<Vec<_>>();
            let made = text(play(&case, mode, true));
            assert_eq!(made, text(play(&case, mode, true)));
            assert_eq!(made, text(play(&case, mode, false)), "also the sentences of faults");
        }
    }
}

#[test]
fn every_argument_name_works_in_a_procedure() {
    for case in lines(&gold().join("names.jsonl")) {
        let names: Vec<String> = serde_json::from_value(case["params"].clone()).unwrap();
        let inputs: Vec<Value> = serde_json::from_value(case["args"].clone()).unwrap();
        let body = case["body"].as_str().unwrap();
        assert_eq!(try_body(&[], &names, body, &inputs, &Limits::default()), Ok(Value::Int(4)), "{body}");
    }
}
