//! What it senses, in the forms of NAOqi, and when.

use crate::nao::{Nao, PATIENCE, PAUSE, next, plain};
use serde_json::{Value as Json, json};

/// Whether a value has a form: a form is a word for a kind, or a list of forms; a list that ends in `…` may go on.
fn fits(value: &Json, form: &Json) -> bool {
    match form {
        Json::Array(forms) => {
            let Some(values) = value.as_array() else { return false };
            let open = forms.last() == Some(&json!("…"));
            let forms = &forms[..forms.len() - usize::from(open)];
            let enough = if open { values.len() >= forms.len() } else { values.len() == forms.len() };
            enough && values.iter().zip(forms).all(|(value, form)| fits(value, form))
        }
        Json::String(kind) if kind == "number" => value.is_number(),
        Json::String(kind) if kind == "whole" => value.is_i64(),
        Json::String(kind) if kind == "text" => value.is_string(),
        Json::String(kind) if kind == "any" => true,
        exact => value == exact,
    }
}

#[tokio::test]
async fn an_extractor_tells_only_while_somebody_subscribed() {
    let Some(nao) = Nao::start("extractors of the stand-in", &[]).await else { return };
    let mut events = nao.listen("redBallDetected").await;
    let (ball, memory) = (nao.service("ALRedBallDetection").await, nao.service("ALMemory").await);
    let before = memory.call("getData", &["redBallDetected".into()]).await.unwrap();
    assert_eq!(plain(&before), json!([]), "nothing was ever told");
    for (name, period_ms) in [("slow", 10_000), ("quick", 20)] {
        ball.call("subscribe", &[name.into(), period_ms.into(), 0.0.into()]).await.unwrap();
    }
    // The shortest period counts, or the second would take ten seconds and the tenth more than there is patience.
    for _ in 0..10 {
        next(&mut events.events).await;
    }
    assert_eq!(nao.told("state").await["subscribers"], json!({"ALRedBallDetection": {"slow": 10_000, "quick": 20}}));
    for name in ["slow", "quick"] {
        ball.call("unsubscribe", &[name.into()]).await.unwrap();
    }
    let last = plain(&memory.call("getData", &["redBallDetected".into()]).await.unwrap());
    // A hundred of its steps later it has told nothing more.
    let then = nao.told("state").await["t_ms"].as_u64().unwrap();
    nao.until("two seconds are over", |state| state["t_ms"].as_u64().unwrap() > then + 2_000).await;
    assert_eq!(plain(&memory.call("getData", &["redBallDetected".into()]).await.unwrap()), last);
    assert_eq!(nao.told("state").await["subscribers"], json!({}));
}

