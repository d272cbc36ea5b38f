//! Tests of actions by hand: above every program, under the robot's limits and Stop, and recorded with who pressed.

use super::puppet::Puppet;
use super::recording::{lines, recorded, text};
use super::together::head;
use super::{id, until};
use crate::recordings::Recordings;
use crate::robots::{ByHand, Host};
use crate::support::lock;
use behaviour::{Params, Value};
use engine::Limits;
use protocol::{BY_HAND, HAND_MAX_BYTES, Refused};
use std::sync::{Mutex, mpsc};
use std::task::{Context, Waker};

mod courses;

fn by_hand(device: &str, value: Value) -> ByHand {
    ByHand { device: device.to_owned(), params: Params::default(), value, by: "Aiko".to_owned() }
}

async fn why_not(robots: &Host, hand: ByHand) -> String {
    robots.hand(hand, None).await.unwrap_err().to_string()
}

#[tokio::test]
async fn a_hand_is_above_every_program_and_recorded_with_who_pressed() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let run = robots.start(recorded(head("one"))).await.unwrap();
    robots.stimulate(&id("one"), &id("ball"), Value::Int(1), "Ben").unwrap();
    until("the program holds the head", || puppet.told(run.run) == [Value::Int(1)]).await;
    robots.hand(by_hand("Tracker", Value::text("here")), None).await.unwrap();
    assert_eq!(puppet.told(0), [Value::text("here")], "it takes the head at once");
    until("the program is held", || {
        robots.stimulate(&id("one"), &id("ball"), Value::Int(2), "Ben").unwrap();
        let runs = robots.runs().borrow().clone();
        runs.iter().any(|run| run.held.iter().any(|held| (held.by.as_str(), held.name.as_str()) == (BY_HAND, "Aiko")))
    })
    .await;
    assert_eq!(puppet.told(run.run), [Value::Int(1)], "nothing gets through");
    puppet.refuse("Print");
    assert!(why_not(&robots, by_hand("Print", Value::Int(3))).await.starts_with("That was not done: "));
    robots.stop(None, "Ben");
    until("nothing is done by hand any more", || puppet.users().is_empty()).await;
    let lines = lines(&recordings).await;
    let hands: Vec<_> = lines.iter().filter(|line| line.field("hand").is_some()).collect();
    assert_eq!((text(hands[0], "hand"), text(hands[0], "by")), (Some("Tracker"), Some("Aiko")));
    assert_eq!((text(hands[0], "value"), hands[0].field("why")), (Some("here"), None));
    assert!(text(hands[1], "hand") == Some("Print") && text(hands[1], "why").is_some(), "{hands:?}");
    let refused = lines.iter().find(|line| text(line, "refused") == Some("page")).unwrap();
    assert_eq!((text(refused, "why"), text(refused, "with")), (Some("the head is held by hand"), Some("Aiko")));
}

#[tokio::test]
async fn a_hand_that_cannot_be_says_why() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    assert!(why_not(&robots, by_hand("Dance", Value::Null)).await.contains("Dance"));
    let odd = ByHand {
        params: [("color".to_owned(), Value::Int(1))].into_iter().collect(),
        ..by_hand("Tracker", Value::Null)
    };
    assert!(why_not(&robots, odd).await.contains("color"));
    let large = by_hand("Print", Value::text("x".repeat(HAND_MAX_BYTES)));
    assert_eq!(why_not(&robots, large).await, "That was not done: what it is told has more than 4096 bytes; say less.");
    assert!(puppet.told(0).is_empty());
    robots.hand(by_hand("Print", Value::Int(7)), None).await.unwrap();
    assert_eq!(puppet.told(0), [Value::Int(7)], "without any program");
    // The robot's thread is busy until all of them are there.
    let (let_go, held) = mpsc::channel::<()>();
    let held = Mutex::new(held);
    puppet.when_told(move |_| {
        lock(&held).recv().ok();
    });
    let many = (0..64).map(|_| robots.hand(by_hand("Print", Value::Int(1)), None));
    let mut many = std::pin::pin!(futures_util::future::join_all(many));
    assert!(many.as_mut().poll(&mut Context::from_waker(Waker::noop())).is_pending());
    drop(let_go);
    let answers = many.await;
    assert!(answers.contains(&Err(Refused::TooFast)), "what may wait is bounded");
    assert!(answers.iter().any(Result::is_ok));
}
