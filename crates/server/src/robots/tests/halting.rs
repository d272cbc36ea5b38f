//! A robot that wants everything to end: it fell, is too hot, or its link is gone. And who has it.

use super::puppet::Puppet;
use super::{filtered, id, phase, shows_until_told, stopped_by, until};
use crate::robots::{Host, MarkPress, StartOrder};
use behaviour::Value;
use engine::Limits;
use protocol::{MarkEdit, MarkSort, RecordingMark, Refused, RunPhase, RunState};
use robot::Control;

#[tokio::test]
async fn everything_ends_with_the_robots_reason_and_nothing_goes_on_by_itself() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let one = robots.start(filtered("one", "true")).await.unwrap();
    let two = robots.start(filtered("two", "true")).await.unwrap();
    shows_until_told(&puppet, &one, 5).await;
    let stops = puppet.stops();
    puppet.halt("it fell");
    until("nobody uses the robot", || puppet.users().is_empty() && puppet.stops() > stops).await;
    for run in [&one, &two] {
        let RunPhase::Paused(why) = phase(&robots, run) else { panic!("{:?}", phase(&robots, run)) };
        assert!(why.to_string().starts_with("it fell") && why.to_string().contains("look after"), "{why}");
    }
    let again = robots.start(filtered("one", "true")).await.unwrap();
    shows_until_told(&puppet, &again, 6).await;
    assert_eq!(phase(&robots, &one), stopped_by("Aiko"), "another run goes on for it");
    assert!(matches!(phase(&robots, &two), RunPhase::Paused(_)));
}

/// A behaviour that shows the ball only where it is another one than before.
fn distinct(name: &str) -> StartOrder {
    let start = filtered(name, "true");
    let mut file = (*start.file).clone();
    (file.connectors[0].operation, file.connectors[0].body) = ("distinct".to_owned(), None);
    StartOrder { file: file.into(), ..start }
}

/// What the next run of it shows of a five and a six.
async fn shows_of_five_and_six(puppet: &Puppet, robots: &Host) -> (RunState, Vec<Value>) {
    let run = robots.start(distinct("one")).await.unwrap();
    for value in [5, 6] {
        robots.stimulate(&id("one"), &id("ball"), Value::Int(value), "Ben").unwrap();
    }
    until("the six comes out", || puppet.told(run.run).contains(&Value::Int(6))).await;
    let told = puppet.told(run.run);
    (run, told)
}

async fn interrupts(puppet: &Puppet, robots: &Host, run: &RunState) {
    puppet.halt("it fell");
    until("it is interrupted", || matches!(phase(robots, run), RunPhase::Paused(_))).await;
    until("its thread has ended", || robots.shared().threads() == 0).await;
}

#[tokio::test]
async fn what_the_robot_interrupts_goes_on_with_its_memory_unless_somebody_presses_stop() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let first = robots.start(distinct("one")).await.unwrap();
    shows_until_told(&puppet, &first, 5).await;
    interrupts(&puppet, &robots, &first).await;
    let (second, told) = shows_of_five_and_six(&puppet, &robots).await;
    assert_eq!(told, [Value::Int(6)], "the five is known");
    interrupts(&puppet, &robots, &second).await;
    assert!(robots.stop(None, "Ben"));
    assert_eq!(phase(&robots, &second), stopped_by("Ben"));
    let (third, told) = shows_of_five_and_six(&puppet, &robots).await;
    assert_eq!(told, [Value::Int(5), Value::Int(6)], "it began anew");
    // One that was stopped just before is not interrupted.
    assert!(robots.stop(Some(&id("one")), "Ben"));
    interrupted_late(&puppet, &robots, &third).await;
}

/// A behaviour that shows each time of day.
fn clock(name: &str) -> StartOrder {
    of_sense(name, "TimeOfDay")
}

/// A behaviour that shows each value of a sense.
fn of_sense(name: &str, device: &str) -> StartOrder {
    let start = filtered(name, "true");
    let mut file = (*start.file).clone();
    file.streams[0].device = Some(device.to_owned());
    StartOrder { file: file.into(), ..start }
}

/// Has the robot sense this, until the run was told a later value.
async fn senses(puppet: &Puppet, run: &RunState, values: [i64; 2]) -> Vec<Value> {
    values.into_iter().for_each(|value| puppet.show_ball(Value::Int(value)));
    until("the later one comes out", || puppet.told(run.run).contains(&Value::Int(values[1]))).await;
    puppet.told(run.run)
}

