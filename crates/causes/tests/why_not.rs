//! Why nothing came: 500 programs in which one connector is made to keep everything back, between others that pass everything
//! on. It is named first, with the value that it kept and the reason.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

#[path = "../../engine/tests/oracle/chance.rs"]
mod chance;

use behaviour::{BehaviourFile, Value};
use causes::Traced;
use chance::Chance;
use engine::{Limits, Run};
use protocol::{Because, BlockedConnector};
use robot::Millis;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

const CASES: u64 = 500;
/// The stretch that is asked about: long after the first readings, and over before anything that waits is due.
const FROM: u64 = 1_000;
const UNTIL: u64 = 1_950;
/// The last reading.
const LAST: u64 = 1_900;

/// One that keeps everything back: its operation, with its other input if it has one, and why.
const BLOCKERS: [(&str, &str, Because); 10] = [
    (r#"{"type":"filter","args":["a"],"body":"a < 0"}"#, "", Because::Kept),
    (r#"{"type":"distinct","args":["a"],"body":"0"}"#, "", Because::Kept),
    (r#"{"type":"map","args":["a"],"body":"a.x"}"#, "", Because::Fault),
    (r#"{"type":"filter","args":["a"],"body":"a + 1"}"#, "", Because::Fault),
    (r#"{"type":"scan","args":["m","a"],"body":"m + a","start":true}"#, "", Because::Fault),
    (r#"{"type":"combineLatest","args":["a","b"],"body":"a"}"#, "silent", Because::Waits),
    (r#"{"type":"withLatest","args":["a","b"],"body":"a"}"#, "silent", Because::Waits),
    (r#"{"type":"debounce","periodMs":400}"#, "", Because::Waits),
    (r#"{"type":"delay","periodMs":5000}"#, "", Because::Waits),
    (r#"{"type":"sample","periodMs":9000}"#, "", Because::Waits),
];
/// Others that pass on every value, one more or as it is.
const PASSING: [&str; 5] = [
    r#"{"type":"map","args":["a"],"body":"a + 1"}"#,
    r#"{"type":"filter","args":["a"],"body":"a > -100"}"#,
    r#"{"type":"merge"}"#,
    r#"{"type":"distinct"}"#,
    r#"{"type":"map","args":["a"],"body":"a"}"#,
];

/// A program being made, as a chain.
struct Chain {
    streams: Vec<Json>,
    connectors: Vec<Json>,
    last: String,
}

impl Chain {
    fn of() -> Self {
        let sensor = |id: &str| json!({"id": id, "kind": "sensor", "name": id});
        Self { streams: vec![sensor("ball"), sensor("silent")], connectors: Vec::new(), last: "ball".to_owned() }
    }

    /// Adds a connector, and tells its id.
    fn add(&mut self, operation: &str, other: &str, kind: &str) -> String {
        let mut connector: Json = serde_json::from_str(operation).unwrap();
        let (id, output) = (format!("c{}", self.connectors.len()), format!("o{}", self.connectors.len()));
        let inputs: Vec<&str> = [self.last.as_str(), other].into_iter().filter(|input| !input.is_empty()).collect();
        connector["inputs"] = json!(inputs);
        connector["id"] = json!(id);
        connector["output"] = json!(output);
        self.connectors.push(connector);
        self.streams.push(json!({"id": output, "kind": kind, "name": output}));
        self.last = output;
        id
    }

    /// Adds some that pass everything on, and tells by how much they raise a number.
    fn passing(&mut self, chance: &mut Chance) -> i64 {
        let mut raised = 0;
        for _ in 0..chance.below(5) {
            let at = chance.index(PASSING.len());
            self.add(PASSING[at], "", "ordinary");
            raised += i64::from(at == 0);
        }
        raised
    }
}

/// The answer for a program that is fed these readings.
fn blocked(chain: &Chain, engine: &Json, readings: &[(u64, i64)]) -> Vec<BlockedConnector> {
    let file = json!({
        "format": "rrp-behaviour/1", "name": "", "helpers": [], "engine": engine,
        "streams": chain.streams, "connectors": chain.connectors,
    });
    let file: BehaviourFile = serde_json::from_value(file).unwrap();
    let run = Run::build(&file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let (ball, action) = (run.stream_index("ball").unwrap(), run.stream_index(&chain.last).unwrap());
    let mut traced = Traced::of(file, run);
    let mut came = |cause: &std::sync::Arc<causes::Cause>| {
        assert!(cause.stream() != action || cause.at().0 < FROM, "the action came");
    };
    for (at, value) in readings {
        traced.feed(Millis(*at), ball, Value::Int(*value), &mut came);
    }
    traced.until(Millis(UNTIL), &mut came);
    let told = traced.why_not(action, Millis(FROM));
    assert_eq!(told.stream, chain.last);
    told.blocked
}

#[test]
fn the_connector_that_keeps_everything_back_is_named_first() {
    let mut tried: BTreeMap<String, u64> = BTreeMap::new();
    for seed in 0..CASES {
        let mut chance = Chance::of(seed);
        let (operation, other, because) = BLOCKERS[chance.index(BLOCKERS.len())];
        let engine = chance.pick(&[json!("event"), json!({"frame": {"frameMs": 50}})]);
        let mut chain = Chain::of();
        let raised = chain.passing(&mut chance);
        let stream = chain.last.clone();
        let connector = chain.add(operation, other, "ordinary");
        chain.passing(&mut chance);
        chain.add(r#"{"type":"subscribe"}"#, "", "actuator");
        chance.shuffle(&mut chain.connectors);
        let readings: Vec<(u64, i64)> = (0..20).map(|at| (at * 100, at as i64)).collect();
        let told = blocked(&chain, &engine, &readings);
        let wanted = BlockedConnector { connector, stream, t: Some(LAST), value: Value::Int(19 + raised), because };
        assert_eq!(told.first(), Some(&wanted), "seed {seed}, {engine}");
        // One that waits for another input is not all: nothing came from there.
        let missing = told.get(1).map(|missing| (missing.stream.as_str(), missing.because));
        assert_eq!(missing, (!other.is_empty()).then_some((other, Because::Nothing)), "seed {seed}");
        *tried.entry(format!("{operation} {engine}")).or_default() += 1;
    }
    assert!(tried.len() == 2 * BLOCKERS.len() && tried.values().all(|times| *times >= 10), "{tried:?}");
}

#[test]
fn where_nothing_was_sensed_the_first_connector_says_so() {
    for seed in 0..100 {
        let mut chance = Chance::of(seed);
        let mut chain = Chain::of();
        chain.passing(&mut chance);
        chain.add(r#"{"type":"subscribe"}"#, "", "actuator");
        let told = blocked(&chain, &json!("event"), &[(0, 1), (100, 2)]);
        let nothing = BlockedConnector {
            connector: "c0".to_owned(),
            stream: "ball".to_owned(),
            t: None,
            value: Value::Null,
            because: Because::Nothing,
        };
        assert_eq!(told, [nothing], "seed {seed}");
    }
}

#[test]
fn a_value_that_waits_since_before_keeps_the_action_waiting() {
    let mut chain = Chain::of();
    let connector = chain.add(r#"{"type":"delay","periodMs":5000}"#, "", "ordinary");
    chain.add(r#"{"type":"subscribe"}"#, "", "actuator");
    let told = blocked(&chain, &json!("event"), &[(700, 7), (800, 8)]);
    let waits = BlockedConnector {
        connector,
        stream: "ball".to_owned(),
        t: Some(700),
        value: Value::Int(7),
        because: Because::Waits,
    };
    assert_eq!(told, [waits], "the one that comes next");
}

#[test]
fn a_run_that_goes_on_knows_what_was_known_and_since_when() {
    let file = json!({
        "format": "rrp-behaviour/1", "name": "", "helpers": [],
        "streams": [{"id": "a", "kind": "sensor", "name": "a"}, {"id": "b", "kind": "sensor", "name": "b"},
            {"id": "o", "kind": "ordinary", "name": "o"}],
        "connectors": [{"id": "c", "type": "combineLatest", "inputs": ["a", "b"], "output": "o", "args": ["a", "b"], "body": "a + b"}],
    });
    let file: BehaviourFile = serde_json::from_value(file).unwrap();
    let build = || Run::build(&file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let mut before = build();
    let (a, b) = (before.stream_index("a").unwrap(), before.stream_index("b").unwrap());
    before.feed(Millis(700), b, Value::Int(3), &mut |_| {});
    before.until(Millis(999), &mut |_| {});
    let mut traced = Traced::of(file.clone(), build());
    traced.resume(before.handover());
    let mut last = None;
    traced.feed(Millis(1_200), a, Value::Int(4), &mut |cause| last = Some(cause.clone()));
    let told = traced.tracer().tell(&last.unwrap());
    let known = protocol::WhyWith::Value { stream: "b".to_owned(), t: 700, value: Value::Int(3) };
    assert_eq!((told.value, told.steps[0].with.clone()), (Value::Int(7), vec![known]));
}
