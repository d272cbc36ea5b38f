//! One graph, all who can run it, in turn: medians of passes that alternate, so that ratios hold on a busy machine too.

use crate::clock::{cpu_of, median, memory_kib};
use crate::graphs::{Graph, Way};
use crate::peers::{self, Peer};
use crate::verdict;
use engine::{Emission, Limits, Run};
use robot::Millis;
use serde_json::{Map, Value as Json, json};
use std::hint::black_box;
use std::rc::Rc;

const PASSES: usize = 7;
/// CPU time of one pass, about.
const NANOS: u64 = 60_000_000;
/// The least factor over RxPY's rate that ours must have by Rhai alone.
const RHAI_LEAST: f64 = 2.0;
/// The number of times that each plays all readings before it is measured, while what it says is compared.
const WARM_CYCLES: u64 = 2;

/// One who runs the graph.
struct Runner {
    name: &'static str,
    /// CPU time of so many events.
    time: Box<dyn FnMut(u64) -> u64>,
    /// The process of the peer.
    process: String,
    rates: Vec<f64>,
}

/// Measures and prints.
pub(crate) fn race(graph: &Graph) {
    let mut runners = runners(graph);
    let cycle = graph.readings.len() as u64;
    let events: Vec<u64> = runners.iter_mut().map(|runner| enough(runner, cycle)).collect();
    for _ in 0..PASSES {
        for (runner, events) in runners.iter_mut().zip(&events) {
            let nanos = (runner.time)(*events);
            runner.rates.push(*events as f64 * 1e9 / nanos as f64);
        }
    }
    print(graph.name, &runners);
}

fn runners(graph: &Graph) -> Vec<Runner> {
    let [shared, by_hand] = graph.by_hand;
    let ways = [
        ("compiled", play(graph, true)),
        ("by Rhai alone", play(graph, false)),
        ("Rust, shared streams", shared()),
        ("Rust by hand", by_hand()),
    ];
    let own = |(name, mut way): (_, Way)| {
        let time = Box::new(move |events| cpu_of(|| way(black_box(events))));
        Runner { name, time, process: "self".to_owned(), rates: Vec::new() }
    };
    let others = peers::all(graph).into_iter().filter_map(|peer| other(graph, peer));
    ways.map(own).into_iter().chain(others).collect()
}

/// Another one, once it has shown that it says what we say; one that does not is left out and told at the end.
fn other(graph: &Graph, mut peer: Peer) -> Option<Runner> {
    let cycle = graph.readings.len() as u64;
    let said = peer.check(WARM_CYCLES * cycle);
    if !is_same(&said, &wanted(graph)) {
        verdict::failed(format!("{} says something else on {}: {said}", peer.name, graph.name));
        return None;
    }
    let outputs = outputs_of_cycle(graph);
    let (name, process) = (peer.name, peer.id());
    let time = Box::new(move |events| peer.run(events, events / cycle * outputs));
    Some(Runner { name, time, process, rates: Vec::new() })
}

/// A run, and what feeds it the readings of its graph in turn, a millisecond apart.
pub(crate) struct Playing {
    pub(crate) run: Run,
    readings: Rc<[(engine::StreamIx, behaviour::Value)]>,
    at: usize,
}

impl Playing {
    pub(crate) fn of(graph: &Graph, limits: Limits) -> Self {
        let run = Run::build(&graph.file, limits).map_err(|faults| faults[0].to_string()).unwrap();
        let index = |stream: &str| run.stream_index(stream).unwrap();
        let readings = graph.readings.iter().map(|(stream, value)| (index(stream), value.clone())).collect();
        Self { run, readings, at: 0 }
    }

    /// Another run, which takes the same readings.
    pub(crate) fn another(&self, graph: &Graph) -> Self {
        Self { readings: self.readings.clone(), ..Self::of(graph, Limits::default()) }
    }

    pub(crate) fn next(&mut self, out: &mut impl FnMut(Emission)) {
        let (stream, value) = &self.readings[self.at % self.readings.len()];
        self.at += 1;
        self.run.feed(Millis(self.at as u64), *stream, value.clone(), out);
    }
}

fn play(graph: &Graph, compiled: bool) -> Way {
    let mut playing = Playing::of(graph, Limits { compiled, ..Limits::default() });
    Box::new(move |events| {
        let mut outputs = 0_u64;
        for _ in 0..events {
            playing.next(&mut |emission| {
                outputs += 1;
                hear(&emission);
            });
        }
        black_box(outputs);
    })
}

