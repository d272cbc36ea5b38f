//! A second engine, slow and plain, written from section 3 of the specification alone: on random behaviours and random
//! readings it must say the same as `Run`, emission by emission, faults included.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

#[path = "oracle/chance.rs"]
mod chance;
#[path = "oracle/event.rs"]
mod event;
#[path = "oracle/frame.rs"]
mod frame;
#[path = "oracle/graphs.rs"]
mod graphs;
#[path = "oracle/plain.rs"]
mod plain;

use behaviour::{BehaviourFile, Engine};
use chance::Chance;
use engine::{Emission, Limits, Run, StreamIx};
use graphs::Reading;
use plain::{Said, Way};
use robot::Millis;

const CASES: u64 = 400;
const READINGS: usize = 40;

/// An emission, and of a value the connector that gave it and the stream whose value triggered it.
type Triggered = (Said, Option<(usize, usize)>);

/// Returns the emissions of the product.
fn product(file: &BehaviourFile, trace: &[Reading], until: u64, limits: Limits) -> Vec<Triggered> {
    let mut run = Run::build(file, limits).map_err(|faults| faults[0].to_string()).unwrap();
    let mut said = Vec::new();
    let input = |connector: usize, slot: u32| plain::stream(file, &file.connectors[connector].inputs[slot as usize]);
    let mut hear = |emission: Emission| {
        said.push(match emission {
            Emission::Value { at, stream, value, by } => {
                let by = by.map(|by| (by.connector().index(), input(by.connector().index(), by.slot())));
                (Said::Value(at.0, stream.index(), value.clone()), by)
            }
            Emission::Fault { at, connector, .. } => (Said::Fault(at.0, connector.index()), None),
        });
    };
    for reading in trace {
        run.feed(Millis(reading.at), StreamIx::of(reading.stream), reading.value.clone(), &mut hear);
    }
    run.finish(Millis(until), &mut hear);
    said
}

/// An emission of the slow engine, as the product says it.
fn triggered((said, way): (Said, Way)) -> Triggered {
    let by = way.first().and_then(|step| Some((step.connector?, way[1].stream)));
    (said, by)
}

fn compare(seed: u64, mode: Engine, made: &[Triggered], wanted: &[Triggered]) {
    let different = made.iter().zip(wanted).position(|(made, wanted)| made != wanted);
    let at = different.unwrap_or(made.len().min(wanted.len()));
    let shown = |said: &[Triggered]| said.get(at).map_or("nothing".to_owned(), |said| format!("{said:?}"));
    let same = different.is_none() && made.len() == wanted.len();
    assert!(same, "seed {seed}, {mode:?}, line {}: {} instead of {}", at + 1, shown(made), shown(wanted));
}

/// Values and faults that both said over all cases.
fn check(mode: impl Fn(&mut Chance) -> Engine) -> (usize, usize) {
    let (mut values, mut faults) = (0, 0);
    for seed in 0..CASES {
        let mut chance = Chance::of(seed);
        let (mut file, mode) = (graphs::behaviour(&mut chance), mode(&mut chance));
        let trace = graphs::trace(&mut chance, &file, READINGS);
        let until = trace.last().map_or(0, |last| last.at) + chance.below(150);
        file.engine = Some(mode);
        let wanted = match mode {
            Engine::Event => event::run(&file, &trace, until),
            Engine::Frame { frame_ms } => frame::run(&file, &trace, until, frame_ms),
        };
        let wanted: Vec<Triggered> = wanted.into_iter().map(triggered).collect();
        for compiled in [true, false] {
            let limits = Limits { compiled, ..Limits::default() };
            compare(seed, mode, &product(&file, &trace, until, limits), &wanted);
        }
        faults += wanted.iter().filter(|said| matches!(said.0, Said::Fault(..))).count();
        values += wanted.iter().filter(|said| matches!(said.0, Said::Value(..))).count();
    }
    (values, faults)
}

#[test]
fn event_mode_is_what_the_specification_says() {
    let (values, faults) = check(|_| Engine::Event);
    assert!(values > 20_000 && faults > 1_000, "too few to mean anything: {values} values, {faults} faults");
}

#[test]
fn frame_mode_is_what_the_specification_says() {
    let (values, faults) = check(|chance| Engine::Frame { frame_ms: 1 + chance.below(60) });
    assert!(values > 8_000 && faults > 400, "too few to mean anything: {values} values, {faults} faults");
}
