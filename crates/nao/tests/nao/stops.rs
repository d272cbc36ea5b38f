//! Stop: nothing moves, speaks, plays or is measured any more, whatever the other link does.

use crate::driver::Driver;
use crate::peer::Peer;
use crate::proxy::Proxy;
use behaviour::Value;
use robot::{Control, Health, Life, Millis, Robot, Use};
use serde_json::{Value as Json, json};

/// Walks, speaks, plays, follows and looks for a ball.
pub(crate) async fn busy(driver: &mut Driver, peer: &Peer) -> Vec<Use> {
    let walk = driver.open("walk", "Walk", &[]);
    let say = driver.open("say", "SayParameter", &[("text", Value::text("word ".repeat(150)))]);
    let beep = driver.open(
        "file",
        "Sound",
        &[("sound", Value::text("file")), ("file", Value::text("/home/nao/sounds/bell.wav"))],
    );
    let gesture = driver.open("hey", "Animation", &[]);
    let ball = driver.open("ball", "RedBall", &[]);
    for user in [&walk, &say, &beep, &gesture] {
        driver.tell(user, 1.0);
    }
    driver
        .sees(peer, "it speaks and is used", |state| {
            state["speaking"].is_string() && state["subscribers"].to_string().contains("rrp-test")
        })
        .await;
    vec![walk, say, beep, gesture, ball]
}

pub(crate) fn is_calm(state: &Json) -> bool {
    let none = |name: &str| state[name].as_array().is_none_or(Vec::is_empty);
    state["moving"] == json!(false)
        && state["speaking"].is_null()
        && state["tracking"].is_null()
        && none("playing")
        && none("sounding")
        && none("waiting_texts")
        && none("blocked")
        && !state["subscribers"].to_string().contains("rrp-test")
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn everything_ends_and_a_new_value_works_again() {
    let Some(peer) = Peer::start("nao: stop", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    for _ in 0..5 {
        let users = busy(&mut driver, &peer).await;
        driver.nao.stop(Millis(0));
        driver.sees(&peer, "it is calm", is_calm).await;
        users.iter().for_each(|user| driver.nao.close(user));
        driver.wait(10).await;
    }
    for _ in 0..50 {
        driver.nao.stop(Millis(0));
        driver.step().await;
    }
    driver.sees(&peer, "it is calm", is_calm).await;
    peer.clear().await;
    let walk = driver.open("walk", "Walk", &[]);
    driver.tell(&walk, 0.05);
    driver.sees(&peer, "it walks again", |state| state["moving"] == json!(true)).await;
    assert!(peer.calls("ALMotion.killMove").await.is_empty());
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn stop_has_a_way_of_its_own_when_the_other_leads_nowhere() {
    let Some(peer) = Peer::start("nao: a black hole", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    driver.until("both links are there", |_| proxy.connections() >= 2).await;
    let users = busy(&mut driver, &peer).await;
    driver.wait(20).await;
    proxy.swallow(Some(0));
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "it is calm", is_calm).await;
    users.iter().for_each(|user| driver.nao.close(user));
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn it_rests_by_the_way_of_stop_and_not_while_it_falls() {
    let Some(peer) = Peer::start("nao: a rest", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    driver.until("both links are there", |_| proxy.connections() >= 2).await;
    driver.nao.control(Control::Take, Millis(0)).unwrap();
    driver.until("its own life is over", |driver| driver.nao.condition().life == Some(Life::Disabled)).await;
    driver
        .sees(&peer, "it stands", |state| state["awake"] == json!(true) && state["family"] == json!("Standing"))
        .await;
    let users = busy(&mut driver, &peer).await;
    proxy.swallow(Some(0));
    driver.nao.control(Control::Rest, Millis(0)).unwrap();
    driver.sees(&peer, "it rests", |state| is_calm(state) && state["awake"] == json!(false)).await;
    proxy.swallow(None);
    users.iter().for_each(|user| driver.nao.close(user));
    driver.until("it is there", |driver| driver.nao.health() == Health::Ready).await;
    peer.fault(json!({"do": "raise", "key": "ALMotion/RobotIsFalling", "value": true})).await;
    driver.until("the fall is known", |driver| driver.nao.control(Control::Rest, Millis(0)).is_err()).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_service_that_does_not_answer_keeps_nothing_else_from_stopping() {
    let Some(peer) = Peer::start("nao: a mute service", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let users = busy(&mut driver, &peer).await;
    peer.clear().await;
    peer.fault(json!({"do": "never", "service": "ALTracker", "method": "unregisterAllTargets"})).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "it is calm", is_calm).await;
    let mut asked = 0;
    while asked < 2 {
        driver.wait(10).await;
        asked = peer.calls("ALTracker.unregisterAllTargets").await.len();
    }
    users.iter().for_each(|user| driver.nao.close(user));
    assert_eq!(peer.calls("ALAudioPlayer.stopAll").await.len(), 1, "only what did not answer is told again");
    peer.was_safe().await;
}

/// The stand-in falls when somebody sets its legs or kills its walk in mid-step; here it is stopped in every part of one.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn legs_are_left_alone_until_stop_move_has_answered() {
    let Some(peer) = Peer::start("nao: a Stop in mid-step", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let (mut in_the_air, mut held) = (0, 0);
    for _ in 0..12 {
        peer.world(json!({"pose": [0, 0, 0]})).await;
        let walk = driver.open("walk", "Walk", &[]);
        let mut state = peer.state().await;
        while state["in_the_air"] != json!(true) {
            driver.tell(&walk, 0.05);
            driver.step().await;
            state = peer.state().await;
        }
        peer.clear().await;
        driver.nao.stop(Millis(0));
        let state = driver.sees(&peer, "the arms are held", |state| !state["joints"].is_null()).await;
        in_the_air += usize::from(state["in_the_air"] == json!(true));
        driver.sees(&peer, "it is calm", is_calm).await;
        while peer.calls("ALMotion.killAll").await.is_empty() {
            driver.wait(1).await;
        }
        let legs = |call: &Json| call[0].to_string().contains("Knee");
        while !peer.calls("ALMotion.setAngles").await.iter().any(legs) {
            driver.wait(1).await;
        }
        let sets = peer.calls("ALMotion.setAngles").await;
        held += usize::from(!legs(&sets[0]) && sets[0][0].to_string().contains("HeadYaw"));
        driver.nao.close(&walk);
        driver.wait(5).await;
        peer.was_safe().await;
    }
    assert_eq!(held, 12, "head and arms are held first");
    assert!(in_the_air > 0, "some Stops came in mid-step");
    assert_eq!(peer.state().await["fallen"], json!(false));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn legs_that_never_answer_are_left_to_the_robot_and_that_is_said() {
    let Some(peer) = Peer::start("nao: legs that do not answer", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    peer.fault(json!({"do": "never", "service": "ALMotion", "method": "stopMove", "times": 20})).await;
    driver.nao.stop(Millis(0));
    driver
        .until(
            "it is said",
            |driver| matches!(driver.nao.health(), Health::Degraded(why) if why.to_string().starts_with("its legs did not answer")),
        )
        .await;
    let sets = peer.calls("ALMotion.setAngles").await;
    assert_eq!(sets.len(), 1, "head and arms are held once: {sets:?}");
    assert!(sets.iter().all(|call| !call[0].to_string().contains("Knee")), "{sets:?}");
    assert!(peer.calls("ALMotion.killAll").await.is_empty() && peer.calls("ALMotion.stopMove").await.len() > 1);
    peer.was_safe().await;
}
