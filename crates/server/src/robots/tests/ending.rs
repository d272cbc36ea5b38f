//! What ends when one of several behaviours on a robot ends: what it does, and nothing of the others.

use super::puppet::Puppet;
use super::{filtered, id, phase, shows_until_told, stopped_by, until};
use crate::recordings::Recordings;
use crate::robots::{Robots, StartOrder};
use behaviour::{Params, Value};
use engine::Limits;
use protocol::RunPhase;
use std::sync::Arc;

#[tokio::test]
async fn the_robot_is_told_which_uses_end_and_holds_only_with_the_last() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let one = robots.start(filtered("one", "true")).await.unwrap();
    let two = robots.start(filtered("two", "true")).await.unwrap();
    shows_until_told(&puppet, &one, 5).await;
    let stops = puppet.stops();
    assert!(robots.stop(Some(&id("one")), "Ben"));
    until("only the other uses the robot", || puppet.users() == [two.run].into()).await;
    shows_until_told(&puppet, &two, 6).await;
    assert_eq!((puppet.stops(), phase(&robots, &one)), (stops, stopped_by("Ben")), "the other is not disturbed");
    assert!(robots.stop(Some(&id("two")), "Ben"));
    until("nobody is left", || puppet.users().is_empty() && puppet.stops() > stops).await;
}

#[tokio::test]
async fn what_replaces_a_behaviour_and_what_faults_disturb_nobody_else() {
    let puppet = Puppet::default();
    let robots = puppet.robots(|| Limits { operations: u64::MAX, ..Limits::default() });
    let good = robots.start(filtered("good", "true")).await.unwrap();
    robots.start(filtered("bad", "true")).await.unwrap();
    let bad = robots.start(filtered("bad", "if ball == 1 { loop { } } true")).await.unwrap();
    let stops = puppet.stops();
    until("it ends by itself", || {
        if phase(&robots, &bad) == RunPhase::Running {
            robots.stimulate(&id("bad"), &id("ball"), Value::Int(1), "Ben").unwrap_or_default();
        }
        matches!(phase(&robots, &bad), RunPhase::Faulted(_))
    })
    .await;
    until("its devices are given back", || puppet.users() == [good.run].into()).await;
    shows_until_told(&puppet, &good, 6).await;
    assert_eq!(puppet.stops(), stops);
}

/// A behaviour that says a text of fifty words whenever a ball comes.
fn speaking(name: &str) -> StartOrder {
    let start = filtered(name, "true");
    let mut file = (*start.file).clone();
    file.streams[2].device = Some("SayParameter".to_owned());
    let text = Value::text(format!("{name} {}", "word ".repeat(50).trim()));
    file.streams[2].params = Some(Params::from([("text".to_owned(), text)]));
    StartOrder { file: Arc::new(file), ..start }
}

#[tokio::test]
async fn a_behaviour_speaks_on_while_its_neighbour_is_stopped() {
    let robots = Robots::within(None, (1, 0), Recordings::default()).unwrap();
    let nao = robots.meant(None).unwrap();
    nao.start(speaking("story")).await.unwrap();
    nao.start(speaking("other")).await.unwrap();
    let saying = || nao.scene().borrow().body.saying.clone();
    nao.stimulate(&id("story"), &id("ball"), Value::Int(1), "Ben").unwrap();
    until("it speaks", || saying().starts_with("story")).await;
    assert!(nao.stop(Some(&id("other")), "Ben"));
    // The robot has done what is in its queue before it shows a ball that moves afterwards.
    let at = [0.9, 0.4, 0.3];
    nao.edit_scene(robot::SceneEdit::MoveBall { id: "red".to_owned(), at });
    let is_there = |ball: &robot::Ball| (ball.at[0] - at[0]).abs() < 0.01;
    until("time passes", || nao.scene().borrow().balls.iter().any(is_there)).await;
    assert!(saying().starts_with("story"), "{}", saying());
    assert!(nao.stop(Some(&id("story")), "Ben"));
    until("it is silent", || saying().is_empty()).await;
    robots.shut_down();
}
