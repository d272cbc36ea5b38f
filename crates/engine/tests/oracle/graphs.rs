//! Random valid behaviours and random readings for them.

use crate::chance::Chance;
use behaviour::{BehaviourFile, StreamKind, Value};
use serde_json::{Value as Json, json};

/// A reading of a trace.
pub(crate) struct Reading {
    pub(crate) at: u64,
    pub(crate) stream: usize,
    pub(crate) value: Value,
}

const MAPS: [&str; 14] = [
    "a + 1",
    "a * 2 - 3",
    "a / 3",
    "7 % a",
    "-a",
    "if a > 3 { a - 1 } else { a + 0.5 }",
    "#{x: a, y: 2}",
    "a.x",
    "a.x + a.y",
    "[a, 1][-2]",
    "let b = a * a; b - a",
    "let n = 0; for i in 0..3 { n += i; } n + a",
    "abs(a) + max(a, 2)",
    "twice(a) + 0.1",
];
const FILTERS: [&str; 7] =
    ["a > 2", "a == 3 || a < 0", "a != 1 && a <= 5", "!(a >= 4)", "a.x > 1", "a", "twice(a) < 9"];
const KEYS: [&str; 5] = ["a", "a % 3", "a.x", "if a > 2 { 1 } else { 1.0 }", "[a, #{v: a}]"];
const SCANS: [&str; 6] = [
    "m + a",
    "max(m, a)",
    "if a > 3 { m } else { a }",
    "[m, 7 % a][1]",
    "#{x: a, y: m.x}",
    "if m == 2 { 0 } else { m + 1 }",
];
const COMBINES: [&str; 6] = ["a + b", "a - b", "#{x: a, y: b}", "if a < b { a } else { b }", "a / b", "min(a, b)"];

/// A behaviour of 1 to 3 sensors and up to 12 connectors.
pub(crate) fn behaviour(chance: &mut Chance) -> BehaviourFile {
    let mut streams: Vec<Json> = (0..=chance.below(3)).map(|at| stream(&format!("s{at}"), "sensor")).collect();
    let mut connectors = Vec::new();
    let mut sources: Vec<String> = streams.iter().map(|stream| stream["id"].as_str().unwrap().to_owned()).collect();
    for at in 0..=chance.below(9) {
        let output = format!("o{at}");
        connectors.push(connector(chance, &sources, &output));
        streams.push(stream(&output, "ordinary"));
        sources.push(output);
    }
    for at in 0..=chance.below(2) {
        let output = format!("a{at}");
        for _ in 0..=chance.below(2) {
            let input = chance.pick(&sources);
            connectors.push(json!({"type": "subscribe", "inputs": [input], "output": output}));
        }
        streams.push(stream(&output, "actuator"));
    }
    chance.shuffle(&mut streams);
    chance.shuffle(&mut connectors);
    for (at, connector) in connectors.iter_mut().enumerate() {
        connector["id"] = format!("c{at}").into();
    }
    let twice = json!({"name": "twice", "params": ["v"], "body": "v + v"});
    let helpers = json!([twice, {"name": "sum", "params": ["v", "w"], "body": "twice(v) + w"}]);
    let file = json!({
        "format": "rrp-behaviour/1", "name": "", "streams": streams, "connectors": connectors, "helpers": helpers,
    });
    serde_json::from_value(file).unwrap()
}

fn stream(id: &str, kind: &str) -> Json {
    json!({"id": id, "kind": kind, "name": id})
}

fn connector(chance: &mut Chance, sources: &[String], output: &str) -> Json {
    let one = [chance.pick(sources)];
    let many = some_of(chance, sources);
    let period = 1 + chance.below(80);
    match chance.below(14) {
        0..=2 => json!({"type": "map", "inputs": one, "output": output, "args": ["a"], "body": chance.pick(&MAPS)}),
        3 => json!({"type": "filter", "inputs": one, "output": output, "args": ["a"], "body": chance.pick(&FILTERS)}),
        4 => json!({"type": "timestamp", "inputs": one, "output": output}),
        5 => json!({"type": "sample", "inputs": one, "output": output, "periodMs": period}),
        6 => json!({"type": "merge", "inputs": many, "output": output}),
        7 => distinct(chance, &one, output),
        8 => scan(chance, &one, output),
        9 => json!({"type": "debounce", "inputs": one, "output": output, "periodMs": period}),
        10 => json!({"type": "delay", "inputs": one, "output": output, "periodMs": period}),
        11 if many.len() > 1 => combine(chance, "withLatest", &many, output),
        _ => combine(chance, "combineLatest", &many, output),
    }
}

