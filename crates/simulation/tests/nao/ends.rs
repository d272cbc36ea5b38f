//! Tests of what ends with a use of the robot, and what goes on.

use super::bench::{Bench, user};
use robot::Robot;

fn said(bench: &Bench) -> Vec<(String, bool)> {
    bench.nao.spoken().iter().map(|spoken| (spoken.text.clone(), spoken.cut)).collect()
}

#[test]
fn who_ends_is_silent_and_the_others_speak_on() {
    let mut bench = Bench::new();
    bench.open("mine", "SayInput", &[]);
    bench.open("yours", "SayInput", &[]);
    for text in ["one two three four", "five six seven eight"] {
        bench.tell("mine", text);
        bench.tell("yours", format!("{text} please").as_str());
    }
    bench.wait(100);
    bench.nao.close(&user("mine"));
    bench.wait(10_000);
    let texts =
        [("one two three four", true), ("one two three four please", false), ("five six seven eight please", false)];
    assert_eq!(said(&bench), texts.map(|(text, cut)| (text.to_owned(), cut)));
}

#[test]
fn what_two_want_is_said_until_both_have_ended() {
    let mut bench = Bench::new();
    for stream in ["mine", "yours"] {
        bench.open(stream, "SayParameter", &[("text", "one two three four five")]);
        bench.tell(stream, true);
    }
    bench.wait(100);
    bench.nao.close(&user("mine"));
    bench.wait(100);
    assert_eq!(bench.nao.scene().body.saying, "one two three four five");
    bench.nao.close(&user("yours"));
    assert_eq!(said(&bench), [("one two three four five".to_owned(), true)]);
}

#[test]
fn joints_of_who_ends_hold_and_those_of_others_move_on() {
    let mut bench = Bench::new();
    bench.open("head", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.open("arm", "SetJointPosition", &[("joint", "LShoulderPitch")]);
    bench.tell("head", 1.5);
    bench.tell("arm", -1.0);
    bench.wait(200);
    let (head, arm) = (bench.joint("HeadYaw"), bench.joint("LShoulderPitch"));
    assert!(head > 0.05 && arm > 0.0, "both are on their way");
    bench.nao.close(&user("head"));
    bench.wait(3_000);
    assert!((bench.joint("HeadYaw") - head).abs() < 1e-3, "{head} became {}", bench.joint("HeadYaw"));
    assert!((bench.joint("LShoulderPitch") + 1.0).abs() < 0.01);
}

#[test]
fn a_joint_that_somebody_else_took_over_is_not_held() {
    let mut bench = Bench::new();
    bench.open("first", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.open("second", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.tell("first", -1.0);
    bench.wait(100);
    bench.tell("second", 1.0);
    bench.wait(100);
    bench.nao.close(&user("first"));
    bench.wait(3_000);
    assert!((bench.joint("HeadYaw") - 1.0).abs() < 0.01);
}

#[test]
fn an_arm_that_points_holds_when_its_tracker_ends_and_another_tracker_stays() {
    let mut bench = Bench::new();
    bench.open("arm", "Tracker", &[("mode", "Arm"), ("effector", "LArm")]);
    bench.open("head", "Tracker", &[]);
    for _ in 0..10 {
        bench.tell("arm", true);
        bench.tell("head", true);
        bench.wait(100);
    }
    let arm = bench.joint("LShoulderPitch");
    bench.nao.close(&user("arm"));
    bench.keep("head", true, 2_000);
    assert!((bench.joint("LShoulderPitch") - arm).abs() < 1e-3, "it holds, and does not go back");
    assert_eq!(bench.nao.scene().body.tracking, "red ball with head");
}

#[test]
fn a_head_follows_on_when_an_arm_that_points_ends() {
    let moved = [0.6, 0.0, 0.45];
    let follows_on = |with_arm: bool| {
        let mut bench = Bench::new();
        bench.open("head", "Tracker", &[]);
        if with_arm {
            bench.open("arm", "Tracker", &[("mode", "Arm"), ("effector", "LArm")]);
        }
        for _ in 0..10 {
            if with_arm {
                bench.tell("arm", true);
            }
            bench.tell("head", true);
            bench.wait(100);
        }
        if with_arm {
            bench.nao.close(&user("arm"));
        }
        bench.ball("red", moved);
        bench.keep("head", true, 3_000);
        let yaw = bench.joint("HeadYaw");
        (yaw - bench.bearing(moved)).abs()
    };
    assert!(follows_on(false) < 0.02, "alone");
    assert!(follows_on(true) < 0.02, "after an arm");
}
