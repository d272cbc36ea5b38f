//! How long the hand-overs between the threads take. A measurement and no check: `cargo xtask bench engine threads`
//! runs it in release, everybody else leaves it out.
//!
//! The robot's thread, the run's thread, command queue, mailbox and run table are the real ones; only the robot is one that notes
//! when, and steps like the simulated one. Its sense has read when the reading exists, after the step's computing; its
//! action is told when `Robot::command` is called. What a link to a real robot adds before and after that is not in
//! here, nor that what a robot is only asked for in its steps waits for the next one.
//!
//! Typical medians on two shared cores: 30 to 50 us from a reading to its action, which is two wake-ups (two bare threads
//! need 20 to 45 us); 0.1 ms from when a tick of `sample` is due to its action; below 0.1 ms from Stop to a robot that holds.
#![expect(clippy::print_stdout, reason = "a measurement prints")]

mod probe;

use super::{filtered, id};
use crate::robots::robot_thread::STEP_MS;
use crate::robots::{Host, StartOrder};
use behaviour::{BehaviourFile, FileConnector, StreamKind, Value};
use probe::{Probe, Told};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};
use tokio::runtime::Runtime;

/// Readings that are measured, each way.
const READINGS: usize = 2_000;
/// Time between two ticks in milliseconds.
const TICK_MS: u64 = 10;
/// Ticks that are measured.
const TICKS: usize = 2_000;
/// Stops that are measured.
const STOPS: usize = 500;
/// Pause between two readings around the ticks: they fall into every part of a millisecond and of a step.
const UNEVEN_US: u64 = 3_371;
/// Round trips between two bare threads that are measured, each after a pause of a robot's step.
const ROUND_TRIPS: usize = 500;
/// The last values get so long to arrive, in milliseconds.
const LAST_MS: u64 = 100;

#[test]
#[ignore = "measures for a minute; `cargo xtask bench engine threads` runs it"]
fn hand_overs() {
    println!("{:<58}{:>12}{:>12}{:>16}", "over the threads, us", "p50", "p99", "p50 at most");
    line("two bare threads, there and back: the machine's own part", bare(), None);
    line("a reading of the robot's step, until its action is told", in_steps(), Some(50.0));
    line("a reading a millisecond, until its action is told", paced(), Some(50.0));
    line("when a tick is due, until its action is told", ticks(), Some(300.0));
    line("Stop, until the robot is told to hold", stops(), Some(500_000.0));
}

fn line(what: &str, mut taken_us: Vec<f64>, bar_us: Option<f64>) {
    taken_us.sort_by(f64::total_cmp);
    let part = |hundredths: usize| taken_us[(taken_us.len() * hundredths / 100).min(taken_us.len() - 1)];
    let bar = bar_us.map_or_else(String::new, |us| format!("{us:.0}"));
    println!("  {what:<56}{:>12.1}{:>12.1}{bar:>16}", part(50), part(99));
}

/// A moment that another thread is told and hands back, both asleep before: what two hand-overs cost at least on this
/// machine.
fn bare() -> Vec<f64> {
    let (to, there) = mpsc::channel::<Instant>();
    let (back, from) = mpsc::channel();
    let other = std::thread::spawn(move || there.iter().try_for_each(|moment| back.send(moment)));
    let trip = |_| {
        std::thread::sleep(Duration::from_millis(STEP_MS));
        to.send(Instant::now()).unwrap();
        micros(from.recv().unwrap(), Instant::now())
    };
    let trips = (0..ROUND_TRIPS).map(trip).collect();
    drop(to);
    other.join().unwrap().unwrap();
    trips
}

/// Starts it and waits until it runs.
fn started(robots: &Host, start: StartOrder) {
    Runtime::new().unwrap().block_on(robots.start(start)).unwrap();
}

/// The robot reads in its own step, as the simulated one does.
fn in_steps() -> Vec<f64> {
    let (probe, start) = (Probe::default(), filtered("one", "true"));
    let robots = probe.robots();
    started(&robots, start);
    probe.beats(true);
    while probe.told() < READINGS {
        std::thread::sleep(Duration::from_millis(LAST_MS));
    }
    probe.beats(false);
    passages(&probe)
}

/// Another thread reads, at any time of the step.
fn paced() -> Vec<f64> {
    let (probe, start) = (Probe::default(), filtered("one", "true"));
    let robots = probe.robots();
    started(&robots, start);
    read_every(1_000, READINGS, &probe, &robots);
    passages(&probe)
}

