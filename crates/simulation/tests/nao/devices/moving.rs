//! Tests of how the robot moves.

use crate::bench::{Bench, user};
use behaviour::Value;
use robot::{Millis, Robot};

pub(super) fn joint_position() {
    let mut bench = Bench::new();
    bench.open("yaw", "JointPosition", &[("joint", "HeadYaw")]);
    bench.open("other", "JointPosition", &[("joint", "LHand")]);
    bench.open("set", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.tell("set", 0.7);
    bench.wait(2_000);
    let read = bench.values("yaw");
    assert_eq!(read.len(), 40);
    assert!((read[39].as_number().expect("an angle") - 0.7).abs() < 0.01);
    assert!(bench.values("other").iter().all(|value| (value.as_number().expect("a part") - 0.25).abs() < 1e-3));
}

pub(super) fn tracker() {
    let mut bench = Bench::new();
    bench.open("tracker", "Tracker", &[("mode", "Head")]);
    bench.ball("red", [0.8, 0.3, 0.4]);
    bench.keep("tracker", true, 2_000);
    assert!((bench.joint("HeadYaw") - bench.bearing([0.8, 0.3, 0.4])).abs() < 0.02);
    bench.wait(2_000);
    bench.ball("red", [0.8, 0.1, 0.4]);
    bench.wait(1_000);
    assert!((bench.joint("HeadYaw") - bench.bearing([0.8, 0.3, 0.4])).abs() < 0.02, "without values it stays");
}

pub(super) fn set_joint_position() {
    let mut bench = Bench::new();
    bench.open("head", "SetJointPosition", &[("joint", "Head")]);
    bench.open("arm", "SetJointPosition", &[("joint", "LArm")]);
    let list = |angles: &[f64]| Value::list(angles.iter().map(|angle| Value::Float(*angle)));
    bench.tell("head", list(&[0.4, -0.2]));
    bench.tell("arm", list(&[0.5, 0.3, -0.6, -0.8, 0.2, 1.0]));
    bench.wait(3_000);
    for (joint, angle) in [
        ("HeadYaw", 0.4),
        ("HeadPitch", -0.2),
        ("LShoulderPitch", 0.5),
        ("LShoulderRoll", 0.3),
        ("LElbowYaw", -0.6),
        ("LElbowRoll", -0.8),
        ("LWristYaw", 0.2),
        ("LHand", 1.0),
        ("RShoulderPitch", 1.4),
    ] {
        assert!((bench.joint(joint) - angle).abs() < 0.01, "{joint}: {}", bench.joint(joint));
    }
    for wrong in [list(&[0.1]), list(&[0.1, 0.2, 0.3]), Value::Float(0.1), Value::list([0.1.into(), "far".into()])] {
        let refused = bench.try_tell("head", wrong).expect_err("no two numbers");
        assert_eq!(refused.to_string(), "this group needs a list of 2 numbers");
    }
    bench.wait(500);
    assert!((bench.joint("HeadYaw") - 0.4).abs() < 0.01, "what is refused moves nothing");
}

pub(super) fn behavior() {
    let mut bench = Bench::new();
    bench.open("named", "Behavior", &[("name", "simulated/welcome")]);
    bench.open("told", "Behavior", &[]);
    bench.tell("named", true);
    bench.wait(350);
    assert_eq!(bench.nao.scene().body.playing, "simulated/welcome");
    bench.tell("told", "simulated/dance");
    bench.wait(350);
    assert_eq!(bench.nao.scene().body.playing, "simulated/dance", "it takes the place of the other");
    bench.nao.close(&user("named"));
    assert_eq!(bench.nao.scene().body.playing, "simulated/dance");
    bench.nao.close(&user("told"));
    assert_eq!(bench.nao.scene().body.playing, "", "it ends with its program");
    bench.tell_refused("told", "simulated/chess", "no action is open for this stream");
    bench.open("told", "Behavior", &[]);
    let missing = "the behaviour “simulated/chess” is not installed on this robot; choose one from its list";
    bench.tell_refused("told", "simulated/chess", missing);
    bench.tell_refused("told", true, "choose a behaviour for it, or let the value name one");
    let chess = [("name".to_owned(), Value::text("simulated/chess"))].into();
    let refused = bench.nao.open(&user("chess"), "Behavior", &chess).expect_err("it is known before Start");
    assert_eq!(refused.to_string(), missing);
    bench.tell("told", "simulated/story");
    bench.nao.stop(Millis(bench.now));
    assert_eq!(bench.nao.scene().body.playing, "");
}

pub(super) fn animation() {
    let mut bench = Bench::new();
    let own = [("animation", "robot"), ("gesture", "animations/Stand/Gestures/Yes_1")];
    bench.open("own", "Animation", &own);
    bench.tell("own", true);
    assert_eq!(bench.nao.scene().body.playing, "nodding", "one of the list");
    assert!(bench.nao.installed().gestures.iter().any(|known| known == own[1].1));
    let other = own.map(|(name, value)| (name.to_owned(), Value::text(value.replace("Yes_1", "Fly_1"))));
    assert!(bench.nao.open(&user("other"), "Animation", &other.into()).is_err());

    for (name, moved, words) in [
        ("Hey", "RShoulderPitch", "waving"),
        ("Yes", "HeadPitch", "nodding"),
        ("Happy", "LShoulderPitch", "cheering"),
        ("Dance", "LShoulderPitch", "dancing"),
        ("Clap", "RShoulderPitch", "clapping"),
        ("Surprised", "HeadPitch", "acting surprised"),
        ("HighFive", "RShoulderPitch", "giving a high five"),
        ("HeyLeft", "LShoulderPitch", "waving the left hand"),
    ] {
        let mut bench = Bench::new();
        bench.open("play", "Animation", &[("animation", name)]);
        bench.wait(500);
        let before = bench.nao.scene().body;
        assert_eq!(before.playing, "");
        bench.tell("play", true);
        bench.wait(350);
        assert!((bench.joint(moved) - before.joints[motor(moved)]).abs() > 0.1, "{name} moves {moved}");
        assert_eq!(bench.nao.scene().body.playing, words);
        bench.tell("play", true);
        bench.wait(4_000);
        let after = bench.nao.scene().body;
        assert_eq!(after.playing, "", "it was not begun again");
        let far =
            |joints: &[f32]| joints.iter().zip(&before.joints).fold(0.0, |far, (a, b)| f32::max(far, (a - b).abs()));
        assert!(far(&after.joints) < 0.01, "{name} ends where it began");
    }
    let mut bench = Bench::new();
    bench.open("play", "Animation", &[("animation", "Hey")]);
    bench.open("arm", "SetJointPosition", &[("joint", "RElbowRoll")]);
    bench.tell("play", true);
    bench.wait(800);
    bench.tell("arm", 0.2);
    bench.wait(1_000);
    assert!((bench.joint("RElbowRoll") - 0.2).abs() < 0.02, "who moves a joint later has it");
    assert!(bench.joint("RShoulderPitch") < 0.0, "and the others wave on");
    bench.nao.stop(Millis(bench.now));
    let held = bench.nao.scene().body;
    bench.wait(1_000);
    assert_eq!((bench.nao.scene().body.joints, held.playing.as_str()), (held.joints, ""));
}

fn motor(joint: &str) -> usize {
    robot::JOINTS.iter().position(|one| *one == joint).expect("a joint of the robot")
}

fn velocity(x: f64, y: f64, turn: f64) -> Value {
    Value::object([("x", x.into()), ("y", y.into()), ("turn", turn.into())])
}

pub(super) fn walk() {
    let mut bench = Bench::new();
    bench.open("walk", "Walk", &[]);
    bench.keep("walk", 9.0, 4_000);
    let [x, y, turn] = bench.nao.scene().body.base;
    assert!((0.17..0.2).contains(&x) && y == 0.0 && turn == 0.0, "at most its top speed, 0.05 m/s: {x}");
    bench.wait(1_000);
    let stopped = bench.nao.scene().body.base;
    assert!(stopped[0] < x + 0.05);
    bench.wait(1_000);
    assert_eq!(bench.nao.scene().body.base, stopped, "half a second after the last value it stops");
    bench.keep("walk", velocity(0.0, -0.05, 0.2), 2_000);
    let [_, aside, turned] = bench.nao.scene().body.base;
    assert!(aside < -0.05 && turned > 0.3, "{aside} {turned}");
    bench.nao.stop(Millis(bench.now));
    let held = bench.nao.scene().body.base;
    bench.wait(1_000);
    assert_eq!(bench.nao.scene().body.base, held);
    assert!(bench.try_tell("walk", "fast").is_err() && bench.try_tell("walk", Value::object([])).is_err());

    let mut bench = Bench::new();
    bench.open("walk", "Walk", &[]);
    bench.open("go", "Posture", &[("posture", "Sit")]);
    bench.tell("go", true);
    bench.wait(5_000);
    let refused = bench.try_tell("walk", 0.05).expect_err("it sits");
    assert_eq!(refused.to_string(), "the robot cannot do this now: it sits; let it stand up first");
    bench.open("go", "Posture", &[("posture", "Crouch")]);
    bench.tell("go", true);
    bench.wait(5_000);
    bench.keep("walk", 0.05, 200);
    assert_eq!(bench.nao.scene().body.base[0].to_bits(), 0, "first it stands up");
    bench.nao.close(&user("walk"));
    bench.wait(1_000);
    assert_ne!(bench.nao.scene().body.posture, "Standing", "whoever ends does not stand up either");
    bench.open("walk", "Walk", &[]);
    bench.keep("walk", 0.05, 4_000);
    let body = bench.nao.scene().body;
    assert!(body.base[0] > 0.05 && body.posture == "Standing", "{body:?}");

    let mut bench = Bench::new();
    bench.open("walk", "Walk", &[]);
    bench.person([0.9, 0.0], true);
    bench.keep("walk", 0.05, 20_000);
    let x = bench.nao.scene().body.base[0];
    assert!((0.3..0.5).contains(&x), "a person stops it: {x}");
}
