//! Runs of behaviours, as the lines that `rrp replay` would print: the gold cases, one full of numbers, random ones.

use crate::chance::Chance;
use crate::graphs;
use behaviour::{BehaviourFile, Engine, StreamKind, Value};
use engine::{Emission, Limits, Run, StreamIx};
use robot::Millis;
use serde_json::{Value as Json, json};

/// The readings of a random behaviour.
const READINGS: usize = 40;

/// A behaviour and its readings.
type Case = (&'static str, &'static str);

macro_rules! gold {
    ($name:literal) => {
        (
            include_str!(concat!("../../gold/", $name, "/behaviour.json")),
            include_str!(concat!("../../gold/", $name, "/trace.jsonl")),
        )
    };
}

const GOLD: [Case; 27] = [
    gold!("4.13-reflect-ball-color"),
    gold!("4.14-say-ball-color"),
    gold!("4.15-say-ball-color-merge"),
    gold!("4.16-distance-to-brightness"),
    gold!("4.17-track-far-close"),
    gold!("4.18-greeter"),
    gold!("4.19-tracking-with-the-bug"),
    gold!("4.20-tracking-fixed"),
    gold!("err-1-drop-and-go-on"),
    gold!("tie-1-input-before-tick"),
    gold!("tie-2-sample-100-100"),
    gold!("tie-2-sample-100-50"),
    gold!("tie-2-sample-50-100"),
    gold!("tie-3-diamond"),
    gold!("tie-4-same-instant"),
    gold!("more-1-distinct-int-float"),
    gold!("more-2-distinct-lists-objects"),
    gold!("more-3-distinct-procedure-fault"),
    gold!("more-4-scan-start-and-fault"),
    gold!("more-5-scan-names-and-null"),
    gold!("more-6-debounce-tie"),
    gold!("more-7-debounce-behind-sample"),
    gold!("more-8-delay-order"),
    gold!("more-9-ticks-by-rank"),
    gold!("more-10-with-latest"),
    gold!("more-11-with-latest-diamond"),
    gold!("more-12-frame-origins"),
];
/// What a machine could compute otherwise than another one: `x` is a measured number.
const NUMBERS: [&str; 12] = [
    "sin(x) + cos(x) * tan(x)",
    "exp(x / 9.0) - ln(x + 3.0)",
    "x ** 0.37 + 2.0 ** x",
    "let y = x; y **= 1.7; y",
    "atan(x, 0.3) + hypot(x, 1.7) + log(x, 3.0)",
    "sinh(x / 9.0) + acosh(x + 1.5) + atanh(0.9 / (x + 1.0))",
    "x % 0.7 + x.floor() - x.round()",
    "`${x / 3.0} ${x * 1e20} ${[x, 1, #{a: x}]}`",
    "[x, 2.0, 1, 0.5].map(|v| v * x).reduce(|a, v| a + v)",
    "let l = [3.5, x, 1.25]; l.sort(); l",
    "0.1 + 0.2 == 0.3 && x / 3.0 * 3.0 == x",
    "parse_float(`${x}`) - x",
];
/// How many of the cases are not random.
pub const FIXED: u32 = GOLD.len() as u32 + 1;

/// What a case says, in event mode (0) or in frames of that many milliseconds. The cases after [`FIXED`] are random.
pub fn said(case: u32, frame_ms: u32) -> Vec<u8> {
    let at = case as usize;
    let (mut file, readings) = match GOLD.get(at) {
        Some(case) => gold(case),
        None if case + 1 == FIXED => numbers(),
        None => random(case),
    };
    file.engine = Some(if frame_ms == 0 { Engine::Event } else { Engine::Frame { frame_ms: frame_ms.into() } });
    play(&file, &readings)
}

/// A time, a stream and a value.
type Reading = (u64, String, Value);

fn gold((behaviour, trace): &Case) -> (BehaviourFile, Vec<Reading>) {
    let reading = |line: &str| {
        let line: Json = serde_json::from_str(line).expect("a reading");
        let value = serde_json::from_value(line["value"].clone()).expect("a value");
        (line["t"].as_u64().expect("a time"), line["stream"].as_str().expect("a stream").to_owned(), value)
    };
    (serde_json::from_str(behaviour).expect("a behaviour"), trace.lines().map(reading).collect())
}

fn numbers() -> (BehaviourFile, Vec<Reading>) {
    let stream = |id: &str, kind: &str| json!({"id": id, "kind": kind, "name": id});
    let mut streams = vec![stream("x", "sensor")];
    let mut connectors = Vec::new();
    for (at, body) in NUMBERS.iter().enumerate() {
        streams.push(stream(&format!("o{at}"), "ordinary"));
        let output = format!("o{at}");
        connectors
            .push(json!({"id": format!("c{at}"), "type": "map", "inputs": ["x"], "output": output, "body": body}));
    }
    let file = json!({
        "format": "rrp-behaviour/1", "name": "Numbers", "helpers": [], "streams": streams, "connectors": connectors,
    });
    let readings = (0..60_u64).map(|at| (at * 10, "x".to_owned(), Value::Float(0.013 + at as f64 * 0.271)));
    (serde_json::from_value(file).expect("a behaviour"), readings.collect())
}

fn random(seed: u32) -> (BehaviourFile, Vec<Reading>) {
    let mut chance = Chance::of(seed.into());
    let file = graphs::behaviour(&mut chance);
    let named = |reading: graphs::Reading| (reading.at, file.streams[reading.stream].id.clone(), reading.value);
    let readings = graphs::trace(&mut chance, &file, READINGS).into_iter().map(named).collect();
    (file, readings)
}

fn play(file: &BehaviourFile, readings: &[Reading]) -> Vec<u8> {
    let mut run = Run::build(file, Limits::default()).unwrap_or_else(|faults| panic!("{}", faults[0]));
    let streams: Vec<_> = file.streams.iter().map(|stream| stream.id.clone()).collect();
    let mut lines = String::new();
    let mut note = |emission: Emission| {
        let line = match emission {
            Emission::Value { at, stream, value, .. } => {
                json!({"t": at.0, "stream": streams[stream.index()], "value": value})
            }
            Emission::Fault { at, connector, error, .. } => {
                json!({"t": at.0, "connector": connector.index(), "error": error.to_string()})
            }
        };
        lines.push_str(&line.to_string());
        lines.push('\n');
    };
    for (at, stream, value) in readings {
        let stream = file.streams.iter().position(|known| known.id == *stream && known.kind == StreamKind::Sensor);
        run.feed(Millis(*at), StreamIx::of(stream.expect("a sensor")), value.clone(), &mut note);
    }
    run.finish(Millis(readings.last().map_or(0, |last| last.0) + 200), &mut note);
    lines.into_bytes()
}
