//! What each sense gives for what is in the room.

use crate::driver::{Driver, number};
use crate::peer::Peer;
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
    assert!(why.unwrap().starts_with("it f"));
    peer.was_safe().await;
}