#[tokio::test]
async fn values_have_the_forms_of_naoqi() {
    let Some(nao) = Nao::start("forms of the stand-in", &[]).await else { return };
    let (stamp, pose) =
        (json!(["whole", "whole"]), json!(["number", "number", "number", "number", "number", "number"]));
    nao.world(json!({"landmarks": {"64": {"present": true}}})).await;
    let ball = nao.first("ALRedBallDetection", "redBallDetected").await;
    let circle = json!(["number", "number", "number", "number"]);
    assert!(fits(&ball, &json!([stamp, circle, pose, pose, 0])), "{ball}");
    let mark = nao.first("ALLandMarkDetection", "LandmarkDetected").await;
    let shape = json!([1, "number", "number", "number", "number", "number"]);
    assert!(fits(&mark, &json!([stamp, [[shape, [64]]], pose, pose, "text"])), "{mark}");
    nao.call("ALColorBlobDetection", "setColor", json!([255, 0, 0, 30])).await;
    nao.call("ALColorBlobDetection", "setObjectProperties", json!([1, 0.06, "Circle"])).await;
    let blob = nao.first("ALColorBlobDetection", "ALTracker/ColorBlobDetected").await;
    assert!(fits(&blob, &json!([pose, pose, stamp, "whole"])), "{blob}");
    // Looking up at somebody a metre ahead.
    nao.world(json!({"joints": {"HeadPitch": -0.4}, "balls": {"red": {"present": false}},
        "people": {"person": {"at": [1.0, 0.0], "present": true}}}))
        .await;
    let face = nao.first("ALFaceDetection", "FaceDetected").await;
    let one = json!([[0, "number", "number", "number", "number"], [1, "number", "", "…"]]);
    assert!(fits(&face, &json!([stamp, [one, []], pose, pose, 0])), "{face}");
    let people = nao.first("ALPeoplePerception", "PeoplePerception/PeopleDetected").await;
    assert!(fits(&people, &json!([stamp, [[1, "number", "number", "number"]], pose, pose, 0])), "{people}");
    let mut sounds = nao.listen("ALSoundLocalization/SoundLocated").await;
    nao.call("ALSoundLocalization", "subscribe", json!(["test"])).await;
    nao.world(json!({"sound": {"at": [0.0, 1.0, 0.5]}})).await;
    let sound = next(&mut sounds.events).await;
    assert!(fits(&sound, &json!([stamp, ["number", "number", "number", "number"], pose, pose])), "{sound}");
    assert!((sound[1][0].as_f64().unwrap() - std::f64::consts::FRAC_PI_2).abs() < 0.02, "from the left");
    let mut touches = nao.listen("HandLeftBackTouched").await;
    nao.world(json!({"touch": {"part": "HandLeftBackTouched", "down": true}})).await;
    assert_eq!(next(&mut touches.events).await, json!(1.0));
}

#[tokio::test]
async fn a_circle_is_in_parts_of_rows_and_columns_and_stays_when_the_blob_is_gone() {
    let Some(nao) = Nao::start("circles of the stand-in", &[]).await else { return };
    nao.world(json!({"balls": {"red": {"at": [0.8, 0.1, 0.5], "color": "red"}}})).await;
    nao.call("ALColorBlobDetection", "setColor", json!([255, 0, 0, 30])).await;
    nao.call("ALColorBlobDetection", "setObjectProperties", json!([1, 0.06, "Circle"])).await;
    let mut events = nao.listen("ALTracker/ColorBlobDetected").await;
    nao.call("ALColorBlobDetection", "subscribe", json!(["test", 20, 0.0])).await;
    next(&mut events.events).await;
    let seen = nao.told("state").await["balls"]["red"]["seen"].clone();
    let circle = plain(&nao.call("ALColorBlobDetection", "getCircle", json!([])).await);
    let of = |list: &Json, at: usize| list[at].as_f64().unwrap();
    // A pinhole of 56.3 by 43.7 degrees over 320 columns and 240 rows.
    let (wide, high) = (2.0 * (0.98262_f64 / 2.0).tan(), 2.0 * (0.76271_f64 / 2.0).tan());
    let column = 320.0 * (0.5 - of(&seen, 0).tan() / wide);
    let row = 240.0 * (0.5 + of(&seen, 1).tan() / high);
    let radius = 320.0 * of(&seen, 2).tan() / wide;
    for (at, wanted) in [column / 240.0, row / 320.0, radius / 240.0].into_iter().enumerate() {
        assert!((of(&circle, at) - wanted).abs() < 0.02, "{at}: {circle} {wanted}");
    }
    nao.world(json!({"balls": {"red": {"present": false}}})).await;
    let then = nao.told("state").await["t_ms"].as_u64().unwrap();
    nao.until("ten pictures later", |state| state["t_ms"].as_u64().unwrap() > then + 300).await;
    let left = plain(&nao.call("ALColorBlobDetection", "getCircle", json!([])).await);
    assert!(left.as_array().is_some_and(|left| left.len() == 3), "the last one stays: {left}");
}

