//! Every value of random runs has the cause that the engine's slow, plain twin gives it, which carries the whole way of each
//! value along as a plain list; both modes, all connectors, faults.
//!
//! `RRP_GRAPHS=1000` tries that many graphs.
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
#[path = "shared/plain_why.rs"]
mod plain_why;

use behaviour::{BehaviourFile, Engine};
use causes::Traced;
use chance::Chance;
use engine::{Limits, Run, StreamIx};
use graphs::Reading;
use plain::{Said, Way};
use plain_why::told;
use protocol::Why;
use robot::Millis;

/// The graphs that are tried if nobody says how many.
const GRAPHS: u64 = 24;
const READINGS: usize = 420;

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

/// The way of each value of the product.
fn product(file: &BehaviourFile, trace: &[Reading], until: u64) -> Vec<Why> {
    let run = Run::build(file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let mut traced = Traced::of(file.clone(), run);
    let mut causes = Vec::new();
    for reading in trace {
        let (at, stream) = (Millis(reading.at), StreamIx::of(reading.stream));
        traced.feed(at, stream, reading.value.clone(), &mut |cause| causes.push(cause.clone()));
    }
    traced.finish(Millis(until), &mut |cause| causes.push(cause.clone()));
    causes.iter().map(|cause| traced.tracer().tell(cause)).collect()
}

fn check(seed: u64, mode: impl Fn(&mut Chance) -> Engine, compared: &mut Compared) {
    let mut chance = Chance::of(seed);
    let (mut file, mode) = (graphs::behaviour(&mut chance), mode(&mut chance));
    let trace = graphs::trace(&mut chance, &file, READINGS);
    let until = trace.last().map_or(0, |last| last.at) + chance.below(150);
    file.engine = Some(mode);
    let wanted = match mode {
        Engine::Event => event::run(&file, &trace, until),
        Engine::Frame { frame_ms } => frame::run(&file, &trace, until, frame_ms),
    };
    let made = product(&file, &trace, until);
    let ways = wanted.iter().filter(|(said, _)| matches!(said, Said::Value(..)));
    let ways: Vec<&Way> = ways.map(|(_, way)| way).collect();
    assert_eq!(made.len(), ways.len(), "seed {seed}, {mode:?}");
    for (made, way) in made.iter().zip(&ways) {
        let wanted = told(&file, way);
        assert!(*made == wanted, "seed {seed}, {mode:?}: {made:#?} instead of {wanted:#?}");
        compared.steps += way.len() as u64;
    }
    compared.values += made.len() as u64;
    compared.faults += (wanted.len() - made.len()) as u64;
}

/// The ways of the values that come after a reading, of a run that goes on and of one that was restored there.
fn restored(file: &BehaviourFile, trace: &[Reading], at: usize, until: u64) -> Option<[Vec<Why>; 2]> {
    let build = || Run::build(file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let feed = |traced: &mut Traced, readings: &[Reading], ways: &mut Vec<_>| {
        for Reading { at, stream, value } in readings {
            let stream = StreamIx::of(*stream);
            traced.feed(Millis(*at), stream, value.clone(), &mut |cause| ways.push(cause.clone()));
        }
    };
    let (before, after) = trace.split_at(at);
    let mut first = Traced::of(file.clone(), build());
    feed(&mut first, before, &mut Vec::new());
    first.until(Millis(before.last()?.at), &mut |_| {});
    let second = Traced::from_snapshot(file.clone(), build(), first.snapshot()?);
    Some([first, second].map(|mut traced| {
        let mut ways = Vec::new();
        feed(&mut traced, after, &mut ways);
        traced.finish(Millis(until), &mut |cause| ways.push(cause.clone()));
        ways.iter().map(|cause| traced.tracer().tell(cause)).collect()
    }))
}

#[test]
fn a_run_that_was_restored_tells_what_the_first_one_tells() {
    let (mut tried, mut values) = (0, 0);
    for seed in 0..80 {
        let mut chance = Chance::of(seed);
        let mut file = graphs::behaviour(&mut chance);
        let trace = graphs::trace(&mut chance, &file, 120);
        file.engine = Some(chance.pick(&[Engine::Event, Engine::Frame { frame_ms: 20 }]));
        let until = trace.last().map_or(0, |last| last.at) + 200;
        let Some([first, second]) = restored(&file, &trace, 1 + chance.index(100), until) else { continue };
        assert!(first == second, "seed {seed}, {:?}", file.engine);
        (tried, values) = (tried + 1, values + first.len());
    }
    assert!(tried > 40 && values > 4_000, "too few to mean anything: {tried} runs, {values} values");
}

#[test]
fn every_value_of_random_runs_has_the_cause_of_the_plain_engine() {
    let mut compared = Compared::default();
    for seed in 0..graphs() {
        check(seed, |_| Engine::Event, &mut compared);
        check(seed, |chance| Engine::Frame { frame_ms: 1 + chance.below(60) }, &mut compared);
    }
    let Compared { values, steps, faults } = compared;
    eprintln!("{values} values with {steps} steps, {faults} faults, of {} graphs in both modes: 0 wrong", graphs());
    let least = graphs() * 400;
    assert!(values > least && faults > graphs() * 40, "too few to mean anything: {values} values, {faults} faults");
}
