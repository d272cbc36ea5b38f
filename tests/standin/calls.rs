//! Services, their calls and the log of them, and faults on command.

use crate::nao::{Nao, PATIENCE, next};
use qi::{Object, QiError, Value};
use serde_json::json;
use std::time::Duration;

/// What a NAO has, of what we use.
const SERVICES: [&str; 32] = [
    "ALAnimatedSpeech",
    "ALAnimationPlayer",
    "ALAudioDevice",
    "ALAudioPlayer",
    "ALAutonomousBlinking",
    "ALAutonomousLife",
    "ALBackgroundMovement",
    "ALBasicAwareness",
    "ALBattery",
    "ALBehaviorManager",
    "ALBodyTemperature",
    "ALColorBlobDetection",
    "ALConnectionManager",
    "ALFaceDetection",
    "ALLandMarkDetection",
    "ALLeds",
    "ALListeningMovement",
    "ALMemory",
    "ALMotion",
    "ALPeoplePerception",
    "ALRedBallDetection",
    "ALRobotModel",
    "ALRobotPosture",
    "ALSonar",
    "ALSoundLocalization",
    "ALSpeakingMovement",
    "ALSpeechRecognition",
    "ALSystem",
    "ALTextToSpeech",
    "ALTracker",
    "ALVideoDevice",
    "StandIn",
];

#[tokio::test]
async fn every_service_of_a_nao_is_there() {
    let Some(nao) = Nao::start("services of the stand-in", &[]).await else { return };
    let mut names: Vec<String> = nao.session.services().await.unwrap().into_iter().map(|one| one.name).collect();
    names.retain(|name| name != "ServiceDirectory");
    names.sort_unstable();
    assert_eq!(names, SERVICES);
    for name in SERVICES {
        let overloads = |method: &str, service: &Object| service.meta().candidates(method).len();
        let service = nao.service(name).await;
        match name {
            "ALLeds" => assert_eq!(overloads("fadeRGB", &service), 3),
            "ALRedBallDetection" => assert_eq!(overloads("subscribe", &service), 2),
            "ALTextToSpeech" | "ALAnimatedSpeech" => assert_eq!(overloads("say", &service), 2),
            "ALMotion" => assert_eq!((overloads("moveTo", &service), overloads("rest", &service)), (2, 2)),
            _ => assert!(overloads("ping", &service) == 1, "{name}"),
        }
        // What only the stand-in itself may call is not published.
        assert!(service.meta().methods.iter().all(|method| !method.name.starts_with('_')), "{name}");
    }
}

#[tokio::test]
async fn calls_are_noted_in_their_order_and_a_fault_happens_once() {
    let Some(nao) = Nao::start("the log of the stand-in", &[]).await else { return };
    let motion = nao.service("ALMotion").await;
    for number in 0..200 {
        let angle = f64::from(number) / 1000.0;
        motion.post("setAngles", &[Value::dynamic("HeadYaw"), Value::dynamic(angle), 0.5.into()]).unwrap();
    }
    nao.fault(json!({"do": "error", "service": "ALLeds", "method": "on", "text": "ALLeds::on\n\tnot today"})).await;
    nao.fault(json!({"do": "answer", "service": "ALSystem", "method": "robotName", "value": "Nobody"})).await;
    let failed = nao.try_call("ALLeds", "on", json!(["FaceLeds"])).await.unwrap_err();
    assert!(failed.to_string().contains("not today"), "{failed}");
    nao.call("ALLeds", "on", json!(["FaceLeds"])).await;
    assert_eq!(nao.call("ALSystem", "robotName", json!([])).await.as_text().unwrap(), "Nobody");
    assert_ne!(nao.call("ALSystem", "robotName", json!([])).await.as_text().unwrap(), "Nobody");
    motion.call("ping", &[]).await.unwrap();
    let calls = nao.told("calls").await;
    let calls = calls.as_array().unwrap();
    let angles =
        calls.iter().filter(|call| call["method"] == "setAngles").map(|call| call["args"][1].as_f64().unwrap());
    assert!(angles.clone().count() == 200 && angles.is_sorted(), "as they were sent");
    assert!(calls.iter().map(|call| call["seq"].as_u64().unwrap()).eq(1..=calls.len() as u64));
    let leds: Vec<_> = calls.iter().filter(|call| call["service"] == "ALLeds").collect();
    assert!(leds.len() == 2 && leds[0]["args"] == json!(["FaceLeds"]));
}

#[tokio::test]
async fn an_answer_may_be_late_or_never_come() {
    let Some(nao) = Nao::start("late answers of the stand-in", &[]).await else { return };
    let (leds, short) = (nao.service("ALLeds").await, Duration::from_millis(300));
    nao.fault(json!([{"do": "never", "service": "ALLeds"}, {"do": "delay", "service": "ALSystem", "ms": 400}])).await;
    let never = leds.call_within("on", &["FaceLeds".into()], short).await;
    assert!(matches!(never, Err(QiError::Timeout { .. })), "{never:?}");
    assert!(leds.call("on", &["FaceLeds".into()]).await.is_ok(), "and the next is answered");
    let asked = std::time::Instant::now();
    nao.call("ALSystem", "robotName", json!([])).await;
    assert!(asked.elapsed() >= Duration::from_millis(400));
}

#[tokio::test]
async fn services_come_and_go_and_events_have_any_form() {
    let Some(nao) = Nao::start("comings and goings of the stand-in", &[]).await else { return };
    let (mut added, mut removed) = (nao.session.added().await.unwrap(), nao.session.removed().await.unwrap());
    let before = nao.service("ALTracker").await.service_id();
    nao.fault(json!({"do": "restart", "service": "ALTracker"})).await;
    next(&mut removed).await;
    next(&mut added).await;
    nao.session.forget("ALTracker");
    assert_ne!(nao.service("ALTracker").await.service_id(), before);
    nao.fault(json!({"do": "unregister", "service": "ALTracker"})).await;
    next(&mut removed).await;
    nao.session.forget("ALTracker");
    assert!(nao.session.service("ALTracker").await.is_err());
    let mut odd = nao.listen("FaceDetected").await;
    nao.fault(json!({"do": "raise", "key": "FaceDetected", "value": [[], {"a": [null, "b"]}, 3]})).await;
    assert!(next(&mut odd.events).await.is_array());
    nao.fault(json!({"do": "burst", "key": "FaceDetected", "count": 60, "hz": 1000})).await;
    let mut came = Vec::new();
    for _ in 0..60 {
        came.push(next(&mut odd.events).await.as_i64().unwrap());
    }
    came.sort_unstable();
    assert!(came.into_iter().eq(0..60), "each once, in whatever order");
}

#[tokio::test]
async fn the_process_freezes_and_goes_on() {
    let Some(nao) = Nao::start("the stand-in frozen", &[]).await else { return };
    nao.service("ALSystem").await;
    nao.fault(json!({"do": "freeze", "seconds": 3})).await;
    let robot = nao.service("ALSystem").await;
    let frozen = async { while robot.call_within("robotName", &[], Duration::from_millis(300)).await.is_ok() {} };
    tokio::time::timeout(PATIENCE, frozen).await.unwrap();
    assert!(robot.call("robotName", &[]).await.is_ok());
}
