//! Arms point at the ball, and joints and lights do what they are told.

use super::bench::Bench;
use behaviour::Value;
use robot::Robot;

/// Angle between shoulder-to-palm and shoulder-to-ball in radians, for the left or right arm.
fn pointing_error(bench: &Bench, side: usize, at: [f32; 3]) -> f32 {
    let body = bench.nao.scene().body;
    let torso_z = body.gaze[2] - 0.1265 - 0.063_64;
    let shoulder = [0.0, if side == 0 { 0.098 } else { -0.098 }, torso_z + 0.1];
    let way = |to: [f32; 3]| [0, 1, 2].map(|axis| to[axis] - shoulder[axis]);
    let (hand, ball) = (way(body.hands[side]), way(at));
    let dot = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
    libm::acosf((dot(hand, ball) / libm::sqrtf(dot(hand, hand) * dot(ball, ball))).clamp(-1.0, 1.0))
}

#[test]
fn the_nearest_arm_points_within_two_degrees() {
    let mut bench = Bench::new();
    bench.open("arm", "Tracker", &[("mode", "Arm"), ("effector", "Nearest")]);
    let places = [[0.6, 0.15, 0.45], [0.8, 0.3, 0.40], [1.2, 0.1, 0.5], [0.6, -0.15, 0.45], [0.9, -0.3, 0.5]];
    let mut sum = 0.0;
    for at in places {
        bench.ball("red", at);
        bench.keep("arm", true, 2_000);
        let side = usize::from(at[1] < 0.0);
        let error = pointing_error(&bench, side, at);
        assert!(error < 4.0_f32.to_radians(), "{at:?}: {error}");
        sum += error;
        let words = ["red ball with left arm", "red ball with right arm"][side];
        assert_eq!(bench.nao.scene().body.tracking, words);
        assert!(bench.joint("HeadYaw").abs() < 1e-6, "arms do not move the head");
    }
    assert!(sum / (places.len() as f32) < 2.0_f32.to_radians(), "{sum}");
}

#[test]
fn the_value_chooses_the_arm_and_the_other_goes_back() {
    let mut bench = Bench::new();
    bench.open("arm", "Tracker", &[("mode", "Arm")]);
    let stand = (bench.joint("LShoulderPitch"), bench.joint("RShoulderPitch"));
    bench.keep("arm", "left", 1_500);
    assert!(bench.joint("LShoulderPitch") < 0.8);
    assert!((bench.joint("RShoulderPitch") - stand.1).abs() < 1e-4);
    bench.keep("arm", "right", 4_000);
    assert!(bench.joint("RShoulderPitch") < 0.8);
    assert!((bench.joint("LShoulderPitch") - stand.0).abs() < 0.01);
}

#[test]
fn an_arm_goes_back_slowly_when_values_end() {
    let mut bench = Bench::new();
    bench.open("arm", "Tracker", &[("mode", "Head"), ("effector", "LArm")]);
    bench.keep("arm", true, 1_500);
    let up = bench.joint("LShoulderPitch");
    bench.wait(1_300);
    let soon = bench.joint("LShoulderPitch");
    bench.wait(5_000);
    assert!(up < 0.8 && soon < 1.3, "{up} {soon}");
    assert!((bench.joint("LShoulderPitch") - 1.4).abs() < 0.01);
}

#[test]
fn a_head_tracker_and_an_arm_tracker_work_together() {
    let mut bench = Bench::new();
    bench.open("head", "Tracker", &[("mode", "Head")]);
    bench.open("arm", "Tracker", &[("mode", "Arm")]);
    for _ in 0..20 {
        bench.tell("head", true);
        bench.tell("arm", "right");
        bench.wait(100);
    }
    assert_eq!(bench.nao.scene().body.tracking, "red ball with head, red ball with right arm");
    assert!((bench.joint("HeadYaw") - bench.bearing([0.6, 0.15, 0.45])).abs() < 0.02);
    assert!(bench.joint("RShoulderPitch") < 0.8);
}

#[test]
fn a_joint_goes_where_it_is_told_inside_its_limits() {
    let mut bench = Bench::new();
    bench.open("elbow", "SetJointPosition", &[("joint", "LElbowRoll")]);
    bench.open("hand", "SetJointPosition", &[("joint", "RHand")]);
    bench.tell("elbow", 5.0);
    bench.tell("hand", Value::Int(1));
    bench.wait(2_000);
    assert!((bench.joint("LElbowRoll") + 0.0349).abs() < 1e-3);
    assert!((bench.joint("RHand") - 1.0).abs() < 1e-3);
    assert!(bench.try_tell("elbow", f64::NAN).is_err());
    assert!(bench.try_tell("elbow", "far").is_err());
}

#[test]
fn the_newest_command_takes_the_head() {
    let mut bench = Bench::new();
    bench.open("tracker", "Tracker", &[]);
    bench.open("yaw", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.keep("tracker", true, 500);
    bench.tell("yaw", -0.5);
    bench.wait(800);
    assert!((bench.joint("HeadYaw") + 0.5).abs() < 0.01);
    assert_eq!(bench.nao.scene().body.tracking, "");
}

#[test]
fn eyes_shine_their_colour_times_their_brightness() {
    let mut bench = Bench::new();
    bench.open("red", "EyeLedColor", &[("color", "red")]);
    bench.open("value", "EyeLedColor", &[("color", "Value")]);
    bench.open("bright", "EyeBrightness", &[]);
    assert_eq!(bench.nao.scene().body.eyes, [1.0; 3]);
    bench.tell("red", true);
    bench.tell("bright", 0.5);
    assert_eq!(bench.nao.scene().body.eyes, [0.5, 0.0, 0.0]);
    bench.tell("value", "cyan");
    bench.tell("bright", 7.0);
    assert_eq!(bench.nao.scene().body.eyes, [0.0, 1.0, 1.0]);
    bench.tell("value", Value::object([("r", 0.25.into()), ("g", 2.0.into()), ("b", 0_i64.into())]));
    assert_eq!(bench.nao.scene().body.eyes, [0.25, 1.0, 0.0]);
    assert!(bench.try_tell("value", "plaid").is_err());
}

#[test]
fn words_are_spoken_in_turn_and_shown_while_spoken() {
    let mut bench = Bench::new();
    bench.open("say", "SayInput", &[]);
    bench.open("hello", "SayParameter", &[("text", "Hello, Aiko")]);
    bench.open("print", "Print", &[]);
    for _ in 0..5 {
        bench.tell("hello", true);
        bench.tell("say", Value::Int(6));
    }
    bench.wait(100);
    assert_eq!(bench.nao.scene().body.saying, "Hello, Aiko");
    bench.wait(3_000);
    let said: Vec<_> = bench.nao.spoken().iter().map(|spoken| spoken.text.as_str()).collect();
    assert_eq!(said, ["Hello, Aiko", "6"]);
    let hello = &bench.nao.spoken()[0];
    assert_eq!(hello.until.expect("it ended").0 - hello.from.0, 770, "two words and a comma, at the next step");
    for count in 0..30_i64 {
        bench.tell("print", count);
    }
    let printed = bench.nao.scene().body.printed;
    assert_eq!((printed.len(), printed[0].text.as_str(), printed[19].text.as_str()), (20, "10", "29"));
}
