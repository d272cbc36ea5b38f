//! Values of random runs have the cause that the engine's slow, plain twin gives them, as it is told of an opened past: from the
//! moments that it keeps, the last value first. Both modes, all connectors, faults, and graphs of a thousand connectors.
//!
//! `RRP_GRAPHS=1000` tries that many graphs, and eight large ones.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

#[path = "../../engine/tests/oracle/chance.rs"]
mod chance;
#[path = "../../engine/tests/oracle/event.rs"]
mod event;
#[path = "../../engine/tests/oracle/frame.rs"]
mod frame;
#[path = "../../engine/tests/oracle/graphs.rs"]
mod graphs;
#[path = "../../engine/tests/oracle/plain.rs"]
mod plain;
#[path = "../../causes/tests/shared/plain_why.rs"]
mod plain_why;
#[path = "shared/recorded.rs"]
mod recorded;

use behaviour::{AnyKnowledge, BehaviourFile, Engine};
use chance::Chance;
use graphs::Reading;
use past::{Hook, Past};
use plain::{Said, Way};
use plain_why::told;
use protocol::Why;
use recorded::{opened, text};
use sentences::Language;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The graphs that are tried if nobody says how many.
const GRAPHS: u64 = 6;
const READINGS: usize = 560;
/// The large graphs that are tried where many are.
const LARGE: u64 = 8;
const LARGE_CONNECTORS: usize = 1_000;
const LARGE_READINGS: usize = 40;
/// Of so many values the cause of one is asked for; no period of a graph is as long.
const ASKED_OF: usize = 13;
/// Of large graphs, whose answers take longer, the cause of one value of so many.
const LARGE_ASKED_OF: usize = 307;
/// The most steps of an answer, and the most other values of a step.
const STEPS_MAX: usize = 100;
const WITH_MAX: usize = 8;
/// A run is that many times as slow as others, periods and all, so that its past keeps several moments in its midst.
const SLOWER: [u64; 2] = [12, 30];

/// The number of things that were compared.
#[derive(Default)]
struct Compared {
    values: u64,
    steps: u64,
    faults: u64,
}

fn graphs() -> u64 {
    std::env::var("RRP_GRAPHS").ok().map_or(GRAPHS, |graphs| graphs.parse().unwrap())
}

/// The causes of values of a past with their places among all, the last one first.
fn asked(past: &Past, wanted: &[Why], of: usize) -> Vec<(usize, Why)> {
    let hook: Hook = Rc::new(|| false);
    past.trace(&hook).unwrap();
    let mut came: BTreeMap<(&str, u64), usize> = BTreeMap::new();
    let mut questions: Vec<(usize, &Why, usize)> = Vec::new();
    for (at, why) in wanted.iter().enumerate() {
        let next = came.entry((&why.stream, why.t)).or_default();
        questions.push((at, why, *next));
        *next += 1;
    }
    let why = |(at, why, nth): &(usize, &Why, usize)| {
        let question = (why.stream.as_str(), why.t, *nth);
        (*at, past.why(question, Language::English, &AnyKnowledge, &hook).unwrap().why)
    };
    questions.iter().rev().step_by(of).map(why).collect()
}

/// An answer as it is sent.
fn cut(mut why: Why) -> Why {
    why.steps.truncate(STEPS_MAX);
    why.steps.iter_mut().for_each(|step| step.with.truncate(WITH_MAX));
    why
}

fn check(said: &str, file: &BehaviourFile, trace: &[Reading], (until, of): (u64, usize), compared: &mut Compared) {
    let wanted = match file.engine.unwrap() {
        Engine::Event => event::run(file, trace, until),
        Engine::Frame { frame_ms } => frame::run(file, trace, until, frame_ms),
    };
    let ways: Vec<&Way> =
        wanted.iter().filter(|(said, _)| matches!(said, Said::Value(..))).map(|(_, way)| way).collect();
    let past = opened(&text(file, trace, &[], until)).unwrap();
    let before = past.bytes();
    let all: Vec<Why> = ways.iter().map(|way| told(file, way)).collect();
    let made = asked(&past, &all, of);
    assert!(until < 40_000 || past.bytes() > before, "{said}: no moment is kept");
    for (at, made) in &made {
        let wanted = cut(all[*at].clone());
        assert!(*made == wanted, "{said}: {made:#?} instead of {wanted:#?}");
        compared.steps += wanted.steps.len() as u64;
    }
    compared.values += made.len() as u64;
    compared.faults += (wanted.len() - ways.len()) as u64;
}

/// A run made slower, with its readings up to the end of a frame.
fn slower(file: &mut BehaviourFile, trace: &mut Vec<Reading>, times: u64, frame_ms: Option<u64>) -> u64 {
    for connector in &mut file.connectors {
        connector.period_ms = connector.period_ms.map(|period| period * times);
    }
    trace.iter_mut().for_each(|reading| reading.at *= times);
    let frame_ms = frame_ms.map(|frame_ms| frame_ms * times);
    file.engine = Some(frame_ms.map_or(Engine::Event, |frame_ms| Engine::Frame { frame_ms }));
    let ends = trace.last().map_or(0, |last| last.at) + 100 * times;
    let until = frame_ms.map_or(ends, |frame_ms| ends / frame_ms * frame_ms);
    trace.retain(|reading| reading.at <= until);
    until
}

fn small(seed: u64, is_frame: bool, compared: &mut Compared) {
    let mut chance = Chance::of(seed + 50_000);
    let mut file = graphs::behaviour(&mut chance);
    let mut trace = graphs::trace(&mut chance, &file, READINGS);
    let frame_ms = is_frame.then(|| 1 + chance.below(30));
    let until = slower(&mut file, &mut trace, chance.pick(&SLOWER), frame_ms);
    check(&format!("seed {seed}, {:?}", file.engine), &file, &trace, (until, ASKED_OF), compared);
}

fn large(seed: u64, is_frame: bool, compared: &mut Compared) {
    let mut chance = Chance::of(seed + 90_000);
    let mut file = graphs::large(&mut chance, LARGE_CONNECTORS);
    let mut trace = graphs::trace(&mut chance, &file, LARGE_READINGS);
    let until = slower(&mut file, &mut trace, 100, is_frame.then_some(8));
    check(&format!("large, seed {seed}, {:?}", file.engine), &file, &trace, (until, LARGE_ASKED_OF), compared);
}

#[test]
fn values_of_a_past_have_the_causes_of_the_plain_engine() {
    let mut compared = Compared::default();
    for seed in 0..graphs() {
        small(seed, false, &mut compared);
        small(seed, true, &mut compared);
    }
    let Compared { values, steps, faults } = compared;
    eprintln!("{values} values with {steps} steps, {faults} faults, of {} graphs in both modes: 0 wrong", graphs());
    assert!(
        values > graphs() * 500 / ASKED_OF as u64 && faults > graphs() * 20,
        "too few to mean anything: {values} values, {faults} faults"
    );
}

#[test]
fn values_of_a_large_graph_have_the_causes_of_the_plain_engine() {
    let (mut compared, many) = (Compared::default(), if graphs() < 100 { 1 } else { LARGE });
    for seed in 0..many {
        large(seed, false, &mut compared);
        large(seed, true, &mut compared);
    }
    let Compared { values, steps, faults } = compared;
    eprintln!("{values} values with {steps} steps, {faults} faults, of {many} large graphs in both modes: 0 wrong");
    assert!(values > many * 10_000 / LARGE_ASKED_OF as u64, "too few to mean anything: {values}");
}
