//! One run follows another: on random behaviours and readings, with random edits, at any instant and in both modes.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

#[path = "oracle/chance.rs"]
mod chance;
#[path = "oracle/graphs.rs"]
mod graphs;

use behaviour::{BehaviourFile, Engine, StreamKind, Value};
use chance::Chance;
use engine::{ConnectorIx, Emission, Limits, Matching, Run, StreamIx};
use graphs::Reading;
use robot::Millis;
use std::collections::BTreeSet;

const CASES: u64 = 300;

/// An emission with ids, since indices differ between versions.
#[derive(Clone, Debug, PartialEq)]
enum Said {
    Value(u64, String, Value),
    Fault(u64, String),
}

/// Both said the same; otherwise the first difference is shown.
fn same(said: &[Said], wanted: &[Said], when: &str) {
    let different = said.iter().zip(wanted).position(|(said, wanted)| said != wanted);
    let at = different.unwrap_or(said.len().min(wanted.len()));
    assert!(said == wanted, "{when}, line {at}: {:?} instead of {:?}", said.get(at), wanted.get(at));
}

fn build(file: &BehaviourFile) -> Run {
    Run::build(file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap()
}

/// Feeds readings by the ids of `ids`, closing the instants before each as a live run does.
fn play(run: &mut Run, trace: &[Reading], ids: &BehaviourFile, said: &mut Vec<Said>) {
    let (streams, connectors) = names(run);
    let mut hear = |emission: Emission| said.push(heard(&emission, &streams, &connectors));
    for reading in trace {
        if let Some(stream) = run.stream_index(&ids.streams[reading.stream].id) {
            run.feed(Millis(reading.at), stream, reading.value.clone(), &mut hear);
        }
    }
}

fn close(run: &mut Run, at: u64, said: &mut Vec<Said>) {
    let (streams, connectors) = names(run);
    run.until(Millis(at), &mut |emission| said.push(heard(&emission, &streams, &connectors)));
}

fn names(run: &Run) -> (Vec<String>, Vec<String>) {
    let streams = run.streams().iter().map(|stream| stream.id.clone()).collect();
    (streams, run.connectors().iter().map(|connector| connector.id.clone()).collect())
}

fn heard(emission: &Emission, streams: &[String], connectors: &[String]) -> Said {
    match *emission {
        Emission::Value { at, stream, value, .. } => Said::Value(at.0, streams[stream.index()].clone(), value.clone()),
        Emission::Fault { at, connector, .. } => Said::Fault(at.0, connectors[connector.index()].clone()),
    }
}

/// A run of `old` until it is swapped for one of `new`, and what both said, with where the second begins.
fn swapped(old: &BehaviourFile, new: &BehaviourFile, case: &Case) -> (Run, Vec<Said>, usize) {
    let (mut said, mut first) = (Vec::new(), build(old));
    play(&mut first, &case.trace[..case.cut], old, &mut said);
    if let Some(at) = case.closed {
        close(&mut first, at, &mut said);
    }
    let mut second = build(new);
    second.resume_from(first.handover(), &Matching::between(old, new));
    let begins = said.len();
    play(&mut second, &case.trace[case.cut..], old, &mut said);
    close(&mut second, case.until, &mut said);
    (second, said, begins)
}

/// A behaviour, its readings, and when it is swapped.
struct Case {
    file: BehaviourFile,
    trace: Vec<Reading>,
    cut: usize,
    /// The instant that is closed before the swap, if one is.
    closed: Option<u64>,
    until: u64,
}

fn case(seed: u64, mode: impl Fn(&mut Chance) -> Engine) -> (Case, Chance) {
    let mut chance = Chance::of(seed);
    let mut file = graphs::behaviour(&mut chance);
    file.engine = Some(mode(&mut chance));
    let trace = graphs::trace(&mut chance, &file, 40);
    let cut = chance.index(trace.len() + 1);
    let until = trace.last().map_or(0, |last| last.at) + chance.below(150);
    let before = cut.checked_sub(1).map(|at| trace[at].at);
    let next = trace.get(cut).map_or(until, |reading| reading.at.saturating_sub(1));
    let closed = before.filter(|before| next >= *before).map(|before| before + chance.below(next - before + 1));
    let closed = closed.filter(|_| chance.below(3) > 0);
    (Case { file, trace, cut, closed, until }, chance)
}

fn event(_: &mut Chance) -> Engine {
    Engine::Event
}

fn frame(chance: &mut Chance) -> Engine {
    Engine::Frame { frame_ms: 1 + chance.below(60) }
}

/// Returns the emissions of one run from beginning to end.
fn whole(file: &BehaviourFile, case: &Case) -> (Run, Vec<Said>) {
    let (mut run, mut said) = (build(file), Vec::new());
    play(&mut run, &case.trace, &case.file, &mut said);
    close(&mut run, case.until, &mut said);
    (run, said)
}

#[test]
fn a_swap_for_the_same_behaviour_changes_nothing_at_any_moment() {
    let mut held = 0;
    for seed in 0..CASES {
        for (mode, name) in [(event as fn(&mut Chance) -> Engine, "event"), (frame, "frame")] {
            let (case, mut chance) = case(seed, mode);
            let mut twin = case.file.clone();
            let (run, said, begins) = swapped(&case.file, &twin, &case);
            let (straight, wanted) = whole(&case.file, &case);
            same(&said, &wanted, &format!("seed {seed}, {name} mode"));
            assert_eq!(run.stats(), straight.stats(), "seed {seed}, {name} mode");
            held += said.len() - begins;
            // Another order of streams, and other names, are no other meaning.
            chance.shuffle(&mut twin.streams);
            twin.streams.iter_mut().for_each(|stream| stream.name.push('x'));
            same(&swapped(&case.file, &twin, &case).1, &wanted, &format!("seed {seed}, {name} mode, renamed"));
        }
    }
    assert!(held > 10_000, "too little after the swaps to mean anything: {held}");
}

#[test]
fn what_has_nothing_in_common_begins_anew_and_logical_time_goes_on() {
    for seed in 0..CASES {
        for (mode, name) in [(event as fn(&mut Chance) -> Engine, "event"), (frame, "frame")] {
            let (case, _) = case(seed, mode);
            let mut other = case.file.clone();
            other.connectors.iter_mut().for_each(|connector| connector.id.push('x'));
            let (_, said, begins) = swapped(&case.file, &other, &case);
            let (mut fresh, mut wanted) = (build(&other), Vec::new());
            if let Some(closed) = case.closed {
                close(&mut fresh, closed, &mut wanted);
            }
            // A frame that is open hands on its readings, which a run from the start has not.
            if between(&case) {
                play(&mut fresh, &case.trace[case.cut..], &case.file, &mut wanted);
                close(&mut fresh, case.until, &mut wanted);
                same(&said[begins..], &wanted, &format!("seed {seed}, {name} mode"));
            }
        }
    }
}

/// True if no frame is open at the swap.
fn between(case: &Case) -> bool {
    let mut run = build(&case.file);
    play(&mut run, &case.trace[..case.cut], &case.file, &mut Vec::new());
    if let Some(closed) = case.closed {
        close(&mut run, closed, &mut Vec::new());
    }
    run.is_between()
}

/// The streams whose values come through the connectors in `touched`, or through none at all.
fn downstream(file: &BehaviourFile, touched: &BTreeSet<String>) -> BTreeSet<String> {
    let mut spoiled = BTreeSet::new();
    for _ in 0..=file.connectors.len() {
        for connector in &file.connectors {
            let above = connector.inputs.iter().any(|input| spoiled.contains(input));
            if above || touched.contains(&connector.id) {
                spoiled.insert(connector.output.clone());
            }
        }
    }
    spoiled
}

#[test]
fn what_an_edit_does_not_touch_goes_on_as_if_it_had_always_been_the_new_behaviour() {
    let mut compared = 0;
    for seed in 0..CASES {
        for mode in [event as fn(&mut Chance) -> Engine, frame] {
            let (case, mut chance) = case(seed, mode);
            let mut edited = case.file.clone();
            let at = chance.index(edited.connectors.len());
            let gone = edited.connectors[at].clone();
            match chance.below(3) {
                0 => drop(edited.connectors.remove(at)),
                1 => edited.connectors[at].id.push('x'),
                _ => {
                    let extra = BehaviourFile { name: String::new(), ..case.file.clone() };
                    edited.helpers = extra.helpers.into_iter().rev().collect();
                    edited.connectors[at].period_ms = edited.connectors[at].period_ms.map(|period| period + 7);
                    edited.connectors[at].body =
                        edited.connectors[at].body.take().map(|body| format!("{body} // edited"));
                }
            }
            let touched = BTreeSet::from([gone.id.clone(), format!("{}x", gone.id)]);
            let spoiled: BTreeSet<_> =
                downstream(&case.file, &touched).union(&downstream(&edited, &touched)).cloned().collect();
            let clean = |said: &[Said]| -> Vec<Said> {
                let is_clean = |said: &&Said| match said {
                    Said::Value(_, stream, _) => !spoiled.contains(stream),
                    Said::Fault(..) => false,
                };
                said.iter().filter(is_clean).cloned().collect()
            };
            let (_, said, _) = swapped(&case.file, &edited, &case);
            let (_, wanted) = whole(&edited, &case);
            same(&clean(&said), &clean(&wanted), &format!("seed {seed}"));
            compared += clean(&said).len();
        }
    }
    assert!(compared > 10_000, "too little to mean anything: {compared}");
}

fn file(connectors: &str) -> BehaviourFile {
    let text = format!(
        r#"{{"format":"rrp-behaviour/1","name":"x","helpers":[{{"name":"twice","params":["v"],"body":"v + v"}},
        {{"name":"more","params":["v"],"body":"twice(v) + 1"}}],
        "streams":[{{"id":"a","kind":"sensor","name":"Red ball"}},{{"id":"b","kind":"sensor","name":"B"}},
        {{"id":"c","kind":"ordinary","name":"C"}},{{"id":"d","kind":"ordinary","name":"D"}}],"connectors":[{connectors}]}}"#
    );
    serde_json::from_str(&text).unwrap()
}

