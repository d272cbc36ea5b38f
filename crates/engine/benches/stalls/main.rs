//! The time for which a runaway procedure holds its thread: the hostile corpus under the product's limits, in CPU time.
//!
//! `cargo bench -p engine --bench stalls` prints the worst scripts, by what ended them, and fails if one is beyond its
//! bound. CPU time of this thread is counted, so that what else runs makes little difference; and as a shared machine is half
//! as quick again from one second to the next, sorting some numbers is timed beside each script, and a time is told as what it
//! would be where that takes what it should.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints, and may give up")]

#[path = "../../tests/hostile/scripts.rs"]
mod scripts;

use behaviour::Value;
use engine::{Limits, check_body, try_body};
use scripts::Verdict;
use std::hint::black_box;
use std::time::Duration;

/// The wall deadline of a procedure in a run.
const DEADLINE_MS: u64 = 20;
/// The longest stall of a procedure that the limit of steps ends.
const STEPS_BAR_MS: u64 = 2;
/// The longest stall of a procedure that only the deadline ends.
const DEADLINE_BAR_MS: u64 = 30;
/// All scripts run one after the other, this often; the middle run of each counts. Runs in a row would share what disturbs one.
const ROUNDS: usize = 15;
/// The count of numbers that are sorted to see how quick the machine is just now.
const NUMBERS: usize = 10_000;
/// The time to sort the numbers, in microseconds, on the machine that the bounds are for while nobody else is on it.
const SORTED_MICROS: f64 = 100.0;
/// The most lines of a list.
const SHOWN: usize = 12;

/// One script's stall.
struct Stall {
    micros: u64,
    body: &'static str,
}

fn main() {
    let scripts: Vec<_> = scripts::all().filter(|(_, verdict)| !matches!(verdict, Verdict::Refused(_))).collect();
    let round = || scripts.iter().map(|(body, _)| stall(body)).collect::<Vec<_>>();
    let rounds: Vec<_> = (0..ROUNDS).map(|_| round()).collect();
    let (mut by_steps, mut by_deadline, mut others) = (Vec::new(), Vec::new(), Vec::new());
    let mut ended = Vec::new();
    for (at, &&(body, verdict)) in scripts.iter().enumerate() {
        let mut runs: Vec<_> = rounds.iter().map(|round| &round[at]).collect();
        runs.sort_by_key(|(micros, _)| *micros);
        let (micros, reason) = runs[ROUNDS / 2];
        let list = match reason.as_deref() {
            Some(reason) if reason.contains("too many steps") => &mut by_steps,
            Some(reason) if reason.contains("took too long") => &mut by_deadline,
            _ => &mut others,
        };
        if verdict == Verdict::Endless && reason.is_none() {
            ended.push(body);
        }
        list.push(Stall { micros: *micros, body });
    }
    let all_within = [
        show("ended by the limit of steps", by_steps, STEPS_BAR_MS),
        show("ended by the deadline of 20 ms alone", by_deadline, DEADLINE_BAR_MS),
        show("ended by themselves or by another limit", others, DEADLINE_BAR_MS),
    ];
    ended.iter().for_each(|body| println!("ENDED, though it has no end: {body}"));
    std::process::exit(i32::from(all_within.contains(&false) || !ended.is_empty()));
}

/// Microseconds of CPU time of one call, were the machine as quick as it should be, and why it gave no value.
fn stall(body: &str) -> (u64, Option<String>) {
    let x = ["x".to_owned()];
    check_body(&x, body).unwrap();
    let slowness = sorting() / SORTED_MICROS;
    let begin = cpu();
    let limits = Limits::default().interrupted_by(move || cpu() - begin > Duration::from_millis(DEADLINE_MS));
    let made = try_body(&[], &x, body, &[Value::Int(1)], &limits);
    let micros = (cpu() - begin).as_secs_f64() * 1e6 / slowness;
    (micros as u64, made.err().map(|fault| fault.to_string()))
}

/// Microseconds of CPU time that sorting some numbers takes now.
fn sorting() -> f64 {
    let next = |last: &u32| Some(last.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mut numbers: Vec<u32> = std::iter::successors(Some(1), next).take(NUMBERS).collect();
    let begin = cpu();
    black_box(&mut numbers).sort_unstable();
    (cpu() - begin).as_secs_f64() * 1e6
}

/// Prints the worst of them; true if all are within the bar.
fn show(title: &str, mut stalls: Vec<Stall>, bar_ms: u64) -> bool {
    stalls.sort_by_key(|stall| std::cmp::Reverse(stall.micros));
    let within = stalls.iter().filter(|stall| stall.micros <= bar_ms * 1_000).count();
    println!("{title}: within {bar_ms} ms: {within} of {}", stalls.len());
    for Stall { micros, body } in stalls.iter().take(SHOWN) {
        println!("{micros:>9} us  {}", body.chars().take(100).collect::<String>());
    }
    println!();
    within == stalls.len()
}

/// CPU time of this thread; the clock where the system does not say.
#[cfg(unix)]
fn cpu() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(u64::try_from(time.tv_sec).unwrap(), u32::try_from(time.tv_nsec).unwrap())
}

#[cfg(not(unix))]
fn cpu() -> Duration {
    std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap()
}