#[tokio::test]
async fn a_pepper_has_its_sonars_in_its_base_and_wheels_that_are_no_joints() {
    let Some(nao) = Nao::start("pepper of the stand-in", &["--body", "pepper"]).await else { return };
    let names = plain(&nao.call("ALMotion", "getBodyNames", json!(["Body"])).await);
    assert!(names.as_array().unwrap().contains(&json!("WheelB")), "{names}");
    let refused = nao.try_call("ALMotion", "setAngles", json!(["WheelB", 0.0, 0.2])).await.unwrap_err();
    assert!(refused.to_string().contains("wheels"), "{refused}");
    nao.world(json!({"obstacles": {"box": {"at": [1.0, 0.0], "size": [0.2, 0.8, 0.8], "present": true}}})).await;
    nao.call("ALSonar", "subscribe", json!(["test"])).await;
    let front = "Device/SubDeviceList/Platform/Front/Sonar/Sensor/Value";
    let memory = nao.service("ALMemory").await;
    let measured = async || plain(&memory.call("getData", &[front.into()]).await.unwrap()).as_f64().unwrap();
    let echo = async {
        while (measured().await - 0.7).abs() >= 0.1 {
            tokio::time::sleep(PAUSE).await;
        }
    };
    tokio::time::timeout(PATIENCE, echo).await.expect("the box is measured");
    assert!(memory.call("getData", &["Device/SubDeviceList/US/Left/Sensor/Value".into()]).await.is_err());
}

#[tokio::test]
async fn an_intensity_of_the_face_is_that_of_each_of_its_colours() {
    let Some(nao) = Nao::start("lights of the stand-in", &[]).await else { return };
    nao.call("ALLeds", "fadeRGB", json!(["FaceLeds", 0xFF_0000, 0.0])).await;
    nao.call("ALLeds", "setIntensity", json!(["FaceLeds", 0.5])).await;
    assert_eq!(nao.told("state").await["leds"]["FaceLeds"], json!([0.5, 0.5, 0.5]), "grey, and not red any more");
}

#[tokio::test]
async fn words_are_heard_only_as_the_vocabulary_allows() {
    let Some(nao) = Nao::start("words of the stand-in", &[]).await else { return };
    nao.call("ALSpeechRecognition", "setVocabulary", json!([["yes", "no"], true])).await;
    nao.call("ALSpeechRecognition", "subscribe", json!(["test"])).await;
    let running = nao.try_call("ALSpeechRecognition", "setVocabulary", json!([["no"], true])).await.unwrap_err();
    assert!(running.to_string().contains("modifiable_grammar"), "{running}");
    let mut words = nao.listen("WordRecognized").await;
    nao.world(json!({"word": {"word": "well, yes"}})).await;
    // Which of the two comes first, libqi does not promise.
    let mut heard = [next(&mut words.events).await, next(&mut words.events).await];
    heard.sort_by_key(|value| value[0].as_str().unwrap().len());
    assert_eq!(heard, [json!(["", -3.0]), json!(["<...> yes <...>", 0.6])]);
    nao.call("ALSpeechRecognition", "pause", json!([true])).await;
    nao.call("ALSpeechRecognition", "setVocabulary", json!([["maybe"], false])).await;
    assert_eq!(nao.told("state").await["vocabulary"], json!(["maybe"]));
}

#[tokio::test]
async fn a_picture_has_twelve_parts_and_a_name_works_six_times() {
    let Some(nao) = Nao::start("pictures of the stand-in", &[]).await else { return };
    for _ in 0..6 {
        nao.call("ALVideoDevice", "subscribeCamera", json!(["test", 0, 0, 11, 5])).await;
    }
    assert!(nao.try_call("ALVideoDevice", "subscribeCamera", json!(["test", 0, 0, 11, 5])).await.is_err());
    let picture = nao.call("ALVideoDevice", "getImageRemote", json!(["test_0"])).await;
    let parts = picture.seen().items().unwrap();
    assert_eq!((parts.len(), parts[0].as_i64(), parts[1].as_i64()), (12, Some(160), Some(120)));
    let pixels = parts[6].as_bytes().unwrap();
    assert_eq!(pixels.len(), 160 * 120 * 3, "{:?}", String::from_utf8_lossy(&pixels[..20]));
    assert!(pixels.chunks(3).any(|pixel| pixel == [255, 0, 0]), "the red ball is in it");
}