const BOTH: &str = r#"{"id":"k","type":"combineLatest","inputs":["a","b"],"output":"c","body":"more(redBall) - b"}"#;

fn keeps(old: &BehaviourFile, new: &BehaviourFile) -> bool {
    Matching::between(old, new).connectors.contains_key(&ConnectorIx::of(0))
}

#[test]
fn a_connector_is_the_same_as_long_as_it_means_the_same() {
    let old = file(BOTH);
    assert!(keeps(&old, &old));
    let changed = |change: &dyn Fn(&mut BehaviourFile)| {
        let mut new = old.clone();
        change(&mut new);
        keeps(&old, &new)
    };
    let renamed = |file: &mut BehaviourFile| {
        file.streams[0].name = "Ball".into();
        file.connectors[0].body = Some("more(ball) - b".into());
    };
    assert!(changed(&renamed), "a stream was renamed, and the body with it");
    assert!(changed(&|file| file.connectors[0].output = "d".into()));
    assert!(!changed(&|file| file.connectors[0].body = Some("more(redBall) - b - 1".into())));
    assert!(!changed(&|file| file.connectors[0].body = Some("more(b) - redBall".into())));
    assert!(!changed(&|file| file.connectors[0].inputs.reverse()));
    assert!(!changed(&|file| file.connectors[0].id = "other".into()));
    assert!(!changed(&|file| file.helpers[1].body = "twice(v) + 2".into()));
    assert!(!changed(&|file| file.helpers[0].body = "2 * v".into()), "a helper of a helper counts too");
    assert!(changed(&|file| file
        .helpers
        .push(behaviour::FileHelper { name: "free".into(), ..old.helpers[0].clone() })));
}

