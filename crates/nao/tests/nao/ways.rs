//! Robots that are reached in other ways: in secret, with user, password and a certificate that must stay the same; and as old
//! ones are.

use crate::driver::Driver;
use crate::gateway::{self, Gateway, PASSWORD};
use crate::peer::Peer;
use crate::stops::{busy, is_calm};
use nao::{Login, ReachStep, RobotSettings, check};
use robot::{Health, Millis, Robot};
use serde_json::json;

fn settings(gateway: &Gateway, password: &str, trusted: Option<String>) -> RobotSettings {
    let login = Some(Login { user: "nao".into(), password: password.into() });
    RobotSettings {
        address: format!("tcps://{}", gateway.address),
        login,
        own_name: "rrp-test".into(),
        trusted,
        expected: None,
        former: Vec::new(),
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_robot_behind_tls_and_a_password_works_until_its_certificate_changes() {
    let Some(peer) = Peer::start("nao: TLS and a password", &[]).await else { return };
    let gateway = Gateway::before(&peer.address).await;

    let refused = check(&settings(&gateway, "wrong", None)).await;
    let (step, why) = refused.steps.last().cloned().unwrap();
    assert_eq!(step, ReachStep::Login, "{refused:?}");
    assert!(why.as_ref().is_some_and(|why| why.to_string().contains("user and password")), "{refused:?}");

    let found = check(&settings(&gateway, PASSWORD, None)).await;
    assert!(found.steps.iter().all(|step| step.1.is_none()), "{found:?}");
    assert!(found.steps.iter().any(|step| step.0 == ReachStep::Tls), "{found:?}");
    let trusted = found.fingerprint.clone().unwrap();

    // Both links go by it.
    let mut driver = Driver::with(settings(&gateway, PASSWORD, Some(trusted.clone()))).await;
    let users = busy(&mut driver, &peer).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "it is calm", is_calm).await;
    users.iter().for_each(|user| driver.nao.close(user));
    assert!(peer.calls("ALMotion.killMove").await.is_empty());
    let walk = driver.open("walk", "Walk", &[]);
    driver.tell(&walk, 0.05);
    driver.sees(&peer, "it walks", |state| state["moving"] == json!(true)).await;

    gateway.renew();
    let mut why = String::new();
    driver
        .until("the other certificate is told", |driver| {
            if let Health::Lost(reason) = driver.nao.health() {
                why = reason.to_string();
            }
            why.contains("another certificate")
        })
        .await;
    assert!(why.contains("choose “Change the address” here"), "{why}");
    assert!(driver.nao.take_halt().is_some(), "what ran is interrupted");
    let looked = check(&settings(&gateway, PASSWORD, Some(trusted))).await;
    assert_eq!(looked.steps.last().map(|step| step.0), Some(ReachStep::Tls), "{looked:?}");
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_robot_that_knows_no_log_in_works_too() {
    let Some(peer) = Peer::start("nao: as NAOqi 2.1", &[]).await else { return };
    let address = gateway::old(&peer.address).await;
    let mut driver = Driver::at(&address).await;
    let users = busy(&mut driver, &peer).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "it is calm", is_calm).await;
    users.iter().for_each(|user| driver.nao.close(user));
    let head = driver.open("head", "HeadTouch", &[]);
    driver.sees(&peer, "touches are heard", |state| state["listened"].to_string().contains("RearTactilTouched")).await;
    driver.wait(40).await;
    peer.world(json!({"touch": {"part": "RearTactilTouched", "down": true}})).await;
    driver.next(&head).await;
    peer.was_safe().await;
}