#[tokio::test]
async fn a_run_that_goes_on_hears_of_the_state_that_it_knows_no_second_time() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let first = robots.start(clock("one")).await.unwrap();
    assert_eq!(senses(&puppet, &first, [539, 540]).await, [539, 540].map(Value::Int));
    interrupts(&puppet, &robots, &first).await;
    let second = robots.start(clock("one")).await.unwrap();
    assert_eq!(senses(&puppet, &second, [540, 541]).await, [Value::Int(541)], "it is still the same minute");
    // A pretended reading is always meant.
    robots.stimulate(&id("one"), &id("ball"), Value::Int(541), "Ben").unwrap();
    until("it comes out", || puppet.told(second.run) == [541, 541].map(Value::Int)).await;
    assert!(robots.stop(None, "Ben"));
    let third = robots.start(clock("one")).await.unwrap();
    assert_eq!(senses(&puppet, &third, [541, 542]).await, [541, 542].map(Value::Int), "it began anew");
}

#[tokio::test]
async fn a_low_battery_is_told_again_to_a_run_that_goes_on() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let first = robots.start(of_sense("one", "Battery")).await.unwrap();
    assert!(senses(&puppet, &first, [5, 5]).await.ends_with(&[Value::Int(5)]));
    interrupts(&puppet, &robots, &first).await;
    // Nobody knows what the robot did for it.
    let second = robots.start(of_sense("one", "Battery")).await.unwrap();
    assert!(senses(&puppet, &second, [5, 5]).await.ends_with(&[Value::Int(5)]));
}

#[tokio::test]
async fn a_mark_that_is_changed_while_the_robot_interrupts_goes_on_as_it_is_then() {
    let (puppet, client) = (Puppet::default(), id("ben"));
    let robots = puppet.robots(Limits::default);
    let first = robots.start(distinct("one")).await.unwrap();
    let press = || MarkPress { by: "Ben", client: &client, at: std::time::Instant::now() };
    for name in ["smiles", "oops"] {
        let [word, note, by, at] = [name.to_owned(), String::new(), String::new(), String::new()];
        let (t, until, sort) = (0, None, MarkSort::Note);
        let mark = RecordingMark { id: id(name), t, until, word, sort, note, by, at, open: false, gone: false };
        robots.mark(&id("one"), mark, press()).unwrap();
    }
    interrupts(&puppet, &robots, &first).await;
    for (name, edit) in [("smiles", MarkEdit::Sort(MarkSort::Good)), ("oops", MarkEdit::Undo)] {
        robots.edit_mark(first.run, &id(name), edit, press()).unwrap().unwrap();
    }
    let second = robots.start(distinct("one")).await.unwrap();
    let marks: Vec<_> =
        robots.marks(second.run).unwrap().all().into_iter().map(|mark| (mark.word, mark.sort)).collect();
    assert_eq!(marks, [("smiles".to_owned(), MarkSort::Good)]);
}

async fn interrupted_late(puppet: &Puppet, robots: &Host, run: &RunState) {
    let stops = puppet.stops();
    puppet.halt("it is too hot");
    until("the robot has told it", || puppet.stops() >= stops && puppet.has_told_halt()).await;
    assert_eq!(phase(robots, run), stopped_by("Ben"));
}

#[tokio::test]
async fn giving_back_stops_what_runs_and_taking_control_does_not() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "true")).await.unwrap();
    robots.control(Control::Take, "Aiko").await.unwrap();
    for wish in [Control::WakeUp, Control::Stand, Control::Sit] {
        let refused = robots.control(wish, "Aiko").await.unwrap_err().to_string();
        assert!(refused.contains("a program runs on it; press Stop first"), "{refused}");
    }
    robots.control(Control::ForgetFaces, "Aiko").await.unwrap();
    assert_eq!(phase(&robots, &run), RunPhase::Running);
    robots.control(Control::GiveBack, "Aiko").await.unwrap();
    assert_eq!(phase(&robots, &run), RunPhase::Stopped("Aiko".to_owned()));
    let log = puppet.log();
    let at = |what: &str| log.iter().rposition(|line| line == what).unwrap();
    assert!(at("held") < at("GiveBack") && at("Take") < at("GiveBack"), "{log:?}");
    let refused = robots.control(Control::Rest, "Aiko").await.unwrap_err();
    assert!(matches!(&refused, Refused::RobotCannot(why) if why.to_string().contains("strings")), "{refused}");
}
