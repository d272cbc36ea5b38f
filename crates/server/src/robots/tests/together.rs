//! Several behaviours that want the same part of the robot: the upper one wins.

use super::puppet::Puppet;
use super::{filtered, id, until};
use crate::robots::{Host, StartOrder};
use behaviour::Value;
use engine::Limits;
use protocol::{HeldPart, Refused, RunState};
use std::sync::Arc;

/// A behaviour that moves the head, and holds it for longer than any test takes.
pub(super) fn head(name: &str) -> StartOrder {
    let start = filtered(name, "true");
    let mut file = (*start.file).clone();
    (file.streams[2].resources, file.streams[2].hold_ms) = (Some(vec!["head".to_owned()]), Some(600_000));
    StartOrder { file: Arc::new(file), ..start }
}

fn send(robots: &Host, name: &str, value: i64) {
    robots.stimulate(&id(name), &id("ball"), Value::Int(value), "Ben").unwrap();
}

fn state(robots: &Host, run: &RunState) -> RunState {
    let runs = robots.runs().borrow().clone();
    runs.iter().find(|known| known.run == run.run).unwrap().clone()
}

/// Waits until this run shows that the head is held by that behaviour.
async fn is_held(robots: &Host, run: &RunState, by: &str) {
    let wanted = [HeldPart { part: "head".to_owned(), stream: id("page"), by: id(by), name: by.to_owned() }];
    until("it is held", || {
        send(robots, &run.name, 1);
        state(robots, run).held == wanted
    })
    .await;
}

#[tokio::test]
async fn the_upper_one_wins_and_both_see_it() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let greeting = robots.start(head("greeting")).await.unwrap();
    let idle = robots.start(head("idle")).await.unwrap();
    let places = || [&greeting, &idle].map(|run| state(&robots, run).place);
    assert_eq!(places(), [0, 1], "who comes later stands below");
    send(&robots, "idle", 7);
    until("nobody holds the head yet", || puppet.told(idle.run) == [Value::Int(7)]).await;
    send(&robots, "greeting", 8);
    until("the upper one takes it", || puppet.told(greeting.run) == [Value::Int(8)]).await;
    is_held(&robots, &idle, "greeting").await;
    assert_eq!(puppet.told(idle.run), [Value::Int(7)], "nothing gets through");

    // People change their mind: from the next command on the other one wins.
    robots.place(&id("idle"), Some(&id("greeting"))).unwrap();
    assert_eq!(places(), [1, 0]);
    send(&robots, "idle", 9);
    until("now it takes the head", || puppet.told(idle.run).last() == Some(&Value::Int(9))).await;
    is_held(&robots, &greeting, "idle").await;

    // Who is stopped holds nothing any more; the other runs on.
    assert!(robots.stop(Some(&id("idle")), "Ben"));
    until("the head is free", || {
        send(&robots, "greeting", 10);
        puppet.told(greeting.run).last() == Some(&Value::Int(10))
    })
    .await;
    until("that is not shown any more", || state(&robots, &greeting).held.is_empty()).await;
}

#[tokio::test]
async fn who_never_ran_here_gets_no_place() {
    let robots = Puppet::default().robots(Limits::default);
    robots.start(head("one")).await.unwrap();
    for number in 0..20 {
        let stranger = id(&format!("stranger{number}"));
        assert_eq!(robots.place(&stranger, Some(&id("one"))), Err(Refused::NotRunning));
    }
    assert_eq!(robots.shared().order.place(&id("one")), 0, "nobody stands above it");
}

#[tokio::test]
async fn parts_that_nobody_shares_are_never_held() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let one = robots.start(head("one")).await.unwrap();
    let two = robots.start(filtered("two", "true")).await.unwrap();
    send(&robots, "one", 1);
    until("the first", || puppet.told(one.run) == [Value::Int(1)]).await;
    send(&robots, "two", 2);
    until("the second", || puppet.told(two.run) == [Value::Int(2)]).await;
    assert!(state(&robots, &two).held.is_empty());
}

#[tokio::test]
async fn stop_is_above_everything() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    robots.start(head("one")).await.unwrap();
    let two = robots.start(head("two")).await.unwrap();
    send(&robots, "one", 1);
    is_held(&robots, &two, "one").await;
    let stops = puppet.stops();
    assert!(robots.stop(None, "Ben"));
    until("the robot holds", || puppet.stops() > stops && puppet.users().is_empty()).await;
}
