//! `rrp replay` says the same, byte for byte, in every process: under another environment, from another folder, with
//! the streams, helpers and fields of the file in another order.

use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Orders that are tried for each case.
const SHUFFLES: u64 = 3;

/// The cases with a behaviour and a trace.
fn cases() -> Vec<PathBuf> {
    let gold = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/gold");
    let folder = std::fs::read_dir(gold).expect("the gold cases");
    let mut cases: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_dir()).collect();
    cases.sort();
    assert!(cases.len() >= 15, "the gold cases are all there");
    cases
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a text")
}

/// One process: its standard output.
fn replay(behaviour: &Path, trace: &Path, mode: &str, change: impl FnOnce(&mut Command)) -> Vec<u8> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
    command.args(["replay", "--probe", "--errors", "--arbitrate", "--mode", mode, "--behaviour"]).arg(behaviour);
    command.arg("--trace").arg(trace);
    change(&mut command);
    let done = command.output().expect("rrp starts");
    assert!(done.status.success(), "{}: {}", behaviour.display(), String::from_utf8_lossy(&done.stderr));
    assert!(!done.stdout.is_empty(), "{} says something", behaviour.display());
    done.stdout
}

/// Numbers by value, whole and measured kept apart, the text of faults ignored.
fn same(made: &Value, wanted: &Value) -> bool {
    match (made, wanted) {
        (Value::Number(a), Value::Number(b)) => a.is_f64() == b.is_f64() && (a == b || a.as_f64() == b.as_f64()),
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(name, a)| b.get(name).is_some_and(|b| name == "error" || same(a, b)))
        }
        (a, b) => a == b,
    }
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn every_gold_case_gives_what_is_expected_in_both_modes() {
    let mut more = 0;
    for case in cases() {
        let file = |name: &str| case.join(name).display().to_string();
        let about: Value = serde_json::from_str(&read(&case.join("case.json"))).expect("JSON");
        let (behaviour, trace) = (file("behaviour.json"), file("trace.jsonl"));
        let (until, frame_ms) = (about["until"].to_string(), about["frameMs"].to_string());
        let given = ["--probe", "--errors", "--behaviour", &behaviour, "--trace", &trace, "--until", &until];
        for (mode, rest) in [("event", vec![]), ("frame", vec!["--frame-ms", frame_ms.as_str()])] {
            let (code, made, _) = said(&[&given[..], &["--mode", mode], &rest].concat());
            let wanted = lines(&read(&case.join(format!("expected-{mode}.jsonl"))));
            let all = made.len() == wanted.len() && made.iter().zip(&wanted).all(|(made, wanted)| same(made, wanted));
            assert!(code == Some(0) && all, "{}, {mode}", case.display());
        }
        more += usize::from(case.file_name().is_some_and(|name| name.to_string_lossy().starts_with("more-")));
    }
    assert_eq!(more, 12, "also those of the connectors beyond the thesis");
}

#[test]
fn two_processes_say_the_same_to_the_byte() {
    let elsewhere = tempfile::tempdir().expect("a folder");
    for case in cases() {
        let (behaviour, trace) = (case.join("behaviour.json"), case.join("trace.jsonl"));
        for mode in ["event", "frame"] {
            let first = replay(&behaviour, &trace, mode, |_| {});
            // A long environment moves the stack; the system moves the rest of the memory by itself.
            let other = replay(&behaviour, &trace, mode, |command| {
                command.env_clear().env("LANG", "tr_TR.UTF-8").env("TZ", "Asia/Kathmandu");
                command.env("RRP_PADDING", "x".repeat(50_000)).current_dir(elsewhere.path());
            });
            assert!(first == other, "{}, {mode}", case.display());
        }
    }
}

