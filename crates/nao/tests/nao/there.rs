//! Tests that it is there: what it has, what it lacks, how its body is, and a look step by step.

use crate::driver::{Driver, user};
use crate::peer::Peer;
use behaviour::Params;
use nao::{ReachStep, RobotSettings, check};
use robot::{Control, Lacking, Life, Millis, Robot, actuators, sensors};
use serde_json::json;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_whole_nao_has_the_whole_catalogue_and_tells_of_its_body() {
    let Some(peer) = Peer::start("nao: there", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let all = sensors().chain(actuators()).map(|device| device.name);
    assert_eq!(driver.nao.devices(), all.filter(|name| *name != "Tablet").collect::<Vec<_>>());
    let tablet = Lacking { device: "Tablet".into(), why: "it has no tablet; a Pepper has one".into() };
    assert_eq!((driver.nao.kind(), driver.nao.lacking()), ("nao", vec![tablet]));
    peer.world(json!({"battery": 63})).await;
    driver.until("the battery is told", |driver| driver.nao.condition().battery == Some(63)).await;
    let body = driver.nao.condition();
    assert_eq!((body.awake, body.stiff, body.life), (Some(true), Some(true), Some(Life::Solitary)));
    driver.nao.control(Control::Take, Millis(0)).unwrap();
    driver.until("its own life is over", |driver| driver.nao.condition().life == Some(Life::Disabled)).await;
    driver.until("it stands", |driver| driver.nao.condition().awake == Some(true)).await;
    driver.sees(&peer, "it stands", |state| state["family"] == "Standing").await;
    driver.nao.control(Control::Rest, Millis(0)).unwrap();
    driver.until("it rests", |driver| driver.nao.condition().awake == Some(false)).await;
    let walk = driver.open("walk", "Walk", &[]);
    let refused = driver.nao.command(&walk, &0.05.into(), Millis(0)).unwrap_err();
    assert!(refused.to_string().contains("take control first"), "{refused}");
    driver.nao.close(&walk);
    driver.nao.control(Control::GiveBack, Millis(0)).unwrap();
    driver.until("it lives", |driver| driver.nao.condition().life == Some(Life::Solitary)).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_a_body_lacks_is_said_with_the_reason() {
    let Some(peer) = Peer::start("nao: lacks", &["--body", "h21", "--without", "ALLeds,ALRedBallDetection"]).await
    else {
        return;
    };
    let mut driver = Driver::at(&peer.address).await;
    let lacking = driver.nao.lacking();
    let why = |device: &str| lacking.iter().find(|one| one.device == device).map(|one| one.why.clone());
    assert_eq!(why("EyeLedColor"), Some("its ALLeds is not there".into()));
    assert_eq!(why("HandTouch"), Some("its body has no left hand".into()));
    let refused = driver.nao.open(&user("hand"), "HandTouch", &Params::new()).unwrap_err();
    assert_eq!(refused.to_string(), "its body has no left hand");
    assert!(!driver.nao.devices().contains(&"RedBall") && driver.nao.devices().contains(&"Walk"));
    let refused = driver.nao.open(&user("follow"), "Tracker", &Params::new()).unwrap_err();
    assert!(refused.to_string().ends_with("its ALRedBallDetection is not there"), "it cannot see the ball: {refused}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_look_goes_through_all_steps() {
    let Some(peer) = Peer::start("nao: look", &[]).await else { return };
    let settings = RobotSettings {
        address: peer.address.clone(),
        login: None,
        own_name: "rrp".into(),
        trusted: None,
        expected: None,
        former: Vec::new(),
    };
    let found = check(&settings).await;
    let steps: Vec<ReachStep> = found.steps.iter().map(|step| step.0).collect();
    assert_eq!(
        steps,
        [ReachStep::Name, ReachStep::Tcp, ReachStep::Login, ReachStep::Directory, ReachStep::Services],
        "{found:?}"
    );
    assert!(found.steps.iter().all(|step| step.1.is_none()), "{found:?}");
    assert!(found.model.starts_with("NAO, NAOqi"), "{found:?}");
}
