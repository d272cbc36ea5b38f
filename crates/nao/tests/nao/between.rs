//! Tests of what begins while a Stop is not over yet: it is neither broken off by that Stop nor forgotten by the next
//! one.

use crate::driver::{Driver, settings};
use crate::peer::Peer;
use crate::stops::is_calm;
use behaviour::Value;
use nao::Nao;
use robot::{Health, Millis, Robot, Use};
use serde_json::{Value as Json, json};

/// A Stop lasts so long at least, in milliseconds, when one of its answers comes late.
const LONG_MS: u64 = 600;

fn says(state: &Json, what: &str, word: &str) -> bool {
    state[what].to_string().contains(word)
}

/// The next answer to one of a Stop's calls comes late, so that the Stop lasts.
async fn linger(peer: &Peer, service: &str, method: &str) {
    peer.fault(json!({"do": "delay", "service": service, "method": method, "ms": LONG_MS})).await;
}

/// Tells it to walk until it does, which is not before every Stop is over.
async fn walks(driver: &mut Driver, peer: &Peer, walk: &Use) {
    while peer.state().await["moving"] != json!(true) {
        driver.tell(walk, 0.05);
        driver.step().await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn no_step_begins_before_a_stop_is_over() {
    let Some(peer) = Peer::start("nao: a walk during a Stop", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    walks(&mut driver, &peer, &walk).await;
    peer.clear().await;
    // The legs hear their last word when this is answered.
    linger(&peer, "ALMotion", "moveIsActive").await;
    driver.nao.stop(Millis(0));
    while peer.calls("ALMotion.moveIsActive").await.is_empty() {
        driver.step().await;
    }
    walks(&mut driver, &peer, &walk).await;
    let calls = peer.calls_since(0).await;
    let first = |method: &str| calls.iter().position(|call| call["method"] == method);
    let (killed, step) = (first("killAll").unwrap(), first("moveTo").unwrap());
    assert!(killed < step, "the Stop is over first: {killed}, {step}");
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_begins_while_a_stop_ends_goes_on_and_ends_with_the_next() {
    let Some(peer) = Peer::start("nao: what begins during a Stop", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let (hey, walk) = (driver.open("hey", "Animation", &[]), driver.open("walk", "Walk", &[]));
    let ball = driver.open("ball", "RedBall", &[]);
    let is_on = |state: &Json| says(state, "subscribers", "rrp-test") && says(state, "playing", "Hey_1");
    driver.tell(&hey, true);
    driver.sees(&peer, "it waves and looks", is_on).await;
    linger(&peer, "ALTracker", "stopTracker").await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "that ends", is_calm).await;
    // Under the names that the Stop has just ended.
    driver.nao.close(&ball);
    let ball = driver.open("ball", "RedBall", &[]);
    driver.tell(&hey, true);
    driver.sees(&peer, "it waves and looks again", is_on).await;
    walks(&mut driver, &peer, &walk).await;
    assert!(says(&peer.state().await, "subscribers", "rrp-test"), "the Stop did not take it along");
    peer.clear().await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "all of it ends", is_calm).await;
    while peer.calls("ALBehaviorManager.stopBehavior").await.is_empty() {
        driver.step().await;
    }
    assert_eq!(peer.calls("ALBehaviorManager.stopBehavior").await, [json!(["animations/Stand/Gestures/Hey_1"])]);
    driver.nao.close(&ball);
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn who_follows_again_looks_under_another_name() {
    let Some(peer) = Peer::start("nao: following again", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    for _ in 0..2 {
        let follow = driver.open("follow", "Tracker", &[]);
        driver.tell(&follow, Value::Bool(true));
        driver.sees(&peer, "it looks", |state| says(state, "subscribers", "rrp-test/follow/")).await;
        driver.nao.stop(Millis(0));
        driver.sees(&peer, "it looks no more", is_calm).await;
        driver.nao.close(&follow);
    }
    let subscribed = peer.calls("ALRedBallDetection.subscribe").await;
    let names: Vec<&Json> = subscribed.iter().map(|call| &call[0]).collect();
    assert!(names.len() == 2 && names[0] != names[1], "the end of the last may still be on its way: {names:?}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_robot_is_there_when_the_stop_for_what_was_left_is_over() {
    let Some(peer) = Peer::start("nao: what was left", &[]).await else { return };
    peer.subscribe("ALRedBallDetection", "rrp-test/1/ball").await;
    linger(&peer, "ALMotion", "moveIsActive").await;
    let mut driver = Driver::new(Nao::start(settings(&peer.address)));
    driver.until("it is there", |driver| driver.nao.health() == Health::Ready).await;
    assert_eq!(peer.calls("ALMotion.killAll").await.len(), 1, "nothing that begins now is ended by it");
    driver.sees(&peer, "nothing is measured", is_calm).await;
}