fn read_every(pause_us: u64, times: usize, probe: &Probe, robots: &Host) {
    let began = Instant::now();
    for time in 0..times as u64 {
        let due = began + Duration::from_micros(time * pause_us);
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
        robots.stimulate(&id("one"), &id("ball"), probe.reads(), "Ben").unwrap();
    }
    std::thread::sleep(Duration::from_millis(LAST_MS));
}

/// From every reading to its command.
fn passages(probe: &Probe) -> Vec<f64> {
    let (read, told) = probe.take();
    let passage = |told: &Told| micros(read[number(&told.value)], told.at);
    told.iter().map(passage).collect()
}

/// How late the ticks of a sample reach their action.
fn ticks() -> Vec<f64> {
    let probe = Probe::default();
    let robots = probe.robots();
    started(&robots, ticking());
    read_every(UNEVEN_US, TICKS * 1_000 * TICK_MS as usize / UNEVEN_US as usize, &probe, &robots);
    let (read, told) = probe.take();
    let (ticks, readings): (Vec<_>, Vec<_>) = told.into_iter().partition(|told| told.stream == "voice");
    // Nobody says when logical time began, but the stamp t of a reading does: it had begun at most t + 1 ms before.
    // The closest of all readings is some microseconds too early, so that the ticks seem later than they are.
    let began = |told: &Told| read[number(told.value.field("v").unwrap())] - millis(stamp(told) + 1);
    let began = readings.iter().map(began).max().unwrap();
    ticks.iter().map(|told| micros(began + millis(stamp(told)), told.at)).collect()
}

/// Every reading with its time, and beside it every tick with its time.
fn ticking() -> StartOrder {
    let start = filtered("one", "true");
    let mut file = (*start.file).clone();
    add_stream(&mut file, "sampled", StreamKind::Ordinary);
    add_stream(&mut file, "stamped", StreamKind::Ordinary);
    add_stream(&mut file, "voice", StreamKind::Actuator);
    file.connectors[0] = FileConnector { body: None, ..file.connectors[0].clone() };
    file.connectors[0].operation = "timestamp".to_owned();
    for (operation, from, to) in
        [("sample", "ball", "sampled"), ("timestamp", "sampled", "stamped"), ("subscribe", "stamped", "voice")]
    {
        let plain = file.connectors[1].clone();
        let period_ms = (operation == "sample").then_some(TICK_MS);
        let (id, inputs) = (format!("{operation}-{to}"), vec![from.to_owned()]);
        let (operation, output) = (operation.to_owned(), to.to_owned());
        file.connectors.push(FileConnector { id, operation, inputs, output, period_ms, ..plain });
    }
    StartOrder { file: Arc::new(file), ..start }
}

fn add_stream(file: &mut BehaviourFile, name: &str, kind: StreamKind) {
    let mut stream = file.streams[2].clone();
    (stream.id, stream.name, stream.kind) = (name.to_owned(), name.to_owned(), kind);
    stream.device.take_if(|_| kind == StreamKind::Ordinary);
    file.streams.push(stream);
}

/// Stop at any time of the step, while a behaviour runs and the ball is read.
fn stops() -> Vec<f64> {
    let probe = Probe::default();
    let robots = probe.robots();
    probe.beats(true);
    (0..STOPS).map(|_| stop(&probe, &robots)).collect()
}

fn stop(probe: &Probe, robots: &Host) -> f64 {
    started(robots, filtered("one", "true"));
    std::thread::sleep(Duration::from_micros(UNEVEN_US));
    let moment = Instant::now();
    robots.stop(None, "Ben");
    let held = loop {
        match probe.held_after(moment) {
            Some(held) if robots.shared().threads() == 0 => break held,
            _ => std::thread::sleep(Duration::from_millis(1)),
        }
    };
    micros(moment, held)
}

fn number(value: &Value) -> usize {
    let Value::Int(number) = value else { panic!("readings are numbered") };
    usize::try_from(*number).unwrap()
}

/// The logical time that a timestamp gave a value.
fn stamp(told: &Told) -> u64 {
    number(told.value.field("t").unwrap()) as u64
}

fn millis(number: u64) -> Duration {
    Duration::from_millis(number)
}

/// Microseconds between two moments; less than nothing if the second was first.
fn micros(from: Instant, to: Instant) -> f64 {
    let after = to.saturating_duration_since(from).as_secs_f64() - from.saturating_duration_since(to).as_secs_f64();
    after * 1e6
}
