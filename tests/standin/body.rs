//! What it speaks, how it moves, and what becomes of it when somebody lets go.

use crate::nao::{Nao, next, plain};
use qi::Value;
use serde_json::{Value as Json, json};

fn near(one: &Json, other: f64) -> bool {
    (one.as_f64().unwrap() - other).abs() < 0.01
}

#[tokio::test]
async fn a_text_is_spoken_before_say_answers_and_stop_all_releases_it() {
    let Some(nao) = Nao::start("speech of the stand-in", &[]).await else { return };
    let voice = nao.service("ALTextToSpeech").await;
    let mut interrupted = nao.listen("ALTextToSpeech/TextInterrupted").await;
    nao.call("ALTextToSpeech", "say", json!(["hi"])).await;
    assert_eq!(nao.told("state").await["spoken"], json!(["hi"]));
    // Longer than anybody waits.
    nao.world(json!({"speech_ms_per_char": 60_000})).await;
    let words = ["first".into(), "English".into()];
    let second = ["second".into()];
    let (one, other) = (voice.call("say", &words), voice.call("say", &second));
    let stopping = async {
        nao.until("both wait", |state| state["blocked"].as_array().unwrap().len() == 2).await;
        let state = nao.told("state").await;
        assert_eq!((&state["speaking"], &state["waiting_texts"]), (&json!("first"), &json!(["second"])));
        voice.call("stopAll", &[]).await.unwrap();
    };
    let (one, other, ()) = tokio::join!(one, other, stopping);
    assert!(one.is_ok() && other.is_ok());
    next(&mut interrupted.events).await;
    let state = nao.told("state").await;
    assert_eq!((&state["speaking"], &state["spoken"]), (&Json::Null, &json!(["hi", "first"])));
}

#[tokio::test]
async fn joints_move_inside_their_limits_and_not_without_stiffness() {
    let Some(nao) = Nao::start("joints of the stand-in", &[]).await else { return };
    nao.call("ALMotion", "setAngles", json!(["HeadYaw", 9.0, 0.5])).await;
    nao.until("the head is at its limit", |state| near(&state["joints"]["HeadYaw"], 2.0857)).await;
    nao.call("ALMotion", "setAngles", json!([["HeadYaw", "HeadPitch"], [0.5, 0.5], 1.0])).await;
    // Turned that far there is less room for the pitch, by the table of the body.
    nao.until("it came back", |state| near(&state["joints"]["HeadYaw"], 0.5)).await;
    let state = nao.until("it nods", |state| state["joints"]["HeadPitch"].as_f64().unwrap() > 0.4).await;
    assert!(state["joints"]["HeadPitch"].as_f64().unwrap() < 0.43);
    nao.call("ALMotion", "setStiffnesses", json!(["Head", 0.0])).await;
    nao.call("ALMotion", "setAngles", json!(["HeadYaw", 1.0, 1.0])).await;
    let then = nao.told("state").await["t_ms"].as_u64().unwrap();
    let state = nao.until("time passes", |state| state["t_ms"].as_u64().unwrap() > then + 500).await;
    assert!(near(&state["joints"]["HeadYaw"], 0.5) && state["violations"] == json!([]));
    assert!(nao.try_call("ALMotion", "setAngles", json!(["Nose", 1.0, 1.0])).await.is_err());
    let angles = plain(&nao.call("ALMotion", "getAngles", json!(["Body", true])).await);
    assert_eq!(angles.as_array().unwrap().len(), 26);
}

#[tokio::test]
async fn whoever_lets_go_of_a_standing_robot_is_told_on() {
    let Some(nao) = Nao::start("falls of the stand-in", &[]).await else { return };
    let mut falling = nao.listen("ALMotion/RobotIsFalling").await;
    nao.call("ALMotion", "killMove", json!([])).await;
    nao.call("ALMotion", "setStiffnesses", json!(["Body", 0.0])).await;
    assert_eq!(next(&mut falling.events).await, json!(true));
    let state = nao.until("it lies", |state| state["life"] == "safeguard").await;
    assert_eq!(state["violations"], json!(["killMove while standing", "stiffness off while standing"]));
    assert!(state["fallen"] == json!(true) && state["posture"] == "LyingBelly");
    let up = nao.call("ALRobotPosture", "goToPosture", json!(["StandInit", 1.0])).await;
    assert_eq!(up.as_bool(), Some(true), "it gets up");
    assert_eq!(nao.told("state").await["fallen"], json!(false));
}

#[tokio::test]
async fn a_walk_ends_where_it_was_sent_or_when_it_is_stopped() {
    let Some(nao) = Nao::start("walks of the stand-in", &[]).await else { return };
    assert_eq!(nao.call("ALMotion", "moveTo", json!([0.1, 0.0, 0.2])).await.as_bool(), Some(true));
    let state = nao.told("state").await;
    assert!(near(&state["pose"][0], 0.1) && near(&state["pose"][2], 0.2), "{}", state["pose"]);
    let motion = nao.service("ALMotion").await;
    let far = [1.0.into(), 0.0.into(), 0.0.into()];
    let stopping = async {
        nao.until("it walks", |state| state["moving"] == json!(true)).await;
        motion.call("stopMove", &[]).await.unwrap();
    };
    let (walked, ()) = tokio::join!(motion.call("moveTo", &far), stopping);
    assert_eq!(walked.unwrap().as_bool(), Some(false));
    nao.until("it stands", |state| state["moving"] == json!(false)).await;
}

