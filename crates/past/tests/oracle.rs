//! A past of random graphs against the slow, obvious way: everything played once from the beginning, and kept.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

#[path = "../../engine/tests/oracle/chance.rs"]
mod chance;
#[path = "../../engine/tests/oracle/graphs.rs"]
mod graphs;
#[path = "shared/recorded.rs"]
mod recorded;

use behaviour::{AnyKnowledge, BehaviourFile, Engine, StreamKind, Value};
use chance::Chance;
use engine::{Emission, Limits, Run, StreamIx};
use graphs::Reading;
use past::{EditedRun, Hook, Past};
use protocol::{Because, BlockedConnector, LaneColumn, LaneName, LaneValues, NotSeen};
use recorded::{opened, text};
use robot::Millis;
use sentences::Language;
use std::rc::Rc;

/// The graphs that are tried.
const GRAPHS: u64 = 8;
/// The graphs of which those that test numbers are asked why nothing came.
const TESTED_GRAPHS: u64 = 150;
const READINGS: usize = 500;
/// Traces are that many times as slow as others are, so that a past has several moments to go on from.
const SLOWER: u64 = 30;

/// A value of the slow way.
struct Came {
    at: u64,
    stream: usize,
    value: Value,
}

fn hook() -> Hook {
    Rc::new(|| false)
}

struct Scene {
    file: BehaviourFile,
    trace: Vec<Reading>,
    all: Vec<Came>,
    until: u64,
    past: Past,
}

impl Scene {
    fn of(seed: u64) -> Self {
        let mut chance = Chance::of(seed);
        let mut file = graphs::behaviour(&mut chance);
        file.engine = Some(if seed.is_multiple_of(2) { Engine::Event } else { Engine::Frame { frame_ms: 40 } });
        let mut trace = graphs::trace(&mut chance, &file, READINGS);
        trace.iter_mut().for_each(|reading| reading.at *= SLOWER);
        let until = trace.last().map_or(0, |reading| reading.at) + 3_000;
        let all = played(&file, &trace, until).0;
        let past = opened(&text(&file, &trace, &told(&file, &all), until)).unwrap();
        Self { file, trace, all, until, past }
    }

    fn id(&self, stream: usize) -> &str {
        &self.file.streams[stream].id
    }
}

/// Something as JSON, with its long texts as they are sent.
fn sent<T: serde::Serialize>(one: &T) -> String {
    fn shorten(json: &mut serde_json::Value) {
        match json {
            serde_json::Value::String(text) if text.chars().count() > 200 => {
                *text = text.chars().take(200).chain(['…']).collect();
            }
            serde_json::Value::Array(items) => items.iter_mut().for_each(shorten),
            serde_json::Value::Object(fields) => fields.values_mut().for_each(shorten),
            _ => {}
        }
    }
    let mut json = serde_json::to_value(one).unwrap();
    shorten(&mut json);
    json.to_string()
}

/// The values that the actions were told.
fn told(file: &BehaviourFile, all: &[Came]) -> Vec<(u64, usize, Value)> {
    let is_action = |came: &&Came| file.streams[came.stream].kind == StreamKind::Actuator;
    all.iter().filter(is_action).map(|came| (came.at, came.stream, came.value.clone())).collect()
}

