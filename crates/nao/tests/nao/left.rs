//! Tests of what a server that is gone left on a robot: the next connection ends it, and puts back what it had set.

use crate::driver::{Driver, settings};
use crate::peer::Peer;
use crate::proxy::{Cut, Proxy};
use behaviour::Value;
use nao::RobotSettings;
use serde_json::{Value as Json, json};

/// A voice as nobody has by itself.
fn odd_voice() -> [(&'static str, Value); 4] {
    let language = ("language", Value::text("Japanese"));
    [("volume", 50.0.into()), ("speed", 80.0.into()), ("gestures", Value::text("yes")), language]
}

fn is_odd(state: &Json) -> bool {
    state["language"] == "Japanese" && state["voice_volume"] == 0.5 && state["voice"]["speed"] == 80.0
}

/// True if it is as the stand-in was at first.
fn is_usual(state: &Json) -> bool {
    let volume = state["voice_volume"].as_f64().unwrap();
    state["language"] == "English" && (volume - 0.7).abs() < 1e-6 && state["voice"]["speed"] == 100.0
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_voice_is_put_back_after_a_server_that_was_killed() {
    let Some(peer) = Peer::start("nao: a voice that was left", &[]).await else { return };
    for again in 0..2 {
        let proxy = Proxy::before(&peer.address).await;
        let mut killed = Driver::at(&proxy.address).await;
        let voice = killed.open("voice", "Voice", &odd_voice());
        killed.tell(&voice, true);
        killed.sees(&peer, "it speaks in another way", is_odd).await;
        // Nothing of it reaches the robot any more, as of one that is dead.
        proxy.cut_line(Cut::Both);
        drop(killed);
        assert!(is_odd(&peer.state().await), "it is left like that");
        peer.clear().await;
        let mut next = Driver::at(&peer.address).await;
        next.sees(&peer, "it speaks as before", is_usual).await;
        assert_eq!(peer.remembers("rrp-test/").await, Vec::<String>::new(), "nothing is kept of it, time {again}");
        let say = next.open("say", "SayInput", &[]);
        next.tell(&say, Value::text("as usual"));
        next.sees(&peer, "it speaks", |state| state["spoken"] == json!(["as usual"])).await;
        assert!(peer.calls("ALAnimatedSpeech.say").await.is_empty(), "without gestures");
    }
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn nothing_stays_under_a_name_that_no_robot_has_any_more() {
    let Some(peer) = Peer::start("nao: old names", &[]).await else { return };
    for (service, name) in [
        ("ALRedBallDetection", "rrp-old/7/ball"),
        ("ALFaceDetection", "rrp-older/follow/Face-3"),
        ("ALRedBallDetection", "rrp-other/1/ball"),
        ("ALRedBallDetection", "rrp-oldest/1/ball"),
    ] {
        peer.subscribe(service, name).await;
    }
    peer.remember("rrp-older/hearing", "French").await;
    peer.remember("rrp-other/hearing", "German").await;
    let former = vec!["rrp-old".to_owned(), "rrp-older".to_owned()];
    let mut driver = Driver::with(RobotSettings { former, ..settings(&peer.address) }).await;
    let is_measured = |state: &Json, name: &str| state["subscribers"].to_string().contains(&format!("{name}/"));
    driver
        .sees(&peer, "what is ours ends", |state| !is_measured(state, "rrp-old") && !is_measured(state, "rrp-older"))
        .await;
    let state = peer.state().await;
    assert!(is_measured(&state, "rrp-other") && is_measured(&state, "rrp-oldest"), "another server's: {state}");
    driver.sees(&peer, "it hears as before", |state| state["heard_language"] == json!("French")).await;
    assert_eq!(peer.remembers("/hearing").await, ["rrp-other/hearing"]);
}