#[test]
fn the_order_of_streams_helpers_and_fields_has_no_meaning() {
    let folder = tempfile::tempdir().expect("a folder");
    for (number, case) in cases().iter().enumerate() {
        let trace = case.join("trace.jsonl");
        let file: Value = serde_json::from_str(&read(&case.join("behaviour.json"))).expect("JSON");
        for mode in ["event", "frame"] {
            let wanted = replay(&case.join("behaviour.json"), &trace, mode, |_| {});
            for seed in 1..=SHUFFLES {
                let shuffled = folder.path().join(format!("{number}-{seed}.json"));
                std::fs::write(&shuffled, text(&another_order(&file, seed))).expect("written");
                let made = replay(&shuffled, &trace, mode, |_| {});
                assert!(made == wanted, "{}, {mode}, order {seed}", case.display());
            }
        }
    }
}

/// A behaviour that hands each value of `ball` to a device.
fn following(name: &str, device: &str, hold_ms: u64) -> Value {
    json!({"format": "rrp-behaviour/1", "name": name, "helpers": [], "streams": [
        {"id": "ball", "kind": "sensor", "name": "Ball"},
        {"id": "act", "kind": "actuator", "name": "Act", "device": device, "holdMs": hold_ms}],
        "connectors": [{"id": "c", "type": "subscribe", "inputs": ["ball"], "output": "act"}]})
}

/// One process with these arguments: its exit code, standard output and standard error.
fn said(arguments: &[&str]) -> (Option<i32>, Vec<Value>, String) {
    let done = Command::new(env!("CARGO_BIN_EXE_rrp")).arg("replay").args(arguments).output().expect("rrp starts");
    let lines = lines(&String::from_utf8(done.stdout).expect("UTF-8"));
    (done.status.code(), lines, String::from_utf8(done.stderr).expect("UTF-8"))
}

/// Puts a text into a folder; its path.
fn put(folder: &tempfile::TempDir, name: &str, text: &str) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, text).expect("written");
    path.display().to_string()
}

#[test]
fn of_several_behaviours_the_upper_one_holds_the_parts_that_the_catalogue_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let upper = put(&folder, "upper.json", &following("Safety", "Tracker", 1_000).to_string());
    let lower = put(&folder, "lower.json", &following("Idle", "SetJointPosition", 100).to_string());
    let readings: String =
        (0..12).map(|at| format!("{{\"t\":{},\"stream\":\"ball\",\"value\":1}}\n", at * 100)).collect();
    let shared = put(&folder, "shared.jsonl", &readings);
    let arguments = ["--arbitrate", "--behaviour", &upper, "--behaviour", &lower, "--trace", &shared];
    let (code, lines, complaints) = said(&arguments);
    assert_eq!((code, complaints.as_str(), lines.len()), (Some(0), "", 24));
    let held = json!({"t": 0, "behaviour": 2, "stream": "act", "value": 1, "suppressedBy": "act", "heldBy": 1});
    assert_eq!(lines[..2], [json!({"t": 0, "behaviour": 1, "stream": "act", "value": 1}), held]);
    let suppressed = |lines: &[Value]| lines.iter().filter(|line| line.get("suppressedBy").is_some()).count();
    assert_eq!(suppressed(&lines), 12, "all of the lower one");
    let other = ["--arbitrate", "--behaviour", &lower, "--behaviour", &upper, "--trace", &shared];
    assert_eq!(suppressed(&said(&other).1), 12, "the order counts, not the device");
    // A trace each: the upper one commands once, and lets go of the head a second later.
    let once = put(&folder, "once.jsonl", "{\"t\":50,\"stream\":\"ball\",\"value\":1}\n");
    let each = ["--arbitrate", "--behaviour", &upper, "--behaviour", &lower, "--trace", &once, "--trace", &shared];
    let (_, lines, _) = said(&each);
    let times: Vec<_> =
        lines.iter().filter(|line| line.get("heldBy").is_some()).map(|line| line["t"].clone()).collect();
    assert_eq!(times, (1..=10).map(|at| json!(at * 100)).collect::<Vec<_>>());
    let two = ["--behaviour", &upper, "--trace", &once, "--trace", &shared];
    let (code, _, complaints) = said(&two);
    assert_eq!(
        (code, complaints.as_str()),
        (Some(3), "2 traces for 1 behaviours; give one for all, or one for each\n")
    );
}

