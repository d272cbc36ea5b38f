//! The rules E1 to E8 and F1 to F5 that the gold cases leave open, and what is refused.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{BehaviourFile, Value};
use engine::{CallFault, ConnectorIx, Emission, Limits, Run, StreamIx, validate};
use robot::Millis;
use std::cell::Cell;
use std::rc::Rc;

/// A behaviour from lines: `name kind` is a stream (its id is its name), `type inputs > output: body` a connector.
fn graph(text: &str) -> BehaviourFile {
    let (mut streams, mut connectors) = (Vec::new(), Vec::new());
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some((left, right)) = line.split_once(" > ") {
            let (operation, inputs) = left.split_once(' ').unwrap_or((left, ""));
            let (output, body) = right.split_once(": ").map_or((right, None), |(output, body)| (output, Some(body)));
            let inputs: Vec<_> = inputs.split_whitespace().collect();
            let id = format!("c{}", connectors.len() + 1);
            let mut connector = serde_json::json!({"id": id, "type": operation, "inputs": inputs, "output": output});
            match (operation, body) {
                ("sample", Some(period)) => connector["periodMs"] = period.parse::<u64>().unwrap().into(),
                (_, Some(body)) if body.starts_with('@') => connector["helper"] = body[1..].into(),
                (_, Some(body)) => connector["body"] = body.into(),
                (_, None) => {}
            }
            connectors.push(connector);
        } else {
            let (id, kind) = line.split_once(' ').unwrap();
            streams.push(serde_json::json!({"id": id, "kind": kind, "name": id}));
        }
    }
    let file = serde_json::json!({
        "format": "rrp-behaviour/1", "name": "test", "streams": streams, "connectors": connectors,
        "helpers": [
            {"name": "twice", "params": ["v"], "body": "v + v"},
            {"name": "four_times", "params": ["v"], "body": "twice(twice(v))"},
        ],
    });
    serde_json::from_value(file).unwrap()
}

/// Returns the emissions of a run: `time stream=value` or `time connector!`.
fn said(run: &mut Run, act: impl FnOnce(&mut Run, &mut dyn FnMut(Emission))) -> String {
    let streams: Vec<_> = run.streams().iter().map(|stream| stream.id.clone()).collect();
    let connectors: Vec<_> = run.connectors().iter().map(|connector| connector.id.clone()).collect();
    let mut lines = Vec::new();
    act(run, &mut |emission| {
        lines.push(match emission {
            Emission::Value { at, stream, value, .. } => format!("{} {}={value}", at.0, streams[stream.index()]),
            Emission::Fault { at, connector, .. } => format!("{} {}!", at.0, connectors[connector.index()]),
        });
    });
    lines.join(", ")
}

fn start(text: &str) -> Run {
    Run::build(&graph(text), Limits::default()).map_err(|faults| faults[0].to_string()).unwrap()
}

fn feed(run: &mut Run, at: u64, stream: &str, value: i64) -> String {
    let index = run.stream_index(stream).unwrap();
    said(run, |run, out| run.feed(Millis(at), index, Value::Int(value), out))
}

fn until(run: &mut Run, at: u64) -> String {
    said(run, |run, out| run.until(Millis(at), out))
}

