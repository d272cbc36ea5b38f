//! `rrp bench`: how fast one behaviour runs on this machine, as one line of JSON.

use crate::LineCommand;
use crate::failure::Failure;
use crate::program::read_program;
use crate::replay::{ReplayRefused, parse_trace, refused};
use crate::trace::{TraceReading, no_readings, read_trace};
use behaviour::BehaviourFile;
use clap::Args;
use engine::{Limits, Run};
use robot::Millis;
use serde::Serialize;
use server::PageFiles;
use std::hint::black_box;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// The most times that a trace is played.
const REPEAT_MAX: u64 = 1_000_000_000;
/// Events that are timed one by one.
const TIMED_MAX: usize = 1_000_000;
/// How often the behaviour is built; the median counts.
const BUILDS: usize = 9;

/// Plays a trace through a behaviour again and again and prints one line of JSON about it.
///
/// events: readings that were played. cpu_s: CPU time of playing them, in seconds (wall time where the system does not
/// tell CPU time). p50_ns, p99_ns: how long one reading took, from being fed to the last output: the middle one, and the
/// one that 99 of 100 do not exceed. rss_kib: memory of this process (null where the system does not tell). build_us:
/// how long Start takes in the engine, in microseconds.
///
/// Exit codes: 0 done; 2 the behaviour is refused; 3 the trace is refused.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp bench --behaviour tracking.json --trace morning.jsonl --repeat 1000")]
pub(crate) struct BenchArgs {
    /// The behaviour, rrp-behaviour/1 as JSON or XML.
    #[arg(long, value_name = "FILE")]
    behaviour: PathBuf,
    /// The readings, one JSON object a line, or a recording of a run; - reads standard input.
    #[arg(long, value_name = "FILE|-")]
    trace: PathBuf,
    /// How often the trace is played, each time after the last.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=REPEAT_MAX))]
    repeat: u64,
    /// Leaves all procedures to Rhai, compiling none.
    #[arg(long)]
    interpreted: bool,
}

impl LineCommand for BenchArgs {
    const EXAMPLES: &'static [&'static str] =
        &["rrp bench --behaviour tracking.json --trace morning.jsonl --repeat 1000"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        bench(&self)
    }
}

/// What is printed.
#[derive(Debug, Serialize)]
struct BenchFigures {
    events: u64,
    cpu_s: f64,
    p50_ns: u64,
    p99_ns: u64,
    rss_kib: Option<u64>,
    build_us: f64,
}

/// Measures, prints, and answers with the exit code.
fn bench(args: &BenchArgs) -> ExitCode {
    match prepare(args) {
        Ok((file, readings)) => match measure(args, &file, &readings) {
            Ok(measured) => {
                let line = serde_json::to_string(&measured).unwrap_or_default();
                // Whoever reads may be gone, and that is no failure.
                let _ = writeln!(std::io::stdout(), "{line}");
                ExitCode::SUCCESS
            }
            Err(reason) => refused(reason),
        },
        Err(reason) => refused(reason),
    }
}

fn prepare(args: &BenchArgs) -> Result<(BehaviourFile, Vec<TraceReading>), ReplayRefused> {
    let behaviour = |failure| ReplayRefused::Behaviour(vec![failure]);
    let file = read_program(&args.behaviour).map_err(behaviour)?;
    let run = build(args, &file)?;
    let text = read_trace(&args.trace).map_err(ReplayRefused::Trace)?;
    let readings = parse_trace(&text, &run).map_err(ReplayRefused::Trace)?;
    if readings.is_empty() {
        return Err(ReplayRefused::Trace(no_readings()));
    }
    Ok((file, readings))
}

fn build(args: &BenchArgs, file: &BehaviourFile) -> Result<Run, ReplayRefused> {
    let limits = Limits { compiled: !args.interpreted, ..Limits::default() };
    Run::build(file, limits).map_err(ReplayRefused::engine)
}

fn measure(args: &BenchArgs, file: &BehaviourFile, readings: &[TraceReading]) -> Result<BenchFigures, ReplayRefused> {
    let mut builds = Vec::new();
    for _ in 0..BUILDS {
        let before = Instant::now();
        drop(black_box(build(args, file)?));
        builds.push(before.elapsed());
    }
    let mut trace = BenchTrace { readings, after_ms: 0 };
    let mut run = build(args, file)?;
    let before = spent();
    (0..args.repeat).for_each(|_| trace.play(&mut run));
    let cpu = spent().saturating_sub(before);
    if let Some(reason) = run.fault() {
        return Err(ReplayRefused::Behaviour(vec![Failure::of(reason)]));
    }
    let mut took = trace.timed(&mut run, args.repeat);
    Ok(BenchFigures {
        events: args.repeat.saturating_mul(readings.len() as u64),
        cpu_s: cpu.as_secs_f64(),
        p50_ns: nanos(share(&mut took, 50)),
        p99_ns: nanos(share(&mut took, 99)),
        rss_kib: memory_kib(),
        build_us: share(&mut builds, 50).as_secs_f64() * 1e6,
    })
}

/// The readings, one time after the other in logical time.
struct BenchTrace<'r> {
    readings: &'r [TraceReading],
    /// The end of the last time.
    after_ms: u64,
}

impl BenchTrace<'_> {
    fn play(&mut self, run: &mut Run) {
        for reading in self.readings {
            self.feed(run, reading);
        }
        self.next_time();
    }

    fn feed(&self, run: &mut Run, (at, stream, value): &TraceReading) {
        let at = Millis(self.after_ms.saturating_add(at.0));
        run.feed(at, *stream, value.clone(), &mut |emission| _ = black_box(&emission));
    }

    fn next_time(&mut self) {
        let length = self.readings.last().map_or(0, |(at, ..)| at.0.saturating_add(1));
        self.after_ms = self.after_ms.saturating_add(length);
    }

    /// How long each reading takes.
    fn timed(&mut self, run: &mut Run, repeat: u64) -> Vec<Duration> {
        let mut took = Vec::new();
        for _ in 0..repeat {
            for reading in self.readings {
                let before = Instant::now();
                self.feed(run, reading);
                took.push(before.elapsed());
                if took.len() == TIMED_MAX {
                    return took;
                }
            }
            self.next_time();
        }
        took
    }
}

/// The smallest one that so many of a hundred do not exceed.
fn share(measured: &mut [Duration], percent: usize) -> Duration {
    measured.sort_unstable();
    let at = (measured.len() * percent).div_ceil(100).saturating_sub(1);
    measured.get(at).copied().unwrap_or_default()
}

fn nanos(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}

/// CPU time of this thread so far; the clock where the system does not tell.
fn spent() -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanos = told.and_then(|text| text.split_whitespace().next()?.parse().ok());
    let clock = || std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    nanos.map_or_else(clock, Duration::from_nanos)
}

/// Memory of this process, where the system tells.
fn memory_kib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::share;
    use std::time::Duration;

    #[test]
    fn the_99th_percent_is_exceeded_by_one_of_a_hundred() {
        let mut all: Vec<_> = (1..=200).rev().map(Duration::from_nanos).collect();
        assert_eq!(share(&mut all, 99), Duration::from_nanos(198));
        assert_eq!(share(&mut all, 50), Duration::from_nanos(100));
        assert_eq!(share(&mut [Duration::from_nanos(7)], 99), Duration::from_nanos(7));
    }
}
