//! Tests of what is called for each action, and what the body does then.

use crate::driver::Driver;
use crate::peer::Peer;
use behaviour::Value;
use robot::{Millis, Robot};
use serde_json::{Value as Json, json};

fn text(text: &str) -> Value {
    Value::text(text)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn joints_stay_in_their_limits_and_the_newest_target_wins() {
    let Some(peer) = Peer::start("nao: joints", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let yaw = driver.open("yaw", "SetJointPosition", &[("joint", text("HeadYaw"))]);
    let pitch = driver.open("pitch", "SetJointPosition", &[("joint", text("HeadPitch"))]);
    for step in 0..2_000 {
        driver.tell(&yaw, f64::from(step % 7) / 10.0);
        if step % 50 == 0 {
            driver.step().await;
        }
    }
    driver.tell(&yaw, 9.0);
    driver.sees(&peer, "the head looks aside", |state| state["joints"]["HeadYaw"].as_f64().unwrap() > 2.0).await;
    let calls = peer.calls("ALMotion.setAngles").await;
    assert!(calls.len() < 500, "{} calls for 2,000 values", calls.len());
    assert_eq!(calls.last().unwrap()[0], json!(["HeadYaw"]));
    assert!((calls.last().unwrap()[1][0].as_f64().unwrap() - 2.0857).abs() < 1e-3, "{:?}", calls.last());
    driver.tell(&pitch, 9.0);
    driver.sees(&peer, "it nods as far as it may", |state| state["joints"]["HeadPitch"].as_f64().unwrap() > 0.3).await;
    let nod = peer.calls("ALMotion.setAngles").await.last().unwrap()[1][0].as_f64().unwrap();
    assert!((nod - 0.33).abs() < 0.01, "to the side it nods less: {nod}");
    let arm = driver.open("arm", "SetJointPosition", &[("joint", text("LArm"))]);
    assert!(driver.nao.command(&arm, &Value::Float(1.0), Millis(0)).is_err());
    let list = Value::List(vec![Value::Float(0.5); 6].into());
    driver.tell(&arm, list);
    driver.sees(&peer, "the hand opens", |state| state["targets"]["LHand"].as_f64().unwrap_or_default() > 0.4).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn words_wait_for_each_other_and_end_with_who_wants_them() {
    let Some(peer) = Peer::start("nao: words", &[]).await else { return };
    peer.world(json!({"speech_ms_per_char": 200})).await;
    let mut driver = Driver::at(&peer.address).await;
    let (one, other) =
        (driver.open("one", "SayInput", &[]), driver.open("two", "SayParameter", &[("text", text("two"))]));
    driver.tell(&one, text("a long sentence that nobody hears the end of, as it is cut"));
    driver.tell(&one, text("a long sentence that nobody hears the end of, as it is cut"));
    driver.sees(&peer, "it speaks", |state| state["speaking"].is_string()).await;
    driver.tell(&other, true);
    driver.nao.close(&one);
    driver
        .sees(&peer, "the other says its word", |state| state["spoken"].as_array().unwrap().contains(&json!("two")))
        .await;
    let said = peer.calls("ALTextToSpeech.say").await;
    assert_eq!(said.last(), Some(&json!(["two"])));
    let begun = said.iter().filter(|call| call[0].as_str().unwrap().starts_with("a long sentence"));
    assert_eq!(begun.count(), 1, "not said twice: {said:?}");
    assert_eq!(peer.calls("ALTextToSpeech.stopAll").await.len(), 1);
    assert!(driver.nao.command(&other, &Value::Bool(true), Millis(0)).is_ok());
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn it_walks_only_while_values_come() {
    let Some(peer) = Peer::start("nao: walk", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    driver.tell(&walk, 9.0);
    driver.sees(&peer, "it walks", |state| state["moving"] == json!(true)).await;
    driver.sees(&peer, "it stops by itself", |state| state["moving"] == json!(false)).await;
    assert!(!peer.calls("ALMotion.stopMove").await.is_empty());
    let pieces = peer.calls("ALMotion.moveTo").await;
    let gait = json!([["MaxStepX", 0.021], ["MaxStepY", 0.101], ["MaxStepTheta", 0.001]]);
    for piece in &pieces {
        assert_eq!(
            piece,
            &json!([0.0225, 0.0, 0.0, gait]),
            "no more way than that of less than half a second, at the speed that was chosen"
        );
    }
    assert!(peer.calls("ALMotion.move").await.is_empty() && peer.calls("ALMotion.moveToward").await.is_empty());
    peer.was_safe().await;
}

/// Renewed in time it walks as smoothly, and as fast, as it was told.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn it_walks_at_the_speed_that_was_asked_for() {
    let Some(peer) = Peer::start("nao: the speed of a walk", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let walk = driver.open("walk", "Walk", &[]);
    let at_speed = |state: &Json| state["velocity"][0].as_f64().is_some_and(|speed| (speed - 0.05).abs() < 1e-3);
    let mut first = None;
    let (time, way) = loop {
        driver.tell(&walk, 9.0);
        driver.step().await;
        let state = peer.state().await;
        if let Some((from, at)) = first {
            let time = (state["t_ms"].as_f64().unwrap() - from) / 1e3;
            if time > 4.0 {
                break (time, state["pose"][0].as_f64().unwrap() - at);
            }
        } else if at_speed(&state) {
            first = Some((state["t_ms"].as_f64().unwrap(), state["pose"][0].as_f64().unwrap()));
        }
    };
    assert!((0.5..1.05).contains(&(way / time / 0.05)), "{way} m in {time} s");
    driver.nao.close(&walk);
    driver.sees(&peer, "it stands", |state| state["moving"] == json!(false)).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn everything_else_is_called_as_a_robot_wants_it() {
    let Some(peer) = Peer::start("nao: actions", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let eyes = driver.open("eyes", "EyeLedColor", &[("color", text("red"))]);
    driver.tell(&eyes, true);
    driver.sees(&peer, "red eyes", |state| state["leds"]["FaceLeds"][1].as_f64() == Some(0.0)).await;
    let fade = peer.calls("ALLeds.fadeRGB").await[0].clone();
    assert_eq!((&fade[0], &fade[1]), (&json!("FaceLeds"), &json!(0xFF_0000)));
    let bright = driver.open("bright", "EyeBrightness", &[]);
    driver.tell(&bright, 0.5);
    driver.sees(&peer, "they are darker", |state| state["leds"]["FaceLeds"][0].as_f64().unwrap() < 0.6).await;
    let gesture = driver.open("hey", "Animation", &[]);
    driver.tell(&gesture, true);
    driver.tell(&gesture, true);
    driver.sees(&peer, "it waves", |state| !state["playing"].as_array().unwrap().is_empty()).await;
    let posture = driver.open("sit", "Posture", &[("posture", text("Crouch"))]);
    driver.tell(&posture, true);
    driver.sees(&peer, "it crouches", |state| state["family"] == "Crouching").await;
    assert_eq!(peer.calls("ALAnimationPlayer.run").await, [json!(["animations/Stand/Gestures/Hey_1"])]);
    let follow = driver.open("follow", "Tracker", &[]);
    driver.tell(&follow, true);
    let looks = |state: &Json| state["subscribers"].to_string().contains("rrp-test/follow/RedBall");
    driver.sees(&peer, "it follows", looks).await;
    let turned = |state: &Json| state["joints"]["HeadYaw"].as_f64().is_some_and(|yaw| (yaw - 0.24).abs() < 0.03);
    driver.sees(&peer, "it looks at the ball", turned).await;
    driver.sees(&peer, "it follows no more", |state| !looks(state)).await;
    assert!(peer.calls("ALTracker.track").await.is_empty(), "which nothing would end without us");
    let beep = driver.open("beep", "Sound", &[]);
    driver.tell(&beep, true);
    let learn = driver.open("learn", "RememberFace", &[]);
    driver.tell(&learn, text("Aiko"));
    let print = driver.open("print", "Print", &[]);
    driver.tell(&print, text("here"));
    let printed = driver.nao.scene().body.printed;
    assert_eq!(printed.iter().map(|one| (&one.by, one.text.as_str())).collect::<Vec<_>>(), [(&print, "here")]);
    for method in ["ALAudioPlayer.playSine", "ALFaceDetection.learnFace"] {
        let mut patience = 0;
        while peer.calls(method).await.is_empty() {
            patience += 1;
            assert!(patience < 1_000, "never: {method}");
            driver.step().await;
        }
    }
    assert!(
        driver.nao.open(&crate::driver::user("x"), "Walk", &[("speed".to_owned(), Value::Float(9.0))].into()).is_err()
    );
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn eyes_keep_their_colour_when_their_brightness_changes() {
    let Some(peer) = Peer::start("nao: eyes", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let color = driver.open("color", "EyeLedColor", &[("color", text("red"))]);
    let bright = driver.open("bright", "EyeBrightness", &[]);
    driver.tell(&color, true);
    driver.sees(&peer, "they are red", |state| state["leds"]["FaceLeds"] == json!([1.0, 0.0, 0.0])).await;
    driver.tell(&bright, 0.2);
    driver
        .sees(&peer, "they are a darker red", |state| {
            let of = |at: usize| state["leds"]["FaceLeds"][at].as_f64().unwrap();
            (of(0) - 0.2).abs() < 0.01 && of(1) == 0.0 && of(2) == 0.0
        })
        .await;
    let shown = driver.nao.scene().body.eyes;
    assert!((shown[0] - 0.2).abs() < 1e-6 && shown[1] == 0.0, "{shown:?}");
    // A colour that comes later has the brightness that is there.
    let blue = driver.open("blue", "EyeLedColor", &[("color", text("blue"))]);
    driver.tell(&blue, true);
    driver
        .sees(&peer, "they are a dark blue", |state| {
            let of = |at: usize| state["leds"]["FaceLeds"][at].as_f64().unwrap();
            of(0) == 0.0 && (of(2) - 0.2).abs() < 0.01
        })
        .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn gestures_that_no_package_has_are_done_by_the_arms() {
    let Some(peer) = Peer::start("nao: own gestures", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    for (at, (name, pitch)) in [("HighFive", "RShoulderPitch"), ("HeyLeft", "LShoulderPitch")].into_iter().enumerate() {
        let gesture = driver.open(name, "Animation", &[("animation", text(name))]);
        driver.tell(&gesture, true);
        let mut calls = Vec::new();
        for _ in 0..600 {
            driver.step().await;
            calls = peer.calls("ALMotion.angleInterpolation").await;
            if calls.len() > at {
                break;
            }
        }
        let [names, angles, times, absolute] = &calls[at].as_array().unwrap()[..] else { panic!("{calls:?}") };
        assert_eq!(
            (&names[0], &angles[0][1], absolute),
            (&json!(pitch), &angles[0][0], &json!(true)),
            "it holds still"
        );
        let rows = [names, angles, times].map(|rows| rows.as_array().unwrap().len());
        assert!(rows[0] >= 4 && rows[1] == rows[0] && rows[2] == rows[0], "{rows:?}");
        driver.nao.close(&gesture);
    }
    for (name, path) in [
        ("Dance", "animations/Stand/Waiting/FunnyDancer_1"),
        ("Clap", "animations/Stand/Gestures/Applause_1"),
        ("Surprised", "animations/Stand/Emotions/Negative/Surprise_1"),
    ] {
        let gesture = driver.open(name, "Animation", &[("animation", text(name))]);
        driver.tell(&gesture, true);
        driver.sees(&peer, name, |state| state["playing"].to_string().contains(path)).await;
        driver.nao.close(&gesture);
    }
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_did_not_come_about_is_told_in_words() {
    let Some(peer) = Peer::start("nao: refusals", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let raw = "ALAnimationPlayer::run\n\tnaoqi/behavior.cpp:77 animations/Stand/Gestures/Hey_1 is not installed";
    peer.fault(json!([
        {"do": "error", "service": "ALAnimationPlayer", "method": "run", "text": raw},
        {"do": "error", "service": "ALAudioPlayer", "method": "playFile", "text": "ALAudioPlayer::playFile\n\tno file"},
        {"do": "answer", "service": "ALRobotPosture", "method": "goToPosture", "value": false},
        {"do": "answer", "service": "ALFaceDetection", "method": "learnFace", "value": false},
    ]))
    .await;
    let hey = driver.open("hey", "Animation", &[]);
    let song = driver.open("song", "Sound", &[("sound", text("file")), ("file", text("/home/nao/none.wav"))]);
    let stand = driver.open("stand", "Posture", &[]);
    let face = driver.open("face", "RememberFace", &[]);
    for user in [&hey, &song, &stand, &face] {
        driver.tell(user, text("Aiko"));
    }
    let mut told = std::collections::BTreeMap::new();
    driver
        .until("all four are told", |driver| {
            told.extend(driver.nao.take_refused().into_iter().map(|(user, fault)| (user, fault.to_string())));
            told.len() == 4
        })
        .await;
    assert_eq!(
        told[&hey],
        "the robot cannot do this now: it does not know this gesture, or something keeps it from it"
    );
    assert_eq!(told[&song], "the robot cannot do this now: it has no such sound, or cannot play it");
    assert_eq!(told[&stand], "the robot cannot do this now: it did not come into the posture");
    assert_eq!(told[&face], "no face is in view, so none was remembered");
    assert!(driver.nao.take_refused().is_empty(), "each is told once");
}
