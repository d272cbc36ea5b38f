//! Starting, running side by side, replacing, stimulating, watching.

use super::puppet::Puppet;
use super::{filtered, id, phase, shows_until_told, stopped_by, until};
use crate::robots::SeenLive;
use behaviour::Value;
use engine::Limits;
use protocol::{Refused, RunPhase};

#[tokio::test]
async fn a_reading_becomes_a_command() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "ball > 3")).await.unwrap();
    assert_eq!((run.name.as_str(), run.revision, run.by.as_str()), ("one", 1, "Aiko"));
    puppet.show_ball(Value::Int(2));
    shows_until_told(&puppet, &run, 5).await;
    assert!(!puppet.told(run.run).contains(&Value::Int(2)));
    assert!(robots.is_running(&id("one")));
}

#[tokio::test]
async fn what_cannot_start_says_why() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    assert!(robots.start(filtered("one", "ball >")).await.is_err());
    puppet.refuse("Print");
    assert_eq!(
        robots.start(filtered("one", "true")).await.unwrap_err().to_string(),
        "“page”: this robot has no device called “Print”"
    );
    assert!(!robots.is_running(&id("one")) && robots.runs().borrow().is_empty());
    until("the devices are given back", || puppet.users().is_empty()).await;
}

#[tokio::test]
async fn two_behaviours_run_side_by_side_and_stop_alone() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let one = robots.start(filtered("one", "ball > 3")).await.unwrap();
    let two = robots.start(filtered("two", "ball > 4")).await.unwrap();
    shows_until_told(&puppet, &one, 9).await;
    shows_until_told(&puppet, &two, 8).await;
    assert!(robots.stop(Some(&id("one")), "Ben"));
    assert_eq!((phase(&robots, &one), phase(&robots, &two)), (stopped_by("Ben"), RunPhase::Running));
    until("only the other uses the robot", || puppet.users() == [two.run].into()).await;
    shows_until_told(&puppet, &two, 7).await;
}

#[tokio::test]
async fn starting_again_replaces_and_a_bad_start_does_not() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let first = robots.start(filtered("one", "ball > 3")).await.unwrap();
    assert!(robots.start(filtered("one", "ball >")).await.is_err());
    assert_eq!(phase(&robots, &first), RunPhase::Running);
    let second = robots.start(filtered("one", "ball < 3")).await.unwrap();
    assert_eq!(phase(&robots, &first), stopped_by("Aiko"));
    shows_until_told(&puppet, &second, 1).await;
    until("the first gave back its devices", || puppet.users() == [second.run].into()).await;
}

#[tokio::test]
async fn a_stimulus_reaches_the_sensor_stream_only() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let stimulate = |stream| robots.stimulate(&id("one"), &id(stream), Value::Int(42), "Ben");
    assert_eq!(stimulate("ball"), Err(Refused::NotRunning));
    let run = robots.start(filtered("one", "true")).await.unwrap();
    assert_eq!(stimulate("good"), Err(Refused::NoSensor));
    assert_eq!(stimulate("ball"), Ok(()));
    until("the command", || puppet.told(run.run) == [Value::Int(42)]).await;
}

#[tokio::test]
async fn values_tell_what_is_new() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "ball > 3")).await.unwrap();
    let (live, mut seen) = (robots.values(run.run).unwrap(), SeenLive::default());
    assert!(robots.values(run.run + 1).is_none());
    robots.stimulate(&id("one"), &id("ball"), Value::Int(5), "Ben").unwrap();
    let mut values = None;
    until("they are told", || {
        values = live.since(&mut seen);
        values.is_some()
    })
    .await;
    let values = values.unwrap();
    assert_eq!(values.run, run.run);
    let counts: Vec<_> =
        values.streams.iter().map(|s| (s.stream.as_str().to_owned(), s.count, s.value.clone())).collect();
    let five = |stream: &str| (stream.to_owned(), 1, Value::Int(5));
    assert_eq!(counts, [five("ball"), five("good"), five("page")]);
    assert!(values.streams.iter().all(|sample| sample.rate > 0.0));
    assert_eq!(values.connectors.iter().map(|c| (c.fired, c.faults)).collect::<Vec<_>>(), [(1, 0), (1, 0)]);
}

#[tokio::test]
async fn a_fault_and_a_command_that_the_robot_drops_are_shown_on_their_connectors() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "ball.x == () || true")).await.unwrap();
    let live = robots.values(run.run).unwrap();
    let error_of = |connector: &str| {
        let values = live.since(&mut SeenLive::default())?;
        values.connectors.into_iter().find(|sample| sample.connector == id(connector))?.error
    };
    robots.stimulate(&id("one"), &id("ball"), Value::Int(5), "Ben").unwrap();
    until("the fault of the filter", || error_of("test").is_some()).await;
    let run = robots.start(filtered("one", "true")).await.unwrap();
    let live = robots.values(run.run).unwrap();
    robots.stimulate(&id("one"), &id("ball"), Value::Int(13), "Ben").unwrap();
    let dropped = || {
        let values = live.since(&mut SeenLive::default())?;
        values.connectors.into_iter().find(|sample| sample.connector == id("show"))?.error
    };
    until("the dropped command", || dropped() == Some("this action needs a number".into())).await;
}

#[tokio::test]
async fn the_rate_of_a_silent_stream_fades() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "true")).await.unwrap();
    let live = robots.values(run.run).unwrap();
    let rate = || Some(live.since(&mut SeenLive::default())?.streams.first()?.rate);
    // Told again until it is seen: on a busy machine the rate of one value may fade before anybody looks.
    let told = || robots.stimulate(&id("one"), &id("ball"), Value::Int(5), "Ben").unwrap();
    until("a rate", || {
        told();
        rate().is_some_and(|rate| rate > 0.0)
    })
    .await;
    until("no rate", || rate() == Some(0.0)).await;
}

#[tokio::test]
async fn only_the_last_ended_runs_are_remembered() {
    let robots = Puppet::default().robots(Limits::default);
    for _ in 0..19 {
        robots.start(filtered("one", "true")).await.unwrap();
    }
    let runs = robots.runs().borrow().clone();
    assert_eq!(runs.iter().map(|run| run.run).collect::<Vec<_>>(), (3..=19).collect::<Vec<_>>());
    assert_eq!(runs.iter().filter(|run| run.phase == RunPhase::Running).count(), 1);
}

#[tokio::test]
async fn too_many_behaviours_are_refused() {
    let robots = Puppet::default().robots(Limits::default);
    for number in 0..16 {
        robots.start(filtered(&format!("b{number}"), "true")).await.unwrap();
    }
    assert!(robots.start(filtered("one-more", "true")).await.unwrap_err().to_string().starts_with("too many"));
}