#[tokio::test]
async fn a_smaller_nao_has_no_wrists_and_a_pepper_no_legs() {
    for (body, joints, without) in [("h21", 22, "LWristYaw"), ("pepper", 20, "LKneePitch")] {
        let part = format!("the stand-in as {body}");
        let Some(nao) = Nao::start(&part, &["--body", body, "--without", "ALTracker"]).await else { return };
        let names = plain(&nao.call("ALMotion", "getBodyNames", json!(["Body"])).await);
        let names = names.as_array().unwrap();
        assert!(names.len() == joints && !names.contains(&json!(without)), "{names:?}");
        assert!(nao.session.service("ALTracker").await.is_err());
        assert_eq!(nao.call("ALRobotPosture", "goToPosture", json!(["Crouch", 1.0])).await.as_bool(), Some(true));
    }
}

/// Walks until a foot is in the air.
async fn steps(nao: &Nao) {
    nao.call("ALMotion", "move", json!([0.05, 0.0, 0.0])).await;
    nao.until("a foot is in the air", |state| state["in_the_air"] == json!(true)).await;
}

#[tokio::test]
async fn stop_move_answers_when_both_feet_are_on_the_ground_and_then_the_legs_may_be_set() {
    let Some(nao) = Nao::start("a step of the stand-in", &[]).await else { return };
    for _ in 0..3 {
        steps(&nao).await;
        nao.call("ALMotion", "stopMove", json!([])).await;
        let state = nao.told("state").await;
        assert_eq!((&state["moving"], &state["in_the_air"]), (&json!(false), &json!(false)));
        nao.call("ALMotion", "killAll", json!([])).await;
        nao.call("ALMotion", "setAngles", json!(["LKneePitch", 0.9, 0.3])).await;
    }
    let state = nao.told("state").await;
    assert_eq!((&state["fallen"], &state["violations"]), (&json!(false), &json!([])));
}

/// What a Stop did that did not wait for the legs: it made the robot fall.
#[tokio::test]
async fn whoever_sets_the_legs_or_kills_the_walk_in_mid_step_makes_it_fall() {
    for (method, arguments) in [("setAngles", json!(["LKneePitch", 0.9, 0.3])), ("killAll", json!([]))] {
        let Some(nao) = Nao::start("a fall in mid-step", &[]).await else { return };
        steps(&nao).await;
        let motion = nao.service("ALMotion").await;
        let (stopped, _) = tokio::join!(motion.call("stopMove", &[]), nao.call("ALMotion", method, arguments));
        stopped.unwrap();
        let state = nao.until("it lies", |state| state["fallen"] == json!(true)).await;
        assert!(state["violations"].to_string().contains("in mid-step"), "{}", state["violations"]);
    }
}

#[tokio::test]
async fn a_new_way_takes_the_place_of_the_old_one_and_the_gait_is_the_callers() {
    let Some(nao) = Nao::start("gaits of the stand-in", &[]).await else { return };
    let motion = nao.service("ALMotion").await;
    let pair = |name: &str, value: f32| Value::dynamic(Value::List(vec![Value::dynamic(name), Value::dynamic(value)]));
    let gait = |step: f32| Value::dynamic(Value::List(vec![pair("MaxStepX", step)]));
    let far = [1.0.into(), 0.0.into(), 0.0.into(), gait(0.0126)];
    let renewing = async {
        let state = nao.until("it walks", |state| state["velocity"][0].as_f64().unwrap() > 0.025).await;
        let from = state["pose"][0].as_f64().unwrap();
        assert_eq!(
            motion.call("moveTo", &[0.02.into(), 0.0.into(), 0.0.into(), gait(0.0126)]).await.unwrap().as_bool(),
            Some(true)
        );
        from
    };
    let (replaced, from) = tokio::join!(motion.call("moveTo", &far), renewing);
    assert_eq!(replaced.unwrap().as_bool(), Some(false));
    let state = nao.told("state").await;
    assert!((state["pose"][0].as_f64().unwrap() - from - 0.02).abs() < 0.01, "{from} {}", state["pose"]);
    assert!(state["velocity"][0].as_f64().unwrap() < 0.0301, "no faster than a step of 0.0126 m in 0.42 s");
    assert!(motion.call("moveTo", &[1.0.into(), 0.0.into(), 0.0.into(), gait(0.09)]).await.is_err());
}

#[tokio::test]
async fn a_robot_that_is_carried_or_limp_does_not_begin_to_walk() {
    let Some(nao) = Nao::start("a stand-in that is carried", &[]).await else { return };
    let mut contact = nao.listen("footContactChanged").await;
    steps(&nao).await;
    nao.world(json!({"carried": true})).await;
    assert_eq!(next(&mut contact.events).await, json!(false));
    nao.until("it walks no more", |state| state["moving"] == json!(false)).await;
    assert_eq!(nao.call("ALMotion", "moveTo", json!([0.1, 0.0, 0.0])).await.as_bool(), Some(false));
    nao.world(json!({"carried": false})).await;
    nao.call("ALMotion", "setStiffnesses", json!(["LKneePitch", 0.5])).await;
    assert_eq!(nao.call("ALMotion", "moveTo", json!([0.1, 0.0, 0.0])).await.as_bool(), Some(false));
    nao.call("ALMotion", "setStiffnesses", json!(["LKneePitch", 1.0])).await;
    assert_eq!(nao.call("ALMotion", "moveTo", json!([0.1, 0.0, 0.0])).await.as_bool(), Some(true));
}
