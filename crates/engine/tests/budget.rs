//! Tests where values multiply: a run ends at the same value everywhere, and Stop ends it before.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{BehaviourFile, Value};
use engine::{Emission, End, Limits, Run, StreamIx};
use robot::Millis;
use serde_json::json;
use std::cell::Cell;
use std::rc::Rc;

/// Makes so many diamonds in a row: each stream goes two ways, by these two bodies, that a merge leads together again.
fn diamonds(many: usize, first: &str, bodies: [&str; 2], mode: &serde_json::Value) -> BehaviourFile {
    let stream = |id: String, kind: &str| json!({"id": id, "kind": kind, "name": format!("Merged {id}")});
    let mut streams = vec![stream("ball".into(), "sensor"), stream("m0".into(), "ordinary")];
    let mut connectors = vec![match first {
        "sample" => json!({"id": "first", "type": "sample", "inputs": ["ball"], "output": "m0", "periodMs": 10}),
        _ => json!({"id": "first", "type": "merge", "inputs": ["ball"], "output": "m0"}),
    }];
    for at in 0..many {
        let [from, left, right, to] = [format!("m{at}"), format!("l{at}"), format!("r{at}"), format!("m{}", at + 1)];
        streams.extend([&left, &right, &to].map(|id| stream(id.clone(), "ordinary")));
        let mut way = |to: &str, body: &str| {
            let operation = if body.contains('>') { "filter" } else { "map" };
            let id = format!("to {to}");
            connectors.push(
                json!({"id": id, "type": operation, "inputs": [from], "output": to, "body": body, "args": ["v"]}),
            );
        };
        way(&left, bodies[0]);
        way(&right, bodies[1]);
        connectors.push(json!({"id": format!("to {to}"), "type": "merge", "inputs": [left, right], "output": to}));
    }
    let file = json!({"format": "rrp-behaviour/1", "name": "diamonds", "helpers": [], "engine": mode,
        "streams": streams, "connectors": connectors});
    serde_json::from_value(file).unwrap()
}

fn sixty(first: &str) -> BehaviourFile {
    diamonds(60, first, ["v + 1", "v"], &json!("event"))
}

fn build(file: &BehaviourFile, limits: Limits) -> Run {
    Run::build(file, limits).map_err(|faults| faults[0].to_string()).unwrap()
}

/// Returns the number of values that a reading and the time until 100 ms gave, and the last two.
fn play(run: &mut Run) -> (u64, [String; 2]) {
    let (mut count, mut last) = (0, [String::new(), String::new()]);
    let mut hear = |emission: Emission| {
        count += 1;
        last = [last[1].clone(), format!("{emission:?}")];
    };
    let ball = run.stream_index("ball").unwrap();
    run.feed(Millis(5), ball, Value::Int(1), &mut hear);
    run.until(Millis(100), &mut hear);
    (count, last)
}

#[test]
fn values_that_multiply_end_the_run_at_the_same_value_everywhere() {
    let mut run = build(&sixty("merge"), Limits::default());
    let told = play(&mut run);
    let at = run.stream_index("m15").unwrap();
    assert_eq!(run.ended(), Some(End::Multiplied { at: Millis(5), stream: at }));
    let fault = run.fault().unwrap().to_string();
    assert!(fault.starts_with("values multiply at “Merged m15”: one reading became more than 100,000"), "{fault}");
    assert!((50_000..110_000).contains(&told.0), "{}", told.0);
    let again = play(&mut run);
    assert_eq!(again.0, 0, "it takes and gives nothing more");
    assert_eq!((run.next_due(), run.ended().is_some()), (None, true));
    for compiled in [true, false] {
        let mut other = build(&sixty("merge"), Limits { compiled, ..Limits::default() });
        assert_eq!(play(&mut other), told, "compiled: {compiled}");
    }
    let mut later = build(&sixty("merge"), Limits::default());
    let ball = later.stream_index("l59").unwrap();
    later.feed(Millis(1), ball, Value::Int(1), &mut |_: Emission| {});
    assert_eq!(play(&mut later), told, "what came before changes nothing");
}