/// Everything that comes up to a moment, and the run then.
fn played(file: &BehaviourFile, trace: &[Reading], until: u64) -> (Vec<Came>, Run) {
    let mut run = Run::build(file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let mut all = Vec::new();
    let mut hear = |emission: Emission| {
        if let Emission::Value { at, stream, value, .. } = emission {
            all.push(Came { at: at.0, stream: stream.index(), value: value.clone() });
        }
    };
    for reading in trace.iter().take_while(|reading| reading.at <= until) {
        run.feed(Millis(reading.at), StreamIx::of(reading.stream), reading.value.clone(), &mut hear);
    }
    run.until(Millis(until), &mut hear);
    (all, run)
}

#[test]
fn moments_are_those_of_a_run_from_the_beginning() {
    let mut compared = 0;
    for seed in 0..GRAPHS {
        let scene = Scene::of(seed);
        assert_eq!(scene.past.about().differs_ms, None, "seed {seed}");
        let mut chance = Chance::of(seed + 1_000);
        for _ in 0..25 {
            let at = chance.below(scene.until + 1);
            let moment = scene.past.seek(at, &hook()).unwrap();
            let (_, run) = played(&scene.file, &scene.trace, at);
            let stats = run.stats();
            let came = stats.streams.enumerate().filter_map(|(stream, stats)| {
                let (then, value) = stats.last()?;
                Some((scene.id(stream.index()).to_owned(), stats.count, then.0, sent(value)))
            });
            let seen = moment
                .values
                .streams
                .iter()
                .map(|one| (one.stream.to_string(), one.count, one.at_ms, sent(&one.value)));
            assert_eq!(seen.collect::<Vec<_>>(), came.collect::<Vec<_>>(), "seed {seed} at {at}");
            let gave = stats.connectors.enumerate().filter(|(_, stats)| stats.fired + stats.faults > 0);
            let gave =
                gave.map(|(at, stats)| (scene.file.connectors[at.index()].id.clone(), stats.fired, stats.faults));
            let seen = moment.values.connectors.iter().map(|one| (one.connector.to_string(), one.fired, one.faults));
            assert_eq!(seen.collect::<Vec<_>>(), gave.collect::<Vec<_>>(), "seed {seed} at {at}");
            compared += moment.values.streams.len();
        }
    }
    assert!(compared > 1_000, "{compared}");
}

/// The columns of a lane the slow way.
fn columns(scene: &Scene, stream: usize, (from, to): (u64, u64), count: usize) -> Vec<LaneColumn> {
    let column = |at: u64| u32::try_from(u128::from(at - from) * count as u128 / u128::from(to - from)).unwrap();
    let mut all: Vec<LaneColumn> = Vec::new();
    for came in scene.all.iter().filter(|came| came.stream == stream && (from..to).contains(&came.at)) {
        let at = column(came.at);
        if all.last().is_none_or(|last| last.at != at) {
            all.push(LaneColumn { at, count: 0, numbers: None });
        }
        let last = all.last_mut().unwrap();
        last.count += 1;
        let number = match &came.value {
            Value::Bool(truth) => Some(f64::from(u8::from(*truth))),
            other => other.as_number(),
        };
        if let Some(number) = number {
            let number = number as f32;
            let [low, high, first, _] = last.numbers.unwrap_or([number; 4]);
            last.numbers = Some([low.min(number), high.max(number), first, number]);
        }
    }
    all
}

#[test]
fn lanes_of_a_short_time_are_exact() {
    let (mut each, mut drawn) = (0, 0);
    for seed in 0..GRAPHS {
        let scene = Scene::of(seed);
        for stream in 0..scene.file.streams.len() {
            for (from, to) in
                [(0, scene.until + 1), (scene.until / 3, scene.until / 2), (scene.until - 2_000, scene.until + 9_000)]
            {
                let name = LaneName { stream: scene.id(stream).to_owned(), field: None };
                let lanes = scene.past.lanes(&[name], (from, to), 200, &hook()).unwrap();
                let came: Vec<&Came> =
                    scene.all.iter().filter(|came| came.stream == stream && (from..to).contains(&came.at)).collect();
                match &lanes[0].values {
                    LaneValues::Each(values) => {
                        let seen: Vec<_> = values.iter().map(|one| (one.t, sent(&one.value))).collect();
                        assert_eq!(seen, came.iter().map(|one| (one.at, sent(&one.value))).collect::<Vec<_>>());
                        each += seen.len();
                    }
                    LaneValues::Columns(seen) => {
                        assert!(came.len() > 300, "few values are told one by one");
                        assert_eq!(*seen, columns(&scene, stream, (from, to), 200), "seed {seed} {}", scene.id(stream));
                        drawn += seen.len();
                    }
                }
            }
        }
    }
    assert!(each > 1_000 && drawn > 100, "{each} {drawn}");
}

#[test]
fn causes_are_those_that_a_replay_from_the_beginning_tells() {
    let mut compared = 0;
    for seed in 0..GRAPHS {
        let scene = Scene::of(seed);
        let recorded = text(&scene.file, &scene.trace, &told(&scene.file, &scene.all), scene.until);
        if seed % 3 == 0 {
            scene.past.trace(&hook()).unwrap();
        }
        let mut chance = Chance::of(seed + 2_000);
        for _ in 0..20 {
            let came = &scene.all[chance.index(scene.all.len())];
            let id = scene.id(came.stream);
            let twins = scene.all.iter().filter(|other| (other.at, other.stream) == (came.at, came.stream)).count();
            let nth = chance.index(twins);
            let asked = (id, came.at, nth);
            let told = scene.past.why(asked, Language::English, &AnyKnowledge, &hook()).unwrap();
            let stretch = causes::Stretch::of(Millis(came.at), Millis(came.at));
            let slow =
                recording::past(&recorded, stretch, &|stream| stream.id == *id).map_err(|why| why.to_string()).unwrap();
            let why = slow.traced.tracer().tell(&slow.stretch.values[nth]);
            assert_eq!(sent(&told.why), sent(&why), "seed {seed} {asked:?}");
            assert_eq!(told.sentences.len(), why.steps.len());
            compared += told.why.steps.len();
        }
    }
    assert!(compared > 200, "{compared}");
}

/// The tests of these graphs that compare with numbers.
const TESTS: [&str; 4] = ["a > 2", "a == 3 || a < 0", "a != 1 && a <= 5", "a.x > 1"];

/// The distance of a value from passing a test of these graphs, as a part of the number beside it: each test worked out by hand.
/// None if it passes, if it is nothing that such a test compares, or if no other number is what it needs.
fn distance(body: &str, value: &Value) -> Option<f64> {
    let number = value.as_number();
    match body {
        "a > 2" => number.filter(|a| *a <= 2.0).map(|a| (2.0 - a) / 2.0),
        "a == 3 || a < 0" => number.filter(|a| *a != 3.0 && *a >= 0.0).map(|a| a.min((a - 3.0).abs() / 3.0)),
        "a != 1 && a <= 5" => number.filter(|a| *a > 5.0).map(|a| (a - 5.0) / 5.0),
        "a.x > 1" => value.field("x").and_then(Value::as_number).filter(|x| *x <= 1.0).map(|x| 1.0 - x),
        _ => None,
    }
}

/// Returns what has to be told of a connector that kept values back: of all that came in a time the one nearest to passing,
/// of several the newest. With how far that was; none where nothing can be measured and the last one is told.
fn nearest(scene: &Scene, last: &BlockedConnector, (from, until): (u64, u64)) -> (BlockedConnector, Option<f64>) {
    let connector = scene.file.connectors.iter().find(|one| one.id == last.connector).unwrap();
    let (mut told, mut least) = (last.clone(), None);
    if connector.operation == "filter" && last.because == Because::Kept {
        let body = connector.body.as_deref().unwrap();
        let all = played(&scene.file, &scene.trace, until).0;
        for came in all.iter().filter(|came| came.at >= from && scene.id(came.stream) == connector.inputs[0]) {
            let Some(far) = distance(body, &came.value) else { continue };
            if least.is_none_or(|least| far <= least) {
                least = Some(far);
                told = BlockedConnector { t: Some(came.at), value: came.value.clone(), ..last.clone() };
            }
        }
    }
    (told, least)
}

#[test]
fn what_kept_a_value_back_is_what_a_replay_from_the_beginning_tells() {
    let (mut compared, mut came_then, mut measured, mut earlier) = (0, 0, 0, 0);
    for seed in 0..TESTED_GRAPHS {
        // The streams behind tests of numbers, which are asked more often than others.
        let graph = graphs::behaviour(&mut Chance::of(seed));
        let tests = graph.connectors.iter().filter(|one| one.operation == "filter");
        let tests = tests.filter(|one| one.body.as_ref().is_some_and(|body| TESTS.contains(&body.as_str())));
        let tested: Vec<_> =
            tests.map(|one| graph.streams.iter().position(|to| to.id == one.output).unwrap()).collect();
        if seed >= GRAPHS && tested.is_empty() {
            continue;
        }
        let scene = Scene::of(seed);
        let recorded = text(&scene.file, &scene.trace, &told(&scene.file, &scene.all), scene.until);
        let mut chance = Chance::of(seed + 3_000);
        for _ in 0..30 {
            let any = chance.index(scene.file.streams.len());
            let stream = if tested.is_empty() || chance.below(3) == 0 { any } else { chance.pick(&tested) };
            let until = chance.below(scene.until + 1);
            let length = chance.pick(&[1_500, 20_000]);
            let (id, from) = (scene.id(stream), until.saturating_sub(chance.below(length)));
            let told = scene.past.why_not((id, from, until), Language::Japanese, &AnyKnowledge, &hook());
            let first = scene.all.iter().find(|came| came.stream == stream && (from..=until).contains(&came.at));
            if let Some(first) = first {
                assert_eq!(told.err(), Some(NotSeen::Came(first.at)));
                came_then += 1;
                continue;
            }
            let stretch = causes::Stretch::of(Millis(from), Millis(until));
            let mut slow =
                recording::past(&recorded, stretch, &|stream| stream.id == *id).map_err(|why| why.to_string()).unwrap();
            let why = slow.traced.why_not(StreamIx::of(stream), Millis(from));
            let (told, asked) = (told.unwrap(), format!("seed {seed} {id} {from}..={until}"));
            let ways = why.blocked.iter().map(|last| (nearest(&scene, last, (from, until)), last));
            let mut ways: Vec<_> = ways.collect();
            ways.sort_by(|((_, one), _), ((_, other), _)| {
                one.unwrap_or(f64::INFINITY).total_cmp(&other.unwrap_or(f64::INFINITY))
            });
            assert_eq!((&told.why.stream, told.why.blocked.len()), (&why.stream, ways.len()), "{asked}");
            for (told_way, ((nearest, far), last)) in told.why.blocked.iter().zip(&ways) {
                assert_eq!(sent(told_way), sent(nearest), "{asked}");
                measured += u32::from(far.is_some());
                earlier += u32::from(nearest != *last);
            }
            compared += 1;
        }
    }
    assert!(compared > 400 && came_then > 400, "{compared} {came_then}");
    assert!(measured > 40 && earlier > 8, "{measured} {earlier}");
}

#[test]
fn a_program_that_means_the_same_changes_nothing_from_wherever_it_begins() {
    let mut same = 0;
    for seed in 0..GRAPHS {
        let scene = Scene::of(seed);
        for from in [None, Some(scene.until / 2), Some(scene.until)] {
            let now = EditedRun::of(scene.file.clone(), &hook()).unwrap();
            let changes = scene.past.compare(None, now, from, &[], &hook()).unwrap();
            assert!(changes.open_loop.is_empty());
            for stream in &changes.streams {
                assert_eq!(
                    (stream.before, stream.same, stream.moved),
                    (stream.now, stream.now, 0),
                    "seed {seed} {stream:?}"
                );
                same += stream.same;
            }
        }
    }
    assert!(same > 2_000, "{same}");
}