#[test]
fn streams_of_every_script_give_their_names_to_arguments() {
    let text = "距離 sensor\n近い ordinary\nfilter 距離 > 近い: 距離 < 40\nнет ordinary\nmap 近い > нет: 近い * 2 - 距離2(近い)\n";
    let mut file = graph(text);
    file.helpers.push(
        serde_json::from_value(serde_json::json!({"name": "距離2", "params": ["値"], "body": "値 + 1"})).unwrap(),
    );
    let mut run = Run::build(&file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    assert_eq!(feed(&mut run, 1, "距離", 30), "1 距離=30, 1 近い=30, 1 нет=29");
    assert_eq!(feed(&mut run, 2, "距離", 50), "2 距離=50");
    let mut before = start("距離 sensor\n近い ordinary\nfilter 距離 > 近い: x__ < 40\n");
    assert_eq!(feed(&mut before, 1, "距離", 30), "1 距離=30, 1 近い=30", "a body of before means what it meant");
}

#[test]
fn ten_thousand_maps_in_a_row_work() {
    let mut text = "s0 sensor\n".to_owned();
    for at in 0..10_000 {
        text += &format!("s{} ordinary\nmap s{at} > s{}: s{at} + 1\n", at + 1, at + 1);
    }
    let mut run = start(&text);
    assert!(feed(&mut run, 0, "s0", 0).ends_with("0 s10000=10000"));
    let mut file = graph(&text);
    file.engine = Some(behaviour::Engine::Frame { frame_ms: 10 });
    let mut run = Run::build(&file, Limits::default()).unwrap_or_else(|faults| panic!("{}", faults[0]));
    feed(&mut run, 1, "s0", 0);
    assert!(until(&mut run, 10).ends_with("10 s10000=10000"));
}

#[test]
fn a_sample_ticks_on_multiples_of_its_beat_only_when_it_holds_something() {
    let mut run = start("a sensor\nb ordinary\nsample a > b: 100");
    assert_eq!(run.next_due(), None);
    assert_eq!(feed(&mut run, 0, "a", 1), "0 a=1");
    assert_eq!(run.next_due(), Some(Millis(100)), "not at 0");
    assert_eq!(until(&mut run, 99), "");
    assert_eq!(feed(&mut run, 100, "a", 2), "100 a=2", "inputs before ticks");
    assert_eq!(until(&mut run, 100), "100 b=2");
    assert_eq!(feed(&mut run, 250, "a", 3), "250 a=3");
    assert_eq!(feed(&mut run, 400, "a", 4), "300 b=3, 400 a=4", "what is due before comes first");
    assert_eq!(until(&mut run, 1_000_000), "400 b=4");
    assert_eq!(run.next_due(), None);
}

#[test]
fn a_sample_below_a_sample_ticks_in_the_same_instant_whatever_their_order() {
    let mut run = start("a sensor\nb ordinary\nc ordinary\nsample b > c: 50\nsample a > b: 100");
    feed(&mut run, 10, "a", 1);
    assert_eq!(until(&mut run, 200), "100 b=1, 100 c=1");
}

#[test]
fn a_late_reading_counts_in_the_next_open_instant() {
    let mut run = start("a sensor\nb ordinary\ntimestamp a > b");
    until(&mut run, 50);
    assert_eq!(feed(&mut run, 20, "a", 1), "51 a=1, 51 b=#{t: 51, v: 1}");
}

#[test]
fn a_faulting_combine_keeps_the_new_value() {
    let mut run = start("a sensor\nb sensor\nc ordinary\ncombineLatest a b > c: 10 / b + a");
    assert_eq!(feed(&mut run, 0, "a", 1), "0 a=1");
    assert_eq!(feed(&mut run, 1, "b", 0), "1 b=0, 1 c1!");
    assert_eq!(feed(&mut run, 2, "a", 2), "2 a=2, 2 c1!");
    assert_eq!(feed(&mut run, 3, "b", 5), "3 b=5, 3 c=4");
    let stats = &run.stats().connectors[ConnectorIx::of(0)];
    assert_eq!((stats.fired, stats.faults, run.last_output(ConnectorIx::of(0))), (1, 2, Some(&Value::Int(4))));
    let fault = stats.last_fault.as_ref().unwrap();
    assert_eq!(fault.at, Millis(2));
    assert_eq!(fault.error, CallFault::ByZero);
    assert_eq!(fault.inputs, [Value::Int(2), Value::Int(0)]);
    assert_eq!(run.stats().streams[StreamIx::of(0)].count, 2);
}

#[test]
fn helpers_call_helpers_from_bodies_closures_and_connectors() {
    let mut run = start(
        "a sensor\nb ordinary\nc ordinary\nd ordinary\nmap a > b: @four_times\nmap a > c: twice(a) + four_times(a)\n\
         map a > d: [a, a].map(|i| twice(i) + a)",
    );
    assert_eq!(feed(&mut run, 0, "a", 1), "0 a=1, 0 b=4, 0 c=6, 0 d=[3, 3]");
    assert_eq!(feed(&mut run, 1, "a", 2), "1 a=2, 1 b=8, 1 c=12, 1 d=[6, 6]");
}

#[test]
fn nothing_of_a_call_is_left_for_the_next() {
    let mut run = start("a sensor\nb ordinary\nmap a > b: let old = a; a = 7; let a = 8; let f = || a; f.call() + old");
    assert_eq!(feed(&mut run, 0, "a", 1), "0 a=1, 0 b=9");
    assert_eq!(feed(&mut run, 1, "a", 2), "1 a=2, 1 b=10");
}

#[test]
fn an_interrupt_is_told_apart_and_counted_in_a_row() {
    let stop = Rc::new(Cell::new(true));
    let asked = stop.clone();
    let file = graph("a sensor\nb ordinary\nmap a > b: let n = 0; while n < 1000 { n += 1; } a");
    let limits = Limits::default().interrupted_by(move || asked.get());
    let mut run = Run::build(&file, limits).map_err(|faults| faults[0].to_string()).unwrap();
    for at in 1..=3 {
        assert_eq!(feed(&mut run, at, "a", 1), format!("{at} a=1, {at} c1!"));
        assert_eq!(u64::from(run.stats().connectors[ConnectorIx::of(0)].deadlines_in_a_row), at);
    }
    stop.set(false);
    assert_eq!(feed(&mut run, 4, "a", 1), "4 a=1, 4 b=1");
    assert_eq!(run.stats().connectors[ConnectorIx::of(0)].deadlines_in_a_row, 0);
}

#[test]
fn frames_round_up_and_merge_the_newest() {
    let text = "a sensor\nb sensor\nm ordinary\nz actuator\nmerge a b > m\nsubscribe m > z\nsubscribe a > z";
    let mut file = graph(text);
    file.engine = Some(behaviour::Engine::Frame { frame_ms: 50 });
    let mut run = Run::build(&file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    assert_eq!(feed(&mut run, 0, "b", 1), "");
    assert_eq!(feed(&mut run, 50, "b", 2), "");
    assert_eq!(run.next_due(), Some(Millis(50)));
    assert_eq!(feed(&mut run, 51, "a", 3), "50 b=2, 50 m=2, 50 z=2");
    assert_eq!(feed(&mut run, 52, "b", 4), "");
    assert_eq!(until(&mut run, 99), "");
    assert_eq!(until(&mut run, 100), "100 a=3, 100 b=4, 100 m=4, 100 z=4", "one value a frame on an actuator");
}

#[test]
fn every_fault_is_found_and_named() {
    let cases = [
        ("a sensor\na ordinary", "a: this id is used twice"),
        ("a sensor\nb ordinary\nmerge a a > b", "c1: the input a is there twice"),
        ("a sensor\nb ordinary\nmap a x > b: 1", "c1: there is no stream \"x\""),
        ("a sensor\nc sensor\nb ordinary\nmap a c > b: 1", "c1: map takes exactly one input, not 2"),
        ("b ordinary\nmerge > b", "c1: merge takes one input or more, not 0"),
        ("a sensor\nb sensor\nmap a > b: a", "c1: nothing can lead into the sensor stream b"),
        ("a actuator\nb ordinary\nmap a > b: a", "c1: nothing can come out of the actuator stream a"),
        ("a sensor\nb ordinary\nsubscribe a > b", "c1: subscribe must lead to an actuator stream, and b is none"),
        ("a sensor\nb actuator\nmap a > b: a", "c1: only subscribe leads into the actuator stream b"),
        ("a sensor\nb ordinary\nmap a > b: 1\nmap a > b: 2", "c2: the stream b already has an incoming connector"),
        ("a ordinary\nb ordinary\nmap a > b: a\nmap b > a: b", "c1: values would flow in a circle through it"),
        ("a ordinary\nmap a > a: a", "c1: values would flow in a circle through it"),
        ("a sensor\nb ordinary\nmap a > b: a +", "c1: at character 4: it ends too early"),
        ("a sensor\nb ordinary\nmap a > b", "c1: it has no procedure yet"),
        ("a sensor\nb ordinary\nmap a > b: @thrice", "c1: there is no helper “thrice”"),
        (
            "a sensor\nb sensor\nc ordinary\ncombineLatest a b > c: @twice",
            "c1: the helper “twice” takes 1 values, but gets 2",
        ),
        ("a sensor\nb ordinary\nsample a > b: 0", "c1: sample needs a periodMs of 1 or more"),
        ("a sensor\nb ordinary\nsieve a > b", "c1: there is no connector \"sieve\""),
    ];
    for (text, fault) in cases {
        let faults: Vec<_> = validate(&graph(text)).iter().map(ToString::to_string).collect();
        assert_eq!(faults, [fault], "{text}");
    }
    assert_eq!(validate(&graph("a sensor\nb ordinary\nc actuator\nd actuator\nsubscribe a > c\nsubscribe b > c")), []);
}

#[test]
fn helpers_that_call_themselves_are_named() {
    let mut file = graph("a sensor");
    file.helpers[0].body = "four_times(v)".to_owned();
    let faults: Vec<_> = validate(&file).into_iter().map(|fault| fault.id).collect();
    assert_eq!(faults, ["twice", "four_times"]);
    file.helpers[0].body = "v } fn evil(v) { v".to_owned();
    assert!(validate(&file)[0].to_string().starts_with("twice: at character 3"), "{}", validate(&file)[0]);
}