#[test]
fn values_that_multiply_end_a_replay_with_a_sentence_and_a_code() {
    let stream = |id: String, kind: &str| json!({"id": id, "kind": kind, "name": format!("Merged {id}")});
    let mut streams = vec![stream("m0".into(), "sensor"), json!({"id": "page", "kind": "actuator", "name": "Page"})];
    let mut connectors = Vec::new();
    for at in 0..60 {
        let [from, left, right, to] = [format!("m{at}"), format!("l{at}"), format!("r{at}"), format!("m{}", at + 1)];
        streams.extend([&left, &right, &to].map(|id| stream(id.clone(), "ordinary")));
        for way in [&left, &right] {
            connectors.push(json!({"id": way, "type": "timestamp", "inputs": [from], "output": way}));
        }
        connectors.push(json!({"id": to, "type": "merge", "inputs": [left, right], "output": to}));
    }
    connectors[1]["type"] = "merge".into();
    connectors.push(json!({"id": "show", "type": "subscribe", "inputs": ["m1"], "output": "page"}));
    for connector in &mut connectors {
        connector["id"] = format!("to {}", connector["id"]).into();
    }
    let file = json!({"format": "rrp-behaviour/1", "name": "Diamonds", "helpers": [], "streams": streams,
        "connectors": connectors});
    let folder = tempfile::tempdir().expect("a folder");
    let behaviour = put(&folder, "diamonds.json", &file.to_string());
    let trace = put(
        &folder,
        "trace.jsonl",
        "{\"t\":7,\"stream\":\"m0\",\"value\":1}\n{\"t\":9,\"stream\":\"m0\",\"value\":2}\n",
    );
    let (code, lines, complaint) = said(&["--errors", "--behaviour", &behaviour, "--trace", &trace]);
    assert_eq!(code, Some(4));
    assert!(complaint.starts_with("Diamonds: values multiply at “Merged m15”: one reading became more"), "{complaint}");
    let last = lines.last().expect("a line");
    assert_eq!((&last["t"], &last["stream"]), (&json!(7), &json!("m15")));
    assert!(last["error"].as_str().is_some_and(|error| complaint.contains(error)), "{last}");
    assert_eq!(said(&["--errors", "--behaviour", &behaviour, "--trace", &trace]), (code, lines, complaint));
    let frames = said(&["--mode", "frame", "--behaviour", &behaviour, "--trace", &trace]);
    assert_eq!((frames.0, frames.1.len()), (Some(0), 1), "a frame carries one value a stream");
}

/// A behaviour with its streams and helpers in another order. Connectors stay: their order has a meaning.
fn another_order(file: &Value, seed: u64) -> Value {
    let mut file = file.clone();
    for name in ["streams", "helpers"] {
        if let Some(list) = file.get_mut(name).and_then(Value::as_array_mut) {
            shuffle(list, seed);
        }
    }
    file
}

fn shuffle(list: &mut [Value], seed: u64) {
    let mut state = seed;
    for at in (1..list.len()).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let other = usize::try_from(state >> 33).unwrap_or(0) % (at + 1);
        list.swap(at, other);
    }
}

/// The text of a file with the fields of every object from last to first.
fn text(value: &Value) -> String {
    match value {
        Value::Object(fields) => object(fields),
        Value::Array(items) => format!("[{}]", items.iter().map(text).collect::<Vec<_>>().join(",")),
        other => other.to_string(),
    }
}

fn object(fields: &Map<String, Value>) -> String {
    let field = |(name, value): (&String, &Value)| format!("{}:{}", Value::from(name.as_str()), text(value));
    format!("{{{}}}", fields.iter().rev().map(field).collect::<Vec<_>>().join(","))
}
