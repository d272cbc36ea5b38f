//! Events per CPU second of four graphs: compiled, by Rhai alone, and written in Rust.
//!
//! `cargo bench -p engine` prints a table; a name after `--` picks one graph. Passes are interleaved and medians shown, so ratios mean something even on
//! a busy machine.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints, and may give up")]

mod graphs;
mod hand;
mod streams;

use engine::{Limits, Run};
use graphs::{Graph, Way};
use robot::Millis;
use std::hint::black_box;

const PASSES: usize = 7;
/// CPU time of one measurement, about.
const NANOS: u64 = 60_000_000;

fn main() {
    println!("events per CPU second, and what the compiled tier is of the others");
    println!("{:<10}{:>12}{:>20}{:>20}{:>20}", "graph", "compiled", "rhai", "shared streams", "by hand");
    let only = std::env::args().nth(1).filter(|name| !name.starts_with('-'));
    for graph in graphs::all().into_iter().filter(|graph| only.as_ref().is_none_or(|only| graph.name == only)) {
        let [compiled, others @ ..] = measure(&graph);
        print!("{:<10}{compiled:>12.0}", graph.name);
        others.iter().for_each(|other| print!("{other:>13.0} {:>6.3}", compiled / other));
        println!();
    }
}

/// Median rates: compiled, Rhai alone, shared streams, by hand.
fn measure(graph: &Graph) -> [f64; 4] {
    let [shared, by_hand] = graph.by_hand;
    let mut ways: [Way; 4] = [run(graph, true), run(graph, false), shared(), by_hand()];
    let rounds: Vec<u64> = ways.iter_mut().map(enough).collect();
    let mut rates = [(); 4].map(|()| Vec::new());
    for _ in 0..PASSES {
        for ((way, rates), rounds) in ways.iter_mut().zip(&mut rates).zip(&rounds) {
            rates.push(*rounds as f64 * 1e9 / time(way, *rounds) as f64);
        }
    }
    rates.map(median)
}

/// A run that takes the readings of a graph in turn, a millisecond apart.
fn run(graph: &Graph, compiled: bool) -> Way {
    let limits = Limits { compiled, ..Limits::default() };
    let mut run = Run::build(&graph.file, limits).map_err(|faults| faults[0].to_string()).unwrap();
    let index = |stream: &str| run.stream_index(stream).unwrap();
    let readings: Vec<_> = graph.readings.iter().map(|(stream, value)| (index(stream), value.clone())).collect();
    let mut now = 0;
    Box::new(move |events| {
        let mut outputs = 0_u64;
        for (_, (stream, value)) in (0..events).zip(readings.iter().cycle()) {
            now += 1;
            run.feed(Millis(now), *stream, value.clone(), &mut |emission| {
                outputs += 1;
                black_box(&emission);
            });
        }
        black_box(outputs);
    })
}

/// How many events take the time of one measurement.
fn enough(way: &mut Way) -> u64 {
    let mut events = 1_000;
    loop {
        let nanos = time(way, events);
        if nanos > NANOS / 4 {
            return events * NANOS / nanos;
        }
        events *= 2;
    }
}

fn time(way: &mut Way, events: u64) -> u64 {
    let before = cpu_nanos();
    way(black_box(events));
    (cpu_nanos() - before).max(1)
}

/// What this process has computed so far; the clock where the system does not say.
fn cpu_nanos() -> u64 {
    let told = std::fs::read_to_string("/proc/self/schedstat").ok();
    let nanos = told.as_deref().and_then(|text| text.split_whitespace().next()?.parse().ok());
    let clock = || std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_nanos();
    nanos.unwrap_or_else(|| u64::try_from(clock()).unwrap())
}

fn median(mut rates: Vec<f64>) -> f64 {
    rates.sort_by(f64::total_cmp);
    rates[rates.len() / 2]
}