#[test]
fn a_tick_has_the_same_budget() {
    let mut run = build(&sixty("sample"), Limits::default());
    assert!(play(&mut run).0 > 50_000);
    let at = run.stream_index("m15").unwrap();
    assert_eq!(run.ended(), Some(End::Multiplied { at: Millis(10), stream: at }));
}

#[test]
fn ways_that_exclude_each_other_do_not_multiply() {
    let mut run = build(&diamonds(60, "merge", ["v > 1", "!(v > 1)"], &json!("event")), Limits::default());
    assert_eq!((play(&mut run).0, run.ended()), (2 + 60 * 2, None));
}

#[test]
fn a_frame_carries_one_value_a_stream() {
    let mut run = build(&diamonds(60, "merge", ["v + 1", "v"], &json!({"frame": {"frameMs": 20}})), Limits::default());
    assert_eq!((play(&mut run).0, run.ended()), (2 + 60 * 3, None));
}

#[test]
fn the_widest_graphs_that_may_be_made_stay_within() {
    let stream = |id: String, kind: &str| json!({"id": id, "kind": kind, "name": id});
    let mut streams = vec![stream("ball".into(), "sensor")];
    let mut connectors = Vec::new();
    for at in 0..1_998 {
        streams.push(stream(format!("s{at}"), "ordinary"));
        connectors.push(json!({"id": format!("c{at}"), "type": "map", "inputs": ["ball"], "output": format!("s{at}"),
            "body": "v + 1", "args": ["v"]}));
    }
    streams.push(stream("all".into(), "ordinary"));
    let inputs: Vec<_> = (0..1_998).map(|at| format!("s{at}")).collect();
    connectors.push(json!({"id": "m", "type": "merge", "inputs": inputs, "output": "all"}));
    for at in 0..10 {
        streams.push(stream(format!("t{at}"), "ordinary"));
        connectors
            .push(json!({"id": format!("d{at}"), "type": "merge", "inputs": ["all"], "output": format!("t{at}")}));
    }
    let file = json!({"format": "rrp-behaviour/1", "name": "wide", "helpers": [], "streams": streams,
        "connectors": connectors});
    let mut run = build(&serde_json::from_value(file).unwrap(), Limits::default());
    assert_eq!((play(&mut run).0, run.ended()), (1 + 1_998 * 12, None));
}

/// A hook that says yes at this question, and how often it was asked.
fn patient(questions: u32) -> (impl Fn() -> bool, Rc<Cell<u32>>) {
    let asked = Rc::new(Cell::new(0));
    let counter = asked.clone();
    let hook = move || {
        counter.set(counter.get() + 1);
        counter.get() >= questions
    };
    (hook, asked)
}

#[test]
fn stop_ends_values_on_their_way_at_the_question_that_it_answers() {
    for mode in [json!("event"), json!({"frame": {"frameMs": 20}})] {
        let many = if mode == json!("event") { 60 } else { 1_000 };
        let (hook, asked) = patient(3);
        let limits = Limits { handed: u64::MAX, ..Limits::default() }.stopped_by(hook);
        let mut run = build(&diamonds(many, "merge", ["v + 1", "v"], &mode), limits);
        let mut count = 0_u64;
        for at in 0..3 {
            run.feed(Millis(at * 100), StreamIx::of(0), Value::Int(1), &mut |_: Emission| count += 1);
            run.until(Millis(at * 100 + 50), &mut |_: Emission| count += 1);
        }
        assert_eq!((run.ended(), asked.get()), (Some(End::Stopped), 3), "{mode}");
        assert!(run.fault().is_none() && count < 4_000, "{mode}: {count}");
    }
}

#[test]
fn stop_is_asked_for_also_where_each_reading_takes_a_short_way() {
    let (hook, asked) = patient(2);
    let mut run = build(&diamonds(2, "merge", ["v + 1", "v"], &json!("event")), Limits::default().stopped_by(hook));
    let mut readings = 0;
    while run.ended().is_none() {
        run.feed(Millis(readings), StreamIx::of(0), Value::Int(1), &mut |_: Emission| {});
        readings += 1;
        assert!(readings < 1_000, "asked {} times", asked.get());
    }
    assert_eq!(asked.get(), 2);
}
