//! A robot that is being reached just now: a Start waits for it, and Stop does not.

use super::puppet::Puppet;
use super::{filtered, shows_until_told, until};
use crate::robots::Host;
use crate::robots::refusal::StartError;
use engine::Limits;
use protocol::RunState;
use robot::Health;
use tokio::task::JoinHandle;

/// Somebody presses Start.
fn starting(robots: &Host) -> JoinHandle<Result<RunState, StartError>> {
    let robots = robots.clone();
    tokio::spawn(async move { robots.start(filtered("one", "true")).await })
}

fn is_announced(robots: &Host) -> bool {
    robots.has(&super::id("one"))
}

#[tokio::test]
async fn a_start_waits_for_a_robot_that_is_being_reached() {
    let puppet = Puppet::default();
    puppet.connects(true);
    let robots = puppet.robots(Limits::default);
    let started = starting(&robots);
    until("it is on its way", || is_announced(&robots) && puppet.steps() > 20).await;
    assert!(!started.is_finished(), "it waits");
    puppet.connects(false);
    let run = started.await.unwrap().unwrap();
    shows_until_told(&puppet, &run, 5).await;
}

#[tokio::test]
async fn stop_ends_a_start_that_waits() {
    let puppet = Puppet::default();
    puppet.connects(true);
    let robots = puppet.robots(Limits::default);
    let started = starting(&robots);
    until("it is on its way", || is_announced(&robots)).await;
    robots.stop(None, "Ben");
    assert!(started.await.unwrap().is_err());
    puppet.connects(false);
    let health = || robots.shared().feed.robots().borrow()[0].health.clone();
    until("the robot is there", || health() == Health::Ready).await;
    assert_eq!(puppet.opened(), 0, "nothing is left of it");
}