/// Takes of an emission what a live run takes: nobody there asks for its trigger.
#[inline(always)]
fn hear(emission: &Emission) {
    match emission {
        Emission::Value { at, stream, value, .. } => drop(black_box((at, stream, value))),
        Emission::Fault { at, connector, error, .. } => drop(black_box((at, connector, error))),
    }
}

/// For every leaf what it carries while the others warm up.
fn wanted(graph: &Graph) -> Json {
    let leaves = graph.leaves();
    let mut playing = Playing::of(graph, Limits::default());
    let mut said: Map<String, Json> = Map::new();
    for _ in 0..WARM_CYCLES * graph.readings.len() as u64 {
        playing.next(&mut |emission| {
            if let Emission::Value { stream, value, .. } = emission
                && let Some(leaf) = leaves.iter().find(|leaf| **leaf == graph.file.streams[stream.index()].id)
            {
                let heard = said.entry(leaf.clone()).or_insert_with(|| json!([]));
                heard.as_array_mut().unwrap().push(json!(value));
            }
        });
    }
    said.into()
}

fn outputs_of_cycle(graph: &Graph) -> u64 {
    let mut playing = Playing::of(graph, Limits::default());
    let heard = |run: &Run| {
        let counts = graph.leaves().into_iter().map(|leaf| run.stats().streams[run.stream_index(&leaf).unwrap()].count);
        counts.sum::<u64>()
    };
    let mut before = 0;
    for cycle in 0..=WARM_CYCLES {
        before = if cycle == WARM_CYCLES { heard(&playing.run) } else { 0 };
        (0..graph.readings.len()).for_each(|_| playing.next(&mut |_| {}));
    }
    heard(&playing.run) - before
}

/// True if both are equal, where whole and measured numbers are one kind.
fn is_same(one: &Json, other: &Json) -> bool {
    match (one, other) {
        (Json::Number(one), Json::Number(other)) => one.as_f64() == other.as_f64(),
        (Json::Array(one), Json::Array(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| is_same(one, other))
        }
        (Json::Object(one), Json::Object(other)) => {
            let known = |(name, one): (&String, &Json)| other.get(name).is_some_and(|other| is_same(one, other));
            one.len() == other.len() && one.iter().all(known)
        }
        (one, other) => one == other,
    }
}

/// Returns the number of events that take the time of one pass; whole cycles of readings.
fn enough(runner: &mut Runner, cycle: u64) -> u64 {
    let mut events = cycle;
    loop {
        let nanos = (runner.time)(events);
        if nanos > NANOS / 4 {
            return (events * NANOS / nanos / cycle).max(1) * cycle;
        }
        events *= 2;
    }
}

fn print(graph: &str, runners: &[Runner]) {
    println!(
        "{graph:<22}{:>14}{:>12}{:>13}{:>15}{:>10}{:>17}",
        "events/cpu s", "ns/event", "memory KiB", "compiled is x", "at least", "Rhai alone is x"
    );
    let rates: Vec<f64> = runners.iter().map(|runner| median(runner.rates.clone())).collect();
    for (runner, rate) in runners.iter().zip(&rates) {
        let memory = memory_kib(&runner.process).map_or_else(|| "?".to_owned(), |kib| kib.to_string());
        let least = least(graph, runner.name).map_or_else(String::new, |least| least.to_string());
        print!("  {:<20}{rate:>14.0}{:>12.1}{memory:>13}", runner.name, 1e9 / rate);
        println!("{:>15.3}{least:>10}{:>17.3}", rates[0] / rate, rates[1] / rate);
        judge(graph, runner.name, rates[0] / rate, rates[1] / rate);
    }
}

fn judge(graph: &str, other: &str, compiled: f64, by_rhai: f64) {
    if let Some(least) = least(graph, other) {
        verdict::at_least(&format!("{graph} beside {other}"), compiled, least);
    }
    if other == "RxPY" {
        verdict::at_least(&format!("{graph} by Rhai alone beside {other}"), by_rhai, RHAI_LEAST);
    }
}

/// Returns the least factor over another's rate that ours must have.
fn least(graph: &str, other: &str) -> Option<f64> {
    match (other, graph) {
        ("RxJS", "chain10") => Some(4.0),
        ("RxJS", "tracking") => Some(1.5),
        ("RxJS", "fanout100") => Some(2.5),
        ("RxJS", "merge100") => Some(3.0),
        ("RxPY", _) => Some(30.0),
        ("Node-RED", _) => Some(200.0),
        _ => None,
    }
}