#[test]
fn a_sample_and_a_combination_go_on_and_counts_stay() {
    let graph = |period: u64, extra: &str| {
        file(&format!(
            r#"{{"id":"s","type":"sample","inputs":["a"],"output":"c","periodMs":{period}}},
            {{"id":"k","type":"combineLatest","inputs":["c","b"],"output":"d","args":["x","y"],"body":"x + y"}}{extra}"#
        ))
    };
    let (old, mut said) = (graph(100, ""), Vec::new());
    let mut run = build(&old);
    let mut hear = |_: Emission| {};
    run.feed(Millis(10), StreamIx::of(1), Value::Int(5), &mut hear);
    run.feed(Millis(20), StreamIx::of(0), Value::Int(1), &mut hear);
    run.until(Millis(60), &mut hear);
    let follow = |new: &BehaviourFile| {
        let mut next = build(new);
        next.resume_from(run.handover(), &Matching::between(&old, new));
        next
    };
    let mut same = follow(&graph(100, ""));
    assert_eq!((same.next_due(), same.stats().streams[StreamIx::of(1)].count), (Some(Millis(100)), 1));
    close(&mut same, 100, &mut said);
    assert_eq!(said[1], Said::Value(100, "d".into(), Value::Int(6)));
    let other = follow(&graph(50, ""));
    assert_eq!(other.next_due(), None, "a sample with another beat begins anew");
    assert_eq!(other.stats().streams[StreamIx::of(0)].count, 1);
    let mut framed = graph(100, "");
    framed.engine = Some(Engine::Frame { frame_ms: 30 });
    let mut framed = follow(&framed);
    assert_eq!(framed.next_due(), Some(Millis(120)), "the frame that has the tick of 100");
    said.clear();
    close(&mut framed, 120, &mut said);
    assert_eq!(said[1], Said::Value(120, "d".into(), Value::Int(6)));
    let mut back = follow(&graph(100, ""));
    back.feed(Millis(30), StreamIx::of(0), Value::Int(9), &mut |emission| {
        assert!(matches!(emission, Emission::Value { at: Millis(61), .. }), "closed instants stay closed");
    });
}

#[test]
fn a_stream_of_another_device_begins_anew() {
    let old = file(BOTH);
    let mut new = old.clone();
    new.streams[0].device = Some("RedBall".into());
    let matching = Matching::between(&old, &new);
    assert!(!matching.streams.contains_key(&StreamIx::of(0)) && matching.streams.contains_key(&StreamIx::of(1)));
    assert_eq!(old.streams[0].kind, StreamKind::Sensor);
}