fn distinct(chance: &mut Chance, one: &[String; 1], output: &str) -> Json {
    let mut connector = json!({"type": "distinct", "inputs": one, "output": output});
    match chance.below(3) {
        0 => {
            connector["args"] = json!(["a"]);
            connector["body"] = chance.pick(&KEYS).into();
        }
        1 => {
            connector["args"] = json!(["a"]);
            connector["helper"] = "twice".into();
        }
        _ => {}
    }
    connector
}

fn scan(chance: &mut Chance, one: &[String; 1], output: &str) -> Json {
    let mut connector = json!({"type": "scan", "inputs": one, "output": output, "args": ["m", "a"]});
    match chance.below(4) {
        0 => connector["helper"] = "sum".into(),
        _ => connector["body"] = chance.pick(&SCANS).into(),
    }
    match chance.below(4) {
        0 => {}
        1 => connector["start"] = json!({"x": 0.5}),
        2 => connector["start"] = json!(0.1),
        _ => connector["start"] = json!(chance.below(5)),
    }
    connector
}

fn combine(chance: &mut Chance, word: &str, inputs: &[String], output: &str) -> Json {
    let args = &["a", "b", "c"][..inputs.len()];
    let mut connector = json!({"type": word, "inputs": inputs, "output": output, "args": args});
    match (inputs.len(), chance.below(4)) {
        (1, _) => connector["helper"] = "twice".into(),
        (2, 0) => connector["helper"] = "sum".into(),
        (2, _) => connector["body"] = chance.pick(&COMBINES).into(),
        _ => connector["body"] = "a + b - c".into(),
    }
    connector
}

/// 1 to 3 different ones.
fn some_of(chance: &mut Chance, sources: &[String]) -> Vec<String> {
    let mut some = sources.to_vec();
    chance.shuffle(&mut some);
    some.truncate(1 + chance.index(3));
    some
}

/// Many behaviours side by side that hear the same senses: so many connectors at least.
#[allow(dead_code, reason = "not every test has large ones")]
pub(crate) fn large(chance: &mut Chance, least: usize) -> BehaviourFile {
    let mut all = behaviour(chance);
    let senses: Vec<String> = all.streams.iter().filter(|one| one.kind == StreamKind::Sensor).map(|one| one.id.clone()).collect();
    for part in 1.. {
        if all.connectors.len() >= least {
            break;
        }
        let other = behaviour(chance);
        let is_sense = |id: &str| other.streams.iter().any(|one| one.id == id && one.kind == StreamKind::Sensor);
        let mut renamed = |id: &str| {
            if is_sense(id) { chance.pick(&senses) } else { format!("{id}of{part}") }
        };
        for mut connector in other.connectors.clone() {
            connector.id = format!("{}of{part}", connector.id);
            connector.output = renamed(&connector.output);
            connector.inputs.iter_mut().for_each(|input| *input = renamed(input));
            all.connectors.push(connector);
        }
        for mut stream in other.streams.iter().filter(|one| one.kind != StreamKind::Sensor).cloned() {
            stream.id = renamed(&stream.id);
            all.streams.push(stream);
        }
    }
    all
}

/// So many readings, often at one instant.
pub(crate) fn trace(chance: &mut Chance, file: &BehaviourFile, readings: usize) -> Vec<Reading> {
    let sensors = file.streams.iter().enumerate().filter(|(_, stream)| stream.kind == StreamKind::Sensor);
    let sensors: Vec<usize> = sensors.map(|(at, _)| at).collect();
    let mut at = 0;
    let reading = |_| {
        at += chance.pick(&[0, 0, 1, 3, 10, 25, 50]);
        Reading { at, stream: chance.pick(&sensors), value: value(chance) }
    };
    (0..readings).map(reading).collect()
}

fn value(chance: &mut Chance) -> Value {
    let small = i64::try_from(chance.below(12)).unwrap() - 4;
    match chance.below(12) {
        0 => Value::Float(small as f64 * 0.7),
        1 => Value::object([("x", Value::Int(small)), ("y", Value::Float(0.25))]),
        2 => {
            chance.pick(&[Value::Null, Value::Bool(true), Value::Bool(false), Value::text("red"), Value::Int(i64::MAX)])
        }
        _ => Value::Int(small),
    }
}
