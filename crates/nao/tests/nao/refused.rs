//! Tests of what a robot does not do as it is now: it says why, and what to do about it.

use crate::driver::Driver;
use crate::peer::Peer;
use behaviour::Value;
use robot::{Millis, Robot};
use serde_json::json;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn who_sits_lies_is_limp_charged_or_carried_does_not_walk() {
    let Some(peer) = Peer::start("nao: no walks", &[]).await else { return };
    peer.world(json!({"life": "disabled", "life_disabled_rests": false})).await;
    let mut driver = Driver::at(&peer.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    let body = driver.open("body", "Tracker", &[("mode", Value::text("WholeBody"))]);
    let after = driver.open("after", "Tracker", &[("mode", Value::text("Move"))]);
    let head = driver.open("head", "Tracker", &[("mode", Value::text("Head"))]);
    for (world, why, back) in [
        (json!({"posture": "Sit"}), "it sits; let it stand up first", json!({"posture": "StandInit"})),
        (json!({"carried": true}), "it is carried; set it on its feet first", json!({"carried": false})),
        (json!({"plugged": true}), "it is on its charging cable; unplug it first", json!({"plugged": false})),
        (
            json!({"stiffness": {"LKneePitch": 0.3}}),
            "its legs are limp; take control first",
            json!({"stiffness": {"LKneePitch": 1.0}}),
        ),
    ] {
        peer.world(world).await;
        for user in [&walk, &body, &after] {
            let mut said = None;
            driver
                .until(why, |driver| {
                    said = driver.nao.command(user, &Value::Float(0.05), Millis(0)).err();
                    said.is_some()
                })
                .await;
            assert_eq!(said.unwrap().to_string(), format!("the robot cannot do this now: {why}"));
        }
        assert_eq!(driver.nao.condition().legs, Some(why.into()), "an operator sees it before Start");
        driver.tell(&head, true);
        peer.world(back).await;
        driver.until("it may walk again", |driver| driver.nao.condition().legs.is_none()).await;
    }
    driver.tell(&walk, 0.05);
    driver.sees(&peer, "it walks", |state| state["moving"] == json!(true)).await;
    // Lifted, it stands, and does not go on when it is set down: nobody says that again.
    peer.world(json!({"carried": true})).await;
    driver.sees(&peer, "it walks no more", |state| state["moving"] == json!(false)).await;
    peer.world(json!({"push": "back"})).await;
    let lies = "it lies on the floor; help it up first";
    driver.until("that it lies is told", |driver| driver.nao.condition().legs == Some(lies.into())).await;
    driver.until("everything halts", |driver| driver.nao.take_halt().is_some()).await;
    let refused = driver.nao.command(&body, &Value::Bool(true), Millis(0)).unwrap_err();
    assert!(refused.to_string().ends_with(lies), "{refused}");
    [&walk, &body, &after, &head].into_iter().for_each(|user| driver.nao.close(user));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_life_of_its_own_is_told_while_something_runs() {
    let Some(peer) = Peer::start("nao: its own life", &[]).await else { return };
    peer.world(json!({"life": "disabled", "life_disabled_rests": false})).await;
    let mut driver = Driver::at(&peer.address).await;
    driver.until("it has none", |driver| driver.nao.condition().life == Some(robot::Life::Disabled)).await;
    let head = driver.open("head", "HeadTouch", &[]);
    assert_eq!(driver.nao.health(), robot::Health::Ready);
    peer.world(json!({"life": "interactive"})).await;
    driver
        .until("that it lives is told", |driver| {
            matches!(driver.nao.health(), robot::Health::Degraded(why) if why.to_string().starts_with("its own life is on"))
        })
        .await;
    peer.world(json!({"life": "disabled"})).await;
    driver.until("that it does no more, too", |driver| driver.nao.health() == robot::Health::Ready).await;
    driver.nao.close(&head);
}
