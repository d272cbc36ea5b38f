//! Measures looking back at one hour of 216,000 readings: opening it, moments, causes, an edited program, and its memory.
//! `cargo xtask bench past`; it fails if a bar is missed. Times are those of the processor.

#![expect(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark says what it measured, and may give up")]

#[path = "../../engine/benches/engine/clock.rs"]
#[allow(dead_code, reason = "another benchmark needs more of it")]
mod clock;

use behaviour::{AnyKnowledge, BehaviourFile};
use past::{EditedRun, Hook, Opening, Past};
use protocol::LaneName;
use sentences::Language;
use std::fmt::Write;
use std::process::ExitCode;
use std::rc::Rc;

/// Readings of one hour.
const READINGS: u64 = 216_000;
const HOUR_MS: u64 = 3_600_000;
/// The bars, in milliseconds of the processor.
const OPENED_MS: f64 = 1_000.0;
const SEEK_MS: f64 = 50.0;
const WHY_MS: f64 = 100.0;
const EDITED_MS: f64 = 1_500.0;
const PREVIEW_MS: f64 = 100.0;
/// The bar for what one hour takes on the server, in MiB.
const MEMORY_MIB: f64 = 60.0;
/// The number of moments and causes that are asked for.
const ASKED: u64 = 200;

/// Greets who is near, looks at the ball, and counts; `near` is how large a face has to be.
fn program(near: f64) -> BehaviourFile {
    let file = serde_json::json!({"format": "rrp-behaviour/1", "name": "Hour", "helpers": [],
        "streams": [
            {"id": "face", "kind": "sensor", "name": "Face", "device": "FaceDetection"},
            {"id": "ball", "kind": "sensor", "name": "Ball", "device": "RedBall"},
            {"id": "sonar", "kind": "sensor", "name": "Sonar", "device": "Sonar"},
            {"id": "size", "kind": "ordinary", "name": "Size"},
            {"id": "near", "kind": "ordinary", "name": "Near"},
            {"id": "rare", "kind": "ordinary", "name": "Rare"},
            {"id": "hello", "kind": "ordinary", "name": "Hello"},
            {"id": "where", "kind": "ordinary", "name": "Where"},
            {"id": "both", "kind": "ordinary", "name": "Both"},
            {"id": "sum", "kind": "ordinary", "name": "Sum"},
            {"id": "calm", "kind": "ordinary", "name": "Calm"},
            {"id": "say", "kind": "actuator", "name": "Say", "device": "SayInput"},
            {"id": "head", "kind": "actuator", "name": "Head", "device": "Tracker"}],
        "connectors": [
            {"id": "c1", "type": "map", "inputs": ["face"], "output": "size", "args": ["face"], "body": "face.size * 100.0"},
            {"id": "c2", "type": "filter", "inputs": ["size"], "output": "near", "args": ["size"], "body": format!("size > {near:?}")},
            {"id": "c3", "type": "sample", "inputs": ["near"], "output": "rare", "periodMs": 4_000},
            {"id": "c4", "type": "map", "inputs": ["rare"], "output": "hello", "args": ["near"], "body": "\"Hello \" + near"},
            {"id": "c5", "type": "subscribe", "inputs": ["hello"], "output": "say"},
            {"id": "c6", "type": "map", "inputs": ["ball"], "output": "where", "args": ["ball"], "body": "ball.x + ball.y"},
            {"id": "c7", "type": "combineLatest", "inputs": ["where", "sonar"], "output": "both", "args": ["a", "b"], "body": "a + b.left"},
            {"id": "c8", "type": "scan", "inputs": ["both"], "output": "sum", "args": ["m", "a"], "start": 0.0, "body": "m * 0.9 + a"},
            {"id": "c9", "type": "debounce", "inputs": ["near"], "output": "calm", "periodMs": 300},
            {"id": "c10", "type": "subscribe", "inputs": ["sum"], "output": "head"}]});
    serde_json::from_value(file).unwrap()
}

