//! Which body answers: the first one is kept, another one is never taken for it, and nothing but a sign by lights is asked
//! of that one.

use crate::driver::{Driver, settings};
use crate::peer::Peer;
use nao::{Nao, RobotSettings};
use robot::{Control, Health, Identity, Millis, Robot, RobotFault, Stranger};

fn stranger(driver: &Driver) -> Option<Stranger> {
    match driver.nao.health() {
        Health::Stranger(who) => Some(*who),
        _ => None,
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_first_body_is_kept_and_another_one_at_its_address_is_a_stranger() {
    let Some(peer) = Peer::start("nao: stranger", &["--name", "Momo"]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let expected = driver.nao.identity().unwrap();
    assert_eq!((expected.name.as_str(), expected.body.as_str()), ("Momo", "NAO"));
    assert_eq!(expected.serial, "ALDR0000N000001");
    assert!(!expected.head.is_empty());
    // It walks as its line is lost: the Stop that follows is owed to it, and to nobody else.
    let walk = driver.open("walk", "Walk", &[]);
    driver.tell(&walk, 0.05);
    let port = peer.port().to_owned();
    drop(peer);
    driver.until("it is lost", |driver| matches!(driver.nao.health(), Health::Lost(_))).await;
    let words = ["--port", &port, "--body", "pepper", "--name", "Momo", "--serial", "AP990000N000002"];
    let Some(pepper) = Peer::start("nao: stranger", &words).await else { return };
    let mut found = None;
    driver
        .until("somebody else answers", |driver| {
            found = stranger(driver);
            found.is_some()
        })
        .await;
    let found = found.unwrap();
    assert_eq!(found.expected, expected);
    assert_eq!((found.found.body.as_str(), found.found.serial.as_str()), ("Pepper", "AP990000N000002"));
    // No device, no control; the sign is given, and nothing else.
    let refused = driver.nao.open(&crate::driver::user("eyes"), "EyeLedColor", &Default::default()).unwrap_err();
    assert!(matches!(&refused, RobotFault::NotNow(why) if why.to_string().contains("another robot")), "{refused}");
    assert!(driver.nao.control(Control::Take, Millis(0)).is_err());
    driver.nao.control(Control::Blink, Millis(0)).unwrap();
    driver.wait(20).await;
    while pepper.calls("ALLeds.reset").await.is_empty() {
        driver.step().await;
    }
    let asked = pepper.calls_since(0).await;
    let is_allowed = |call: &serde_json::Value| {
        let (service, method) = (call["service"].as_str().unwrap(), call["method"].as_str().unwrap());
        service == "ALLeds" || matches!(method, "getData" | "robotName" | "getBodyNames")
    };
    let beyond: Vec<_> = asked.iter().filter(|call| !is_allowed(call)).collect();
    assert!(beyond.is_empty(), "{beyond:?}");
    // A Stop that somebody presses is never refused.
    driver.nao.stop(Millis(0));
    while pepper.calls("ALMotion.stopMove").await.is_empty() {
        driver.step().await;
    }
    // The one that is meant is back.
    drop(pepper);
    let Some(_back) = Peer::start("nao: stranger", &["--port", &port, "--name", "Pico"]).await else { return };
    // Its own life is on, which is told while somebody uses it.
    let is_there = |driver: &mut Driver| matches!(driver.nao.health(), Health::Ready | Health::Degraded(_));
    driver.until("it is there again", is_there).await;
    assert_eq!(driver.nao.identity().unwrap().name, "Pico", "it was only given another name");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn two_with_one_name_are_told_apart_and_an_accepted_one_is_taken() {
    let Some(peer) = Peer::start("nao: names", &["--name", "nao", "--serial", "B2"]).await else { return };
    let kept = Identity { name: "nao".into(), body: "NAO".into(), serial: "B1".into(), head: String::new() };
    let with = |expected: &Identity| RobotSettings { expected: Some(expected.clone()), ..settings(&peer.address) };
    let mut driver = Driver::new(Nao::start(with(&kept)));
    driver.until("it is a stranger", |driver| stranger(driver).is_some()).await;
    let found = stranger(&driver).unwrap().found;
    drop(driver);
    let taken = Driver::with(with(&found)).await;
    assert_eq!(taken.nao.identity(), Some(found));
}
