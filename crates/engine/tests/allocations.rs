//! Numbers flow through a running graph without a single allocation.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{BehaviourFile, Value};
use engine::{Emission, Limits, Run};
use robot::Millis;

/// Events before the count: what is made once is made then.
const WARM_UP: u64 = 100;
const EVENTS: u64 = 10_000;

/// Connectors as `type inputs > output: body`; the sensors are `ball` and `hand`, streams are what outputs say.
fn run(connectors: &[(&str, &[&str], &str, Option<&str>)]) -> Run {
    let stream = |id: &str, kind: &str| serde_json::json!({"id": id, "kind": kind, "name": id});
    let mut streams = vec![stream("ball", "sensor"), stream("hand", "sensor")];
    let mut made = Vec::new();
    for (at, (operation, inputs, output, body)) in connectors.iter().enumerate() {
        let kind = if *operation == "subscribe" { "actuator" } else { "ordinary" };
        streams.push(stream(output, kind));
        let mut one =
            serde_json::json!({"id": format!("c{at}"), "type": operation, "inputs": inputs, "output": output});
        match (*operation, body) {
            ("sample", _) => one["periodMs"] = 5.into(),
            (_, Some(body)) => one["body"] = (*body).into(),
            (_, None) => {}
        }
        made.push(one);
    }
    let file = serde_json::json!({
        "format": "rrp-behaviour/1", "name": "numbers", "helpers": [], "streams": streams, "connectors": made,
    });
    let file: BehaviourFile = serde_json::from_value(file).unwrap();
    Run::build(&file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap()
}

/// Allocations during many events after some, and how many values came out of the last stream.
fn count(mut run: Run, value: fn(u64) -> Value) -> (u64, u64) {
    let (ball, hand) = (run.stream_index("ball").unwrap(), run.stream_index("hand").unwrap());
    let (last, mut out) = (run.streams().len() - 1, 0);
    let mut play = |from: u64, to: u64| {
        for t in from..to {
            let mut hear = |emission: Emission| match emission {
                Emission::Value { stream, .. } => out += u64::from(stream.index() == last),
                Emission::Fault { error, .. } => panic!("{error}"),
            };
            run.feed(Millis(t), if t % 2 == 0 { ball } else { hand }, value(t), &mut hear);
            run.until(Millis(t), &mut hear);
        }
    };
    play(0, WARM_UP);
    let counted = allocation_counter::measure(|| play(WARM_UP, WARM_UP + EVENTS));
    (counted.count_total, out)
}

fn int(t: u64) -> Value {
    Value::Int(i64::try_from(t % 1_000).unwrap())
}

fn float(t: u64) -> Value {
    Value::Float((t % 1_000) as f64 / 8.0)
}

#[test]
fn numbers_flow_without_allocations() {
    let graph: &[(&str, &[&str], &str, Option<&str>)] = &[
        ("map", &["ball"], "near", Some("if ball > 10 { ball * 2 } else { ball - 1 }")),
        ("map", &["near"], "scaled", Some("let y = near + 1; y * 3 - near % 7")),
        ("filter", &["scaled"], "good", Some("scaled > -100 && !(scaled == 5)")),
        ("merge", &["good", "hand"], "both", None),
        ("combineLatest", &["both", "near"], "pair", Some("both + near")),
        ("sample", &["pair"], "calm", None),
        ("map", &["calm"], "angle", Some("calm / 100")),
        ("subscribe", &["angle"], "head", None),
    ];
    for value in [int, float] {
        let (allocations, out) = count(run(graph), value);
        assert!(out > EVENTS / 10, "values come out: {out}");
        assert_eq!(allocations, 0);
    }
}

#[test]
fn a_text_is_counted() {
    let graph: &[(&str, &[&str], &str, Option<&str>)] = &[("map", &["ball"], "said", Some("`at ${ball}`"))];
    let (allocations, _) = count(run(graph), int);
    assert!(allocations > 0, "the counter counts");
}
