//! Tests of what each sense gives for what is in the room.

use crate::driver::{Driver, number};
use crate::peer::{PATIENCE, Peer};
use behaviour::Value;
use robot::Robot;
use serde_json::json;

fn text(text: &str) -> Value {
    Value::text(text)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn balls_are_where_they_are() {
    let Some(peer) = Peer::start("nao: balls", &[]).await else { return };
    peer.world(json!({"balls": {"red": {"at": [0.8, 0.1, 0.5]}, "green": {"at": [0.8, -0.1, 0.45]}}})).await;
    let mut driver = Driver::at(&peer.address).await;
    let ball = driver.open("ball", "RedBall", &[]);
    let seen = peer.state().await["balls"]["red"]["seen"].clone();
    let value = driver.next(&ball).await;
    for (at, field) in ["x", "y", "size"].iter().enumerate() {
        assert!((number(&value, field) - seen[at].as_f64().unwrap()).abs() < 0.02, "{field}: {value} {seen}");
    }
    let green = driver.open("green", "ColorBall", &[("color", text("green"))]);
    let seen = peer.state().await["balls"]["green"]["seen"].clone();
    let value = driver.next(&green).await;
    for (at, field) in ["x", "y", "size"].iter().enumerate() {
        assert!((number(&value, field) - seen[at].as_f64().unwrap()).abs() < 0.03, "{field}: {value} {seen}");
    }
    // The robot looks for one color at a time: another one takes turns with it, and nothing is mistaken.
    peer.world(json!({"balls": {"blue": {"at": [0.9, 0.2, 0.45]}}})).await;
    let blue = driver.open("blue", "ColorBall", &[("color", text("blue"))]);
    for _ in 0..3 {
        for (user, ball) in [(&blue, "blue"), (&green, "green")] {
            let value = driver.next(user).await;
            let seen = peer.state().await["balls"][ball]["seen"].clone();
            assert!((number(&value, "x") - seen[0].as_f64().unwrap()).abs() < 0.03, "{ball}: {value} {seen}");
        }
    }
    driver.nao.close(&ball);
    driver.nao.close(&green);
    driver.nao.close(&blue);
    driver
        .sees(&peer, "nothing is measured any more", |state| {
            state["subscribers"].as_object().unwrap().values().all(|of| of.as_object().unwrap().is_empty())
        })
        .await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn people_faces_and_marks_are_seen() {
    let Some(peer) = Peer::start("nao: people", &[]).await else { return };
    peer.world(json!({"people": {"person": {"at": [1.2, 0.0], "height": 0.75, "present": true}},
        "landmarks": {"64": {"at": [1.0, 0.25, 0.5], "facing": std::f64::consts::PI, "present": true}}}))
        .await;
    let mut driver = Driver::at(&peer.address).await;
    let people = driver.open("people", "People", &[]);
    let value = driver.next(&people).await;
    assert_eq!(value.field("count"), Some(&Value::Int(1)));
    assert!((number(&value, "distance") - 1.2).abs() < 0.2, "{value}");
    let face = driver.open("face", "FaceDetection", &[]);
    let value = driver.next(&face).await;
    assert_eq!((value.field("label"), value.field("new")), (Some(&text("")), Some(&Value::Bool(true))), "{value}");
    let mark = driver.open("mark", "Landmark", &[]);
    let value = driver.next(&mark).await;
    assert_eq!(value.field("number"), Some(&Value::Int(64)));
    assert!(number(&value, "x") > 0.1 && number(&value, "size") > 0.02, "{value}");
    peer.world(json!({"people": {"person": {"present": false}}})).await;
    let end = std::time::Instant::now() + crate::peer::PATIENCE;
    while driver.next(&people).await.field("count") != Some(&Value::Int(0)) {
        assert!(std::time::Instant::now() < end, "nobody is there");
    }
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn touches_words_and_sounds_are_told_once() {
    let Some(peer) = Peer::start("nao: touches", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let head = driver.open("head", "HeadTouch", &[]);
    let both = driver.open("both", "HeadTouch", &[("release", text("yes"))]);
    let hand = driver.open("hand", "HandTouch", &[("hand", text("left"))]);
    let foot = driver.open("foot", "Bumper", &[("foot", text("right"))]);
    let words = driver.open("words", "WordRecognized", &[("words", text("Yes, no"))]);
    let sound = driver.open("sound", "SoundLocated", &[]);
    driver.sees(&peer, "it listens", |state| state["vocabulary"] == json!(["Yes", "no"])).await;
    driver.sees(&peer, "all is heard", |state| state["listened"].as_array().unwrap().len() >= 12).await;
    driver.wait(40).await;
    driver.readings.clear();
    for (part, down) in [
        ("FrontTactilTouched", true),
        ("FrontTactilTouched", false),
        ("HandLeftBackTouched", true),
        ("HandRightBackTouched", true),
        ("LeftBumperPressed", true),
        ("RightBumperPressed", true),
    ] {
        peer.world(json!({"touch": {"part": part, "down": down}})).await;
        driver.wait(20).await;
    }
    driver.until("all is told", |driver| driver.readings.len() >= 5).await;
    let told = |user: &robot::Use| -> Vec<Value> {
        driver.readings.iter().filter(|reading| reading.to == *user).map(|reading| reading.value.clone()).collect()
    };
    let (yes, no) = (Value::Bool(true), Value::Bool(false));
    assert_eq!(told(&head), vec![yes.clone()]);
    assert_eq!(told(&both), [yes.clone(), no]);
    assert_eq!((told(&hand), told(&foot)), (vec![yes.clone()], vec![yes]));
    peer.world(json!({"word": {"word": "yes", "confidence": 0.7}})).await;
    let heard = driver.next(&words).await;
    assert_eq!(heard.field("word"), Some(&text("Yes")), "as it was chosen: {heard}");
    peer.world(json!({"sound": {"at": [0.0, 1.0, 0.5], "loudness": 0.9}})).await;
    assert!(number(&driver.next(&sound).await, "azimuth") > 1.0);
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn numbers_of_the_body_are_told() {
    let Some(peer) = Peer::start("nao: body", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    peer.world(json!({"obstacles": {"box": {"at": [0.6, 0.0], "size": [0.2, 0.8, 0.6], "present": true}},
        "joints": {"HeadYaw": 0.3}, "battery": 71}))
        .await;
    let sonar = driver.open("sonar", "Sonar", &[]);
    let end = std::time::Instant::now() + crate::peer::PATIENCE;
    loop {
        let metres = driver.next(&sonar).await.as_number().unwrap();
        if (0.2..0.7).contains(&metres) {
            break;
        }
        assert!(std::time::Instant::now() < end, "{metres}");
    }
    let joint = driver.open("joint", "JointPosition", &[("joint", text("HeadYaw"))]);
    assert!((driver.next(&joint).await.as_number().unwrap() - 0.3).abs() < 0.05);
    let battery = driver.open("battery", "Battery", &[]);
    assert_eq!(driver.next(&battery).await, Value::Int(71));
    let posture = driver.open("posture", "PostureChanged", &[]);
    assert_eq!(driver.next(&posture).await, text("Standing"));
    let tick = driver.open("tick", "Tick", &[("period_ms", Value::Float(50.0))]);
    assert_eq!(driver.next(&tick).await, Value::Int(1));
    let fall = driver.open("fall", "Fall", &[]);
    driver.sees(&peer, "falls are heard", |state| state["listened"].to_string().contains("robotHasFallen")).await;
    driver.wait(40).await;
    peer.world(json!({"push": "belly"})).await;
    assert_eq!(driver.next(&fall).await, Value::Bool(true));
    let mut why = None;
    driver
        .until("it halts", |driver| {
            why = why.take().or_else(|| driver.nao.take_halt());
            why.is_some()
        })
        .await;
    assert!(why.unwrap().to_string().starts_with("it f"));
    peer.was_safe().await;
}

/// Values of a stream from now on, until none comes for a while of robot time.
async fn ends(driver: &mut Driver, user: &robot::Use) {
    let end = std::time::Instant::now() + crate::peer::PATIENCE;
    loop {
        driver.readings.clear();
        driver.wait(100).await;
        if !driver.readings.iter().any(|reading| reading.to == *user) {
            return;
        }
        assert!(std::time::Instant::now() < end, "it is never lost");
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_colour_that_is_gone_is_lost() {
    let Some(peer) = Peer::start("nao: lost", &[]).await else { return };
    peer.world(json!({"balls": {"red": {"at": [0.8, 0.2, 0.5]}}})).await;
    let mut driver = Driver::at(&peer.address).await;
    let ball = driver.open("ball", "ColorBall", &[("color", text("red"))]);
    let thing = driver.open("thing", "Blob", &[("color", text("red"))]);
    let seen = peer.state().await["balls"]["red"]["seen"].clone();
    for user in [&ball, &thing] {
        let value = driver.next(user).await;
        for (at, field) in ["x", "y", "size"].iter().enumerate() {
            assert!((number(&value, field) - seen[at].as_f64().unwrap()).abs() < 0.02, "{field}: {value} {seen}");
        }
    }
    peer.world(json!({"balls": {"red": {"present": false}}})).await;
    ends(&mut driver, &ball).await;
    ends(&mut driver, &thing).await;
    peer.world(json!({"balls": {"red": {"present": true}}})).await;
    driver.next(&ball).await;
    driver.next(&thing).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_sense_that_does_not_work_is_named_until_it_ends() {
    let Some(peer) = Peer::start("nao: fails", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let raw = "ALRedBallDetection::subscribe\n\tCamera.cpp:42 V4L2 failed";
    peer.fault(json!({"do": "error", "service": "ALRedBallDetection", "method": "subscribe", "text": raw})).await;
    let ball = driver.open("ball", "RedBall", &[]);
    let mut told = String::new();
    driver
        .until("it is told", |driver| {
            // That its own life is on is told where nothing worse is.
            if let robot::Health::Degraded(why) = driver.nao.health()
                && why.to_string().contains("Red ball")
            {
                told = why.to_string();
            }
            !told.is_empty()
        })
        .await;
    assert_eq!(told, "“Red ball” does not work: it refuses");
    driver.nao.stop(robot::Millis(0));
    driver.nao.close(&ball);
    driver.until("it is ready again", |driver| driver.nao.health() == robot::Health::Ready).await;
    let again = driver.open("again", "RedBall", &[]);
    driver.next(&again).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_pepper_measures_ahead_and_behind_and_its_wheels_are_not_held() {
    let Some(peer) = Peer::start("nao: pepper", &["--body", "pepper"]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    assert_eq!(driver.nao.kind(), "pepper");
    peer.world(json!({"obstacles": {
        "box": {"at": [1.0, 0.0], "size": [0.2, 0.8, 0.8], "present": true},
        "block": {"at": [-1.5, 0.0], "size": [0.2, 0.8, 0.8], "present": true}}}))
        .await;
    for (stream, side, metres) in [("left", "left", 0.7), ("ahead", "nearest", 0.7), ("behind", "back", 1.2)] {
        let sonar = driver.open(stream, "Sonar", &[("side", text(side))]);
        let mut last = 0.0;
        driver
            .until("it measures", |driver| {
                let of = driver.readings.iter().rev().find(|reading| reading.to == sonar);
                last = of.and_then(|reading| reading.value.as_number()).unwrap_or_default();
                (last - metres).abs() < 0.1
            })
            .await;
    }
    let bumper = driver.open("bumper", "Bumper", &[("foot", text("back"))]);
    driver.sees(&peer, "it is heard", |state| state["listened"].to_string().contains("BackBumperPressed")).await;
    driver.wait(40).await;
    peer.world(json!({"touch": {"part": "BackBumperPressed", "down": true}})).await;
    assert_eq!(driver.next(&bumper).await, Value::Bool(true));
    let why = driver.nao.open(&crate::driver::user("side"), "HandTouch", &[("part".into(), text("left"))].into());
    assert_eq!(why.unwrap_err().to_string(), "its hands feel a touch on their backs only");
    // Stop holds what can be held.
    peer.clear().await;
    driver.nao.stop(robot::Millis(0));
    // What stands on the ground comes last, once the walk is over.
    let began = std::time::Instant::now();
    let held = loop {
        let held = peer.calls("ALMotion.setAngles").await;
        if held.iter().any(|call| call[0].to_string().contains("KneePitch")) {
            break held;
        }
        assert!(began.elapsed() < PATIENCE, "{held:?}");
        driver.step().await;
    };
    assert!(held.iter().all(|call| !call[0].to_string().contains("Wheel")), "{held:?}");
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_only_a_pepper_has_is_refused_by_a_nao() {
    let Some(peer) = Peer::start("nao: no back", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    for (device, param, why) in [
        ("Sonar", "side", "its body has no sonar at the back"),
        ("Bumper", "foot", "its body has no bumper at the back"),
    ] {
        let refused = driver.nao.open(&crate::driver::user("it"), device, &[(param.into(), text("back"))].into());
        assert_eq!(refused.unwrap_err().to_string(), why);
    }
}