fn recording() -> String {
    let header = r#"{"format":"rrp-recording/2","behaviour":"b","name":"Hour","revision":1,"mode":"event","began":"2026-11-21T18:34:06Z","run":1}"#;
    let mut text = format!(
        "{header}\n{{\"t\":0,\"mark\":\"file\",\"revision\":1,\"file\":{}}}\n",
        recording::json(&program(40.0))
    );
    for at in 0..READINGS {
        let (t, wave) = (at * HOUR_MS / READINGS, (at as f64 / 977.0).sin());
        let written = match at % 6 {
            0 | 3 => writeln!(
                text,
                r#"{{"t":{t},"stream":"face","value":{{"size":{:?},"x":{wave:?},"y":0.25,"label":"Emma"}}}}"#,
                0.3 + wave / 5.0
            ),
            5 => writeln!(text, r#"{{"t":{t},"stream":"sonar","value":{{"left":{:?},"right":0.75}}}}"#, 1.0 + wave),
            _ => writeln!(
                text,
                r#"{{"t":{t},"stream":"ball","value":{{"x":{wave:?},"y":{:?},"size":0.1}}}}"#,
                wave / 3.0
            ),
        };
        written.unwrap();
    }
    writeln!(text, r#"{{"t":{HOUR_MS},"mark":"end","closed":{HOUR_MS},"late":0,"why":"it was stopped"}}"#).unwrap();
    text
}

fn hook() -> Hook {
    Rc::new(|| false)
}

fn open(text: &str) -> Past {
    let (header, lines) = recording::open(text).unwrap();
    // The bench makes readings alone: what was told is not recorded here.
    let mut opening = Opening::of(header, hook()).unwrap().without_actions();
    lines.entries().try_for_each(|entry| opening.take(entry)).unwrap();
    opening.finish("", None).unwrap()
}

/// The milliseconds of the processor that something takes.
fn cpu_ms(work: impl FnOnce()) -> f64 {
    clock::cpu_of(work) as f64 / 1e6
}

/// Moments all over the hour.
fn moments() -> impl Iterator<Item = u64> {
    (0..ASKED).map(|at| (at * 7_919 + 13) % ASKED * HOUR_MS / ASKED + at)
}

fn share_95(measured: Vec<f64>) -> f64 {
    clock::share(measured, 95, 100)
}

fn main() -> ExitCode {
    let text = recording();
    let before_kib = clock::memory_kib("self").unwrap_or(0);
    let mut past = None;
    let opened = cpu_ms(|| past = Some(open(&text)));
    let past = past.unwrap();
    let lanes: Vec<_> = ["size", "near", "both", "sum", "say", "head"]
        .map(|stream| LaneName { stream: stream.to_owned(), field: None })
        .to_vec();
    let drawn = cpu_ms(|| drop(past.lanes(&lanes, (0, HOUR_MS + 1), 500, &hook()).unwrap()));
    let seek = share_95(moments().map(|at| cpu_ms(|| drop(past.seek(at, &hook()).unwrap()))).collect());
    let traced = cpu_ms(|| past.trace(&hook()).unwrap());
    let why = |at: u64| {
        // The newest value of an action before the moment.
        let moment = past.seek(at.max(10_000), &hook()).unwrap();
        let head = moment.values.streams.iter().find(|one| one.stream.as_str() == "head").unwrap().at_ms;
        cpu_ms(|| drop(past.why(("head", head, 0), Language::English, &AnyKnowledge, &hook()).unwrap()))
    };
    let why = share_95(moments().map(why).collect());
    let edited = |from_ms| {
        let run = EditedRun::of(program(42.0), &hook()).unwrap();
        cpu_ms(|| drop(past.compare(None, run, from_ms, &["say".to_owned()], &hook()).unwrap()))
    };
    let (all, preview) = (edited(None), edited(Some(HOUR_MS - 120_000)));
    let took_kib = clock::memory_kib("self").unwrap_or(0).saturating_sub(before_kib);
    let memory = past.bytes() as f64 / f64::from(1 << 20);
    println!("opened {opened:.0} ms, first lanes {drawn:.1} ms, causes prepared {traced:.0} ms");
    println!("{memory:.1} MiB by its own count; the process grew by {} MiB while it worked", took_kib >> 10);
    let bars = [
        ("opened to first lanes", opened + drawn, OPENED_MS),
        ("seek, p95", seek, SEEK_MS),
        ("why, p95", why, WHY_MS),
        ("an hour through an edited program", all, EDITED_MS),
        ("two minutes through an edited program", preview, PREVIEW_MS),
        ("memory of an hour (MiB)", memory, MEMORY_MIB),
    ];
    for (what, measured, most) in bars {
        println!("{what}: {measured:.1}, at most {most}{}", if measured <= most { "" } else { "  MISSED" });
    }
    if bars.iter().all(|(_, measured, most)| measured <= most) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
