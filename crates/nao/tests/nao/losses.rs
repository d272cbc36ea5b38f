//! The link is cut, silent, comes in crumbs; the robot ends and comes back: nothing goes on by itself.

use crate::driver::{Driver, user};
use crate::peer::Peer;
use crate::proxy::Proxy;
use behaviour::{Params, Value};
use robot::{Health, Millis, Robot, RobotFault, Use};
use serde_json::json;

/// Waits for the loss and its reason, and that nothing works meanwhile.
async fn loses(driver: &mut Driver, walk: &Use) {
    driver.until("the loss is noticed", |driver| matches!(driver.nao.health(), Health::Lost(_))).await;
    let mut why = None;
    driver
        .until("everything has to end", |driver| {
            why = why.take().or_else(|| driver.nao.take_halt());
            why.is_some()
        })
        .await;
    assert_eq!(why, Some("the connection to it was lost".into()));
    assert_eq!(driver.nao.take_halt(), None, "told once");
    let refused = driver.nao.command(walk, &Value::Float(0.05), Millis(0));
    assert_eq!(refused, Err(RobotFault::NoLink));
    assert_eq!(driver.nao.open(&user("late"), "RedBall", &Params::new()), Err(RobotFault::NoLink));
    driver.nao.close(walk);
}

/// It is there again, still, and events flow.
async fn returns(driver: &mut Driver, peer: &Peer) {
    driver.until("it is there again", |driver| driver.nao.health() == Health::Ready).await;
    driver.until("its services are there", |driver| driver.nao.lacking().len() == 1).await;
    driver.wait(50).await;
    assert_eq!(peer.state().await["moving"], json!(false), "nothing moves before a person starts it");
    let head = driver.open("head", "HeadTouch", &[]);
    driver.sees(peer, "touches are heard", |state| state["listened"].to_string().contains("RearTactilTouched")).await;
    driver.wait(40).await;
    peer.world(json!({"touch": {"part": "RearTactilTouched", "down": true}})).await;
    assert_eq!(driver.next(&head).await, Value::Bool(true));
    driver.nao.close(&head);
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_cut_link_ends_everything_and_comes_back() {
    let Some(peer) = Peer::start("nao: a cut", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    driver.tell(&walk, 0.05);
    driver.sees(&peer, "it walks", |state| state["moving"] == json!(true)).await;
    proxy.cut();
    loses(&mut driver, &walk).await;
    returns(&mut driver, &peer).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_robot_that_is_switched_off_and_on_is_found_again() {
    let Some(peer) = Peer::start("nao: off and on", &[]).await else { return };
    let port = peer.port().to_owned();
    let mut driver = Driver::at(&peer.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    drop(peer);
    loses(&mut driver, &walk).await;
    let peer = Peer::start("nao: off and on", &["--port", &port]).await.unwrap();
    returns(&mut driver, &peer).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_link_that_is_silent_is_lost_too() {
    let Some(peer) = Peer::start("nao: half open", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    proxy.swallow(Some(0));
    let mut degraded = false;
    driver
        .until("it is degraded first", |driver| {
            degraded |= matches!(driver.nao.health(), Health::Degraded(_));
            degraded || matches!(driver.nao.health(), Health::Lost(_))
        })
        .await;
    assert!(degraded);
    loses(&mut driver, &walk).await;
    returns(&mut driver, &peer).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn odd_peers_are_endured() {
    let Some(peer) = Peer::start("nao: odd", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    proxy.crumble();
    let mut driver = Driver::at(&proxy.address).await;
    let (ball, face) = (driver.open("ball", "RedBall", &[]), driver.open("face", "FaceDetection", &[]));
    for value in [json!(7), json!([]), json!([[1], [[[[]]], []]]), json!("odd"), json!([[0, 0], "x"])] {
        for key in ["redBallDetected", "FaceDetected", "PostureFamilyChanged", "AutonomousLife/State"] {
            peer.fault(json!({"do": "raise", "key": key, "value": value})).await;
        }
    }
    peer.fault(json!({"do": "raise", "key": "WordRecognized", "hex": "ff00"})).await;
    peer.fault(json!({"do": "burst", "key": "redBallDetected", "count": 1_000, "hz": 1_000})).await;
    peer.fault(json!({"do": "unregister", "service": "ALLeds"})).await;
    let lacks = |driver: &Driver| driver.nao.lacking().iter().any(|one| one.device == "EyeLedColor");
    driver.until("its lights are missed", |driver| lacks(driver)).await;
    peer.fault(json!({"do": "register", "service": "ALLeds"})).await;
    driver.until("its lights are there again", |driver| !lacks(driver)).await;
    driver.wait(100).await;
    assert!(matches!(driver.nao.health(), Health::Degraded(why) if why.to_string().starts_with("its own life is on")));
    let eyes = driver.open("eyes", "EyeLedColor", &[("color", Value::text("green"))]);
    driver.tell(&eyes, true);
    driver.sees(&peer, "green eyes", |state| state["leds"]["FaceLeds"][0].as_f64() == Some(0.0)).await;
    driver.next(&ball).await;
    driver.nao.close(&face);
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn heat_and_its_own_protection_halt() {
    let Some(peer) = Peer::start("nao: halts", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    for (world, why) in [
        (json!({"heat": {"LKneePitch": 95.0}}), "its LKneePitch is too hot"),
        (json!({"life": "safeguard"}), "it protects itself"),
        (json!({"battery": 3, "plugged": false}), "its battery is empty"),
    ] {
        let walk = driver.open("walk", "Walk", &[]);
        peer.world(world).await;
        let mut said = None;
        driver
            .until(why, |driver| {
                said = said.take().or_else(|| driver.nao.take_halt());
                said.is_some()
            })
            .await;
        assert_eq!(said, Some(why.into()));
        driver.nao.close(&walk);
        peer.world(json!({"heat": {"LKneePitch": 30.0}, "life": "disabled", "life_disabled_rests": false})).await;
        driver
            .until("that is over", |driver| {
                driver.nao.condition().hot.is_empty() && driver.nao.condition().life == Some(robot::Life::Disabled)
            })
            .await;
        driver.nao.take_halt();
    }
    peer.was_safe().await;
}
