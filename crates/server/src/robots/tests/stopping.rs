//! Stop, procedures that never end, robots that break, and the end.

use super::puppet::Puppet;
use super::{filtered, id, phase, shows_until_told, stopped_by, until};
use behaviour::Value;
use engine::Limits;
use protocol::RunPhase;
use robot::Health;

/// Without the engine's own limit only the deadline ends a procedure.
fn endless() -> Limits {
    Limits { operations: u64::MAX, ..Limits::default() }
}

const LOOP: &str = "if ball == 1 { loop { } } true";

#[tokio::test]
async fn stop_holds_the_robot_gives_back_its_devices_and_ends_the_thread() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    assert!(!robots.stop(None, "Ben"));
    let run = robots.start(filtered("one", "true")).await.unwrap();
    shows_until_told(&puppet, &run, 5).await;
    let stops = puppet.stops();
    assert!(robots.stop(None, "Ben"));
    assert_eq!(phase(&robots, &run), stopped_by("Ben"));
    assert!(!robots.is_running(&id("one")));
    until("the robot holds", || puppet.stops() > stops).await;
    let told = puppet.told(run.run).len();
    until("the devices and the thread are given back", || {
        puppet.show_ball(Value::Int(6));
        puppet.users().is_empty() && robots.shared().threads() == 0
    })
    .await;
    assert_eq!(puppet.told(run.run).len(), told, "nothing moves after Stop");
}

#[tokio::test]
async fn an_endless_loop_delays_neither_stop_nor_another_behaviour() {
    let puppet = Puppet::default();
    let robots = puppet.robots(endless);
    let bad = robots.start(filtered("bad", LOOP)).await.unwrap();
    let good = robots.start(filtered("good", "true")).await.unwrap();
    robots.stimulate(&id("bad"), &id("ball"), Value::Int(1), "Ben").unwrap();
    robots.stimulate(&id("good"), &id("ball"), Value::Int(7), "Ben").unwrap();
    until("the good one goes on", || puppet.told(good.run).contains(&Value::Int(7))).await;
    robots.stimulate(&id("bad"), &id("ball"), Value::Int(1), "Ben").unwrap();
    assert!(robots.stop(Some(&id("bad")), "Ben"));
    assert_eq!((phase(&robots, &bad), phase(&robots, &good)), (stopped_by("Ben"), RunPhase::Running));
    until("the thread of the bad one ends", || robots.shared().threads() == 1).await;
}

#[tokio::test]
async fn the_engine_ends_a_plain_loop_and_the_behaviour_goes_on() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", LOOP)).await.unwrap();
    robots.stimulate(&id("one"), &id("ball"), Value::Int(1), "Ben").unwrap();
    robots.stimulate(&id("one"), &id("ball"), Value::Int(2), "Ben").unwrap();
    until("the next value passes", || puppet.told(run.run) == [Value::Int(2)]).await;
    assert_eq!(phase(&robots, &run), RunPhase::Running);
}

#[tokio::test]
async fn three_procedures_in_a_row_that_take_too_long_end_the_behaviour_safely() {
    let puppet = Puppet::default();
    let robots = puppet.robots(endless);
    let run = robots.start(filtered("one", LOOP)).await.unwrap();
    let stops = puppet.stops();
    for value in [1, 1, 2, 1, 1, 1] {
        assert_eq!(phase(&robots, &run), RunPhase::Running);
        robots.stimulate(&id("one"), &id("ball"), Value::Int(value), "Ben").unwrap();
    }
    until("it ends", || phase(&robots, &run) != RunPhase::Running).await;
    let reason = "a procedure took too long three times; look at the one that makes “good”".to_owned();
    assert_eq!(phase(&robots, &run), RunPhase::Faulted(reason.into()));
    until("the robot holds", || puppet.stops() > stops && puppet.users().is_empty()).await;
    assert_eq!(puppet.told(run.run), [Value::Int(2)]);
}

#[tokio::test]
async fn a_robot_that_breaks_ends_its_runs_and_is_made_anew() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "true")).await.unwrap();
    puppet.fail();
    until("the run ends", || matches!(phase(&robots, &run), RunPhase::Faulted(_))).await;
    until("it is lost", || matches!(robots.shared().feed.robots().borrow()[0].health, Health::Lost(_))).await;
    until("it is there again", || {
        puppet.made() == 2 && robots.shared().feed.robots().borrow()[0].health == Health::Ready
    })
    .await;
    let run = robots.start(filtered("one", "true")).await.unwrap();
    shows_until_told(&puppet, &run, 5).await;
}

#[tokio::test]
async fn a_panic_ends_only_the_behaviour_that_caused_it() {
    let puppet = Puppet::default();
    let robots = puppet.robots(|| if std::thread::current().name() == Some("run-1") { panic!() } else { endless() });
    let failed = robots.start(filtered("bad", "true")).await;
    assert_eq!(failed.unwrap_err().to_string(), "it failed while it was prepared");
    let run = robots.start(filtered("good", "true")).await.unwrap();
    shows_until_told(&puppet, &run, 5).await;
    assert!(!robots.is_running(&id("bad")));
}

#[tokio::test]
async fn shutting_down_ends_every_thread() {
    let puppet = Puppet::default();
    let robots = puppet.robots(endless);
    let run = robots.start(filtered("one", LOOP)).await.unwrap();
    robots.stimulate(&id("one"), &id("ball"), Value::Int(1), "Ben").unwrap();
    let ended = robots.clone();
    tokio::task::spawn_blocking(move || ended.shut_down()).await.unwrap();
    assert_eq!(phase(&robots, &run), stopped_by("the server"));
    until("no thread lives", || robots.shared().threads() == 0).await;
    assert!(robots.owner.thread.lock().unwrap().is_none());
    robots.shut_down();
}
