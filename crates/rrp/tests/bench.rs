//! `rrp bench`: one line of JSON about how fast a behaviour runs.

use serde_json::Value;
use std::process::{Command, Output};

fn gold(file: &str) -> String {
    format!("{}/../../tests/gold/4.20-tracking-fixed/{file}", env!("CARGO_MANIFEST_DIR"))
}

fn bench(words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
    command.arg("bench").args(words).output().expect("rrp starts")
}

/// The one line that it prints for the tracking graph, with further words.
fn measured(words: &[&str]) -> Value {
    let (behaviour, trace) = (gold("behaviour.json"), gold("trace.jsonl"));
    let said = bench(&[&["--behaviour", &behaviour, "--trace", &trace], words].concat());
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let text = String::from_utf8(said.stdout).expect("UTF-8");
    assert_eq!(text.lines().count(), 1, "{text}");
    serde_json::from_str(&text).expect("one line of JSON")
}

#[test]
fn it_prints_one_line_with_numbers_that_make_sense() {
    let readings = std::fs::read_to_string(gold("trace.jsonl")).expect("a trace").lines().count() as u64;
    for words in [&["--repeat", "20"][..], &["--repeat", "20", "--interpreted"]] {
        let measured = measured(words);
        let mut names: Vec<_> = measured.as_object().expect("an object").keys().map(String::as_str).collect();
        names.sort_unstable();
        assert_eq!(names, ["build_us", "cpu_s", "events", "p50_ns", "p99_ns", "rss_kib"]);
        assert_eq!(measured["events"].as_u64(), Some(20 * readings));
        let number = |name: &str| measured[name].as_f64().expect("a number");
        assert!(number("cpu_s") >= 0.0 && number("build_us") > 0.0, "{measured}");
        assert!(number("p50_ns") > 0.0 && number("p50_ns") <= number("p99_ns"), "{measured}");
        assert!(measured["rss_kib"].is_null() || number("rss_kib") > 0.0, "{measured}");
    }
}

#[test]
fn what_cannot_be_measured_is_refused_with_a_sentence() {
    let room = tempfile::tempdir().expect("a folder");
    let empty = room.path().join("empty.jsonl");
    std::fs::write(&empty, "\n").expect("written");
    let (behaviour, empty) = (gold("behaviour.json"), empty.display().to_string());
    let nowhere = room.path().join("nowhere.json").display().to_string();
    for (behaviour, code, sentence) in [(behaviour, 3, "the trace has no readings"), (nowhere, 2, "nowhere.json")] {
        let said = bench(&["--behaviour", &behaviour, "--trace", &empty]);
        assert_eq!(said.status.code(), Some(code));
        assert!(String::from_utf8_lossy(&said.stderr).contains(sentence), "{said:?}");
    }
}
