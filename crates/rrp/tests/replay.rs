//! `rrp replay` says the same, byte for byte, in every process: under another environment, from another folder, with
//! the streams, helpers and fields of the file in another order.

use serde_json::{Map, Value};
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

/// The same behaviour with its streams and helpers in another order. Connectors stay: their order has a meaning.
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
