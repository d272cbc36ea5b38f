//! The figures with a bar of their own besides events per second: many behaviours at once, memory, start, an event a
//! millisecond.

use crate::clock::{cpu_of, median, memory_kib, share};
use crate::graphs::Graph;
use crate::peers;
use crate::race::Playing;
use crate::verdict;
use engine::{Limits, Run};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// The number of times that each is measured.
const PASSES: usize = 5;
/// Behaviours that run at once.
const BEHAVIOURS: usize = 1_000;
/// Readings a second that each of them gets.
const RATE: usize = 100;
/// Connectors of the large graph.
const CONNECTORS: usize = 10_000;
/// Readings of one paced pass, one a millisecond.
const PACED: u64 = 1_000;

/// Measures all of them on the tracking graph and on a long chain, and prints them beside their bars.
pub(crate) fn bars(tracking: &Graph, chain_of: impl Fn(usize) -> Graph) {
    println!("{:<58}{:>12}{:>12}", "tracking behaviours", "measured", "at most");
    many(tracking);
    start("start of the tracking graph, ms", 1.0, tracking, 200);
    let large = chain_of(CONNECTORS);
    start("start of 10,000 connectors, ms", 100.0, &large, 1);
    large_memory(&large);
    paced(tracking);
}

fn line(what: &str, measured: f64, bar: f64) {
    println!("  {what:<56}{measured:>12.3}{bar:>12.3}");
    verdict::at_most(what, measured, bar);
}

fn build(graph: &Graph) -> Run {
    Run::build(&graph.file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap()
}

/// A second of a thousand behaviours, in turn, so that none finds its data in the cache.
fn many(graph: &Graph) {
    // One first, for what is made once a thread.
    let mut first = Playing::of(graph, Limits::default());
    first.next(&mut |_| {});
    let before = memory_kib("self");
    let mut all: Vec<_> = (0..BEHAVIOURS).map(|_| first.another(graph)).collect();
    let second = |all: &mut Vec<Playing>| {
        for _ in 0..RATE {
            all.iter_mut().for_each(|playing| playing.next(&mut |emission| _ = black_box(&emission)));
        }
    };
    second(&mut all);
    let kib = memory_kib("self").zip(before).map(|(after, before)| (after - before) as f64 / BEHAVIOURS as f64);
    let passes = (0..PASSES).map(|_| cpu_of(|| second(&mut all)) as f64 / 1e9 * 100.0);
    line("1,000 behaviours x 100 events/s, % of one core", median(passes.collect()), 15.0);
    line("memory of a running one, KiB", kib.unwrap_or(f64::NAN), 20.0);
}

fn start(what: &str, bar_ms: f64, graph: &Graph, times: u64) {
    let one = || cpu_of(|| (0..times).for_each(|_| drop(black_box(build(graph))))) as f64 / times as f64 / 1e6;
    line(what, median((0..PASSES).map(|_| one()).collect()), bar_ms);
}

fn large_memory(large: &Graph) {
    let before = memory_kib("self");
    // Several at once, so that what the starts before left behind does not count as free.
    let mut runs: Vec<_> = (0..PASSES).map(|_| Playing::of(large, Limits::default())).collect();
    runs.iter_mut().for_each(|playing| playing.next(&mut |_| {}));
    let kib = memory_kib("self").zip(before).map(|(after, before)| (after - before) as f64);
    let streams = (PASSES * CONNECTORS) as f64;
    line("memory of a stream with its connector at 10,000, KiB", kib.map_or(f64::NAN, |kib| kib / streams), 1.5);
}

/// One reading a millisecond: how long it takes from the reading to the last output, beside RxPY in turn.
fn paced(graph: &Graph) {
    let mut playing = Playing::of(graph, Limits::default());
    let mut others = peers::all(graph);
    let (mut ours, mut theirs) = (Vec::new(), vec![Vec::new(); others.len()]);
    for _ in 0..PASSES {
        ours.push(paced_pass(&mut playing));
        theirs.iter_mut().zip(&mut others).for_each(|(theirs, other)| theirs.push(other.paced(PACED)));
    }
    println!("  one event a millisecond, service in ns{:>18}{:>12}{:>12}", "p50", "p99", "p99.9");
    let own_p99 = tell("ours", &ours);
    for (other, theirs) in others.iter().zip(&theirs) {
        let p99 = tell(other.name, theirs);
        if other.name == "RxPY" {
            line("our p99 / RxPY's p99", own_p99 / p99, 0.3);
        }
    }
}

fn paced_pass(playing: &mut Playing) -> Vec<f64> {
    let one = |_| {
        std::thread::sleep(Duration::from_millis(1));
        let before = Instant::now();
        playing.next(&mut |emission| _ = black_box(&emission));
        before.elapsed().as_nanos() as f64
    };
    (0..PACED).map(one).collect()
}

/// Prints medians of the passes and gives that of the 99th percentile.
fn tell(name: &str, passes: &[Vec<f64>]) -> f64 {
    let [p50, p99, p999] =
        [500, 990, 999].map(|part| median(passes.iter().map(|p| share(p.clone(), part, 1000)).collect()));
    println!("    {name:<53}{p50:>12.0}{p99:>12.0}{p999:>12.0}");
    p99
}
