//! Tests of what comes late, fails on the way or is shared: nothing is left over of it.

use crate::driver::Driver;
use crate::peer::Peer;
use crate::proxy::Proxy;
use crate::stops::is_calm;
use behaviour::Value;
use robot::{Health, Millis, Robot};
use serde_json::{Value as Json, json};

fn says(state: &Json, what: &str, word: &str) -> bool {
    state[what].to_string().contains(word)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_walk_that_comes_after_the_stop_ends_too() {
    let Some(peer) = Peer::start("nao: a late walk", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    driver.until("both links are there", |_| proxy.connections() >= 2).await;
    let walk = driver.open("walk", "Walk", &[]);
    driver.wait(10).await;
    proxy.hold(Some(0));
    driver.tell(&walk, 0.05);
    driver.wait(10).await;
    driver.nao.stop(Millis(0));
    while peer.calls("ALMotion.killAll").await.is_empty() {
        driver.wait(1).await;
    }
    assert!(peer.calls("ALMotion.moveTo").await.is_empty(), "it is still on its way");
    driver.nao.close(&walk);
    driver.wait(10).await;
    proxy.hold(None);
    while peer.calls("ALMotion.moveTo").await.is_empty() {
        driver.wait(1).await;
    }
    driver.sees(&peer, "it stands", is_calm).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_sense_that_begins_after_the_stop_is_not_left_measuring() {
    let Some(peer) = Peer::start("nao: a late sense", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    driver.until("both links are there", |_| proxy.connections() >= 2).await;
    proxy.hold(Some(0));
    let ball = driver.open("ball", "RedBall", &[]);
    driver.wait(10).await;
    driver.nao.stop(Millis(0));
    while peer.calls("ALMotion.killAll").await.is_empty() {
        driver.wait(1).await;
    }
    proxy.hold(None);
    while peer.calls("ALRedBallDetection.subscribe").await.is_empty() {
        driver.wait(1).await;
    }
    driver.sees(&peer, "nothing is measured", |state| !says(state, "subscribers", "rrp-test")).await;
    driver.nao.close(&ball);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_stop_ends_what_was_closed_by_a_link_that_leads_nowhere() {
    let Some(peer) = Peer::start("nao: a sense that is closed in vain", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    driver.until("both links are there", |_| proxy.connections() >= 2).await;
    let ball = driver.open("ball", "RedBall", &[]);
    driver.sees(&peer, "it is measured", |state| says(state, "subscribers", "rrp-test")).await;
    let connections = proxy.connections();
    proxy.swallow(Some(0));
    driver.nao.close(&ball);
    driver.wait(20).await;
    assert!(says(&peer.state().await, "subscribers", "rrp-test"), "the robot does not hear that");
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "nothing is measured", |state| !says(state, "subscribers", "rrp-test")).await;
    assert_eq!(proxy.connections(), connections, "it was Stop that ended it, and no new link");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn recognition_goes_on_when_its_words_cannot_be_set_and_pauses_while_the_robot_speaks() {
    let Some(peer) = Peer::start("nao: its own voice", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    peer.fault(json!({"do": "error", "service": "ALSpeechRecognition", "method": "setVocabulary"})).await;
    let deaf = driver.open("deaf", "WordRecognized", &[]);
    while peer.calls("ALSpeechRecognition.pause").await.len() < 2 {
        driver.wait(1).await;
    }
    driver.nao.close(&deaf);
    driver.sees(&peer, "it is not paused", |state| !says(state, "paused", "ALSpeechRecognition")).await;

    let hears = driver.open("hears", "WordRecognized", &[("words", Value::text("red, blue"))]);
    driver.sees(&peer, "it listens", |state| says(state, "subscribers", "rrp-test")).await;
    // Another list beside it: each hears its own words.
    let other = driver.open("other", "WordRecognized", &[("words", Value::text("green, yellow"))]);
    driver
        .sees(&peer, "it listens for all", |state| {
            says(state, "vocabulary", "green") && says(state, "vocabulary", "blue")
        })
        .await;
    let say = driver.open("say", "SayInput", &[]);
    driver.tell(&say, Value::text("red ".repeat(40)));
    let heard = |state: &Json| state["speaking"].is_string();
    let state = driver.sees(&peer, "it speaks", heard).await;
    assert!(says(&state, "paused", "ALSpeechRecognition"), "it does not hear itself: {state}");
    driver.nao.close(&say);
    driver.sees(&peer, "it hears again", |state| !says(state, "paused", "ALSpeechRecognition")).await;
    driver.readings.clear();
    peer.world(json!({"word": {"word": "blue", "confidence": 0.9}})).await;
    assert_eq!(driver.next(&hears).await.field("word").and_then(Value::as_text), Some("blue"));
    peer.world(json!({"word": {"word": "yellow", "confidence": 0.9}})).await;
    assert_eq!(driver.next(&other).await.field("word").and_then(Value::as_text), Some("yellow"));
    driver.nao.close(&hears);
    driver.nao.close(&other);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn of_two_sounds_one_ends_without_the_other() {
    let Some(peer) = Peer::start("nao: two sounds", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let file = |name: &str| [("sound", Value::text("file")), ("file", Value::text(name))];
    let one = driver.open("one", "Sound", &file("/home/nao/sounds/bell.wav"));
    let other = driver.open("other", "Sound", &file("/opt/aldebaran/share/naoqi/wav/start_jingle.wav"));
    driver.tell(&one, true);
    driver.tell(&other, true);
    driver.sees(&peer, "both sound", |state| state["sounding"].as_array().is_some_and(|all| all.len() == 2)).await;
    driver.nao.close(&one);
    driver.wait(20).await;
    assert!(peer.calls("ALAudioPlayer.stopAll").await.is_empty());
    driver.nao.close(&other);
    driver.sees(&peer, "it is quiet", |state| state["sounding"] == json!([])).await;
    assert_eq!(peer.calls("ALAudioPlayer.stopAll").await.len(), 1);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn of_a_joint_and_its_group_the_newest_counts_and_the_eyes_are_shown() {
    let Some(peer) = Peer::start("nao: a joint and its group", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    let head = driver.open("head", "SetJointPosition", &[("joint", Value::text("Head"))]);
    let yaw = driver.open("yaw", "SetJointPosition", &[("joint", Value::text("HeadYaw"))]);
    let eyes = driver.open("eyes", "EyeLedColor", &[("color", Value::text("red"))]);
    driver.wait(5).await;
    // What is on its way keeps the rest waiting; of that the newest is sent.
    proxy.hold(Some(0));
    driver.tell(&yaw, 0.1);
    driver.wait(20).await;
    driver.tell(&yaw, 0.9);
    driver.tell(&head, Value::List(vec![Value::Float(-0.5), Value::Float(0.2)].into()));
    driver.tell(&eyes, true);
    driver.wait(5).await;
    proxy.hold(None);
    let there = |state: &Json| (state["joints"]["HeadYaw"].as_f64().unwrap() + 0.5).abs() < 0.02;
    driver.sees(&peer, "the head is where the group sent it", there).await;
    let calls = peer.calls("ALMotion.setAngles").await;
    assert!(calls.iter().all(|call| !call.to_string().contains("0.9")), "{calls:?}");
    driver.until("the page sees red eyes", |driver| driver.nao.scene().body.eyes == [1.0, 0.0, 0.0]).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_stop_ends_speech_once_a_link_and_the_rest_of_the_text_is_not_said() {
    let Some(peer) = Peer::start("nao: one end of speech", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let say = driver.open("say", "SayInput", &[]);
    driver.tell(&say, Value::text("word ".repeat(60)));
    driver.sees(&peer, "it speaks", |state| state["speaking"].is_string()).await;
    peer.clear().await;
    driver.nao.stop(Millis(0));
    driver.nao.close(&say);
    driver.sees(&peer, "it is calm", is_calm).await;
    while peer.calls("ALMotion.killAll").await.is_empty() || peer.calls("ALTextToSpeech.stopAll").await.len() < 2 {
        driver.wait(1).await;
    }
    driver.wait(40).await;
    assert_eq!(peer.calls("ALTextToSpeech.stopAll").await.len(), 2, "by each link once");
    assert!(peer.calls("ALTextToSpeech.say").await.len() <= 1, "what was on its way at most");
    assert!(is_calm(&peer.state().await));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn how_it_heard_before_is_put_back_at_the_end_and_at_the_next_connection() {
    let Some(peer) = Peer::start("nao: its hearing", &[]).await else { return };
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    let words = [("words", Value::text("oui, non")), ("language", Value::text("Japanese"))];
    for ends_well in [true, false] {
        let hears = driver.open("hears", "WordRecognized", &words);
        driver.sees(&peer, "it listens", |state| state["listening"] == json!(true)).await;
        assert_eq!(peer.state().await["heard_language"], json!("Japanese"));
        if ends_well {
            driver.nao.close(&hears);
        } else {
            // As one leaves it who dies while the robot speaks.
            peer.pause_hearing().await;
            proxy.cut();
            driver
                .until("the loss is noticed", |driver| {
                    !matches!(driver.nao.health(), Health::Ready | Health::Degraded(_))
                })
                .await;
            driver.nao.close(&hears);
        }
        let back = |state: &Json| state["heard_language"] == json!("English") && !says(state, "paused", "ALSpeech");
        driver.sees(&peer, "it hears as before", back).await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_gesture_ends_with_its_behaviour_and_a_robot_that_is_removed_leaves_nothing_behind() {
    let Some(peer) = Peer::start("nao: the end of a gesture", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    for fault in [json!([]), json!({"do": "never", "service": "ALBehaviorManager", "method": "stopBehavior"})] {
        peer.clear().await;
        peer.fault(fault).await;
        let gesture = driver.open("hey", "Animation", &[]);
        driver.tell(&gesture, true);
        let state = driver.sees(&peer, "it waves", |state| state["playing"] != json!([])).await;
        driver.nao.close(&gesture);
        driver.sees(&peer, "it waves no more", |state| state["playing"] == json!([])).await;
        let ended = peer.state().await["last_ms"]["played"].as_f64().unwrap_or_default();
        assert!(ended - state["t_ms"].as_f64().unwrap() < 1_500.0, "it is not just over by itself");
        while peer.calls("ALBehaviorManager.stopBehavior").await.is_empty() {
            driver.wait(1).await;
        }
    }
    let _ball = driver.open("ball", "RedBall", &[]);
    let follow = driver.open("follow", "Tracker", &[("target", Value::text("Face"))]);
    driver.tell(&follow, true);
    let both = |state: &Json| says(state, "subscribers", "ALRedBall") && says(state, "subscribers", "ALFace");
    driver.sees(&peer, "it looks for both", both).await;
    drop(driver);
    peer.until("nothing is measured any more", |state| state["subscribers"] == json!({})).await;
}
