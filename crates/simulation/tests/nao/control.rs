//! Tests of who has the robot, how it is, and what it does not do while it rests.

use crate::bench::Bench;
use robot::{Condition, Control, Life, Millis, Robot, RobotFault, SceneEdit};

fn control(bench: &mut Bench, control: Control) -> Result<(), RobotFault> {
    bench.nao.control(control, Millis(bench.now))
}

#[test]
fn at_first_it_is_awake_and_well() {
    let bench = Bench::new();
    let condition = Condition {
        battery: Some(100),
        plugged: Some(false),
        awake: Some(true),
        stiff: Some(true),
        life: Some(Life::Disabled),
        hot: Vec::new(),
        fallen: Some(false),
        legs: None,
        network: None,
        faces: Some(0),
    };
    assert_eq!(bench.nao.condition(), condition);
}

#[test]
fn it_rests_crouching_and_moves_again_when_control_is_taken() {
    let mut bench = Bench::new();
    bench.open("yaw", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.open("print", "Print", &[]);
    control(&mut bench, Control::Rest).expect("it can");
    bench.wait(5_000);
    let condition = bench.nao.condition();
    assert_eq!((condition.awake, condition.stiff), (Some(false), Some(false)));
    assert_eq!(bench.nao.scene().body.posture, "Crouching");
    let refused = bench.try_tell("yaw", 0.5).expect_err("it rests");
    assert_eq!(refused.to_string(), "the robot cannot do this now: it rests; take control first");
    bench.tell("print", "still here");
    control(&mut bench, Control::Take).expect("it can");
    bench.wait(5_000);
    let condition = bench.nao.condition();
    assert_eq!((condition.awake, condition.stiff, condition.life), (Some(true), Some(true), Some(Life::Disabled)));
    assert_eq!(bench.nao.scene().body.posture, "Standing");
    bench.tell("yaw", 0.5);
    bench.wait(1_000);
    assert!((bench.joint("HeadYaw") - 0.5).abs() < 0.01);
    control(&mut bench, Control::GiveBack).expect("it can");
    assert_eq!(bench.nao.condition().life, Some(Life::Disabled));
}

#[test]
fn a_stop_on_the_way_to_rest_holds_it_awake() {
    let mut bench = Bench::new();
    control(&mut bench, Control::Rest).expect("it can");
    bench.wait(300);
    bench.nao.stop(Millis(bench.now));
    bench.wait(5_000);
    assert_eq!((bench.nao.condition().awake, bench.nao.condition().stiff), (Some(true), Some(true)));
}

#[test]
fn nobody_takes_control_of_a_robot_on_the_floor() {
    let mut bench = Bench::new();
    bench.edit(&SceneEdit::Push);
    bench.wait(1_000);
    for wish in [Control::Take, Control::Rest] {
        let refused = control(&mut bench, wish).expect_err("it lies");
        assert_eq!(refused.to_string(), "the robot cannot do this now: it lies on the floor; help it up first");
    }
    bench.edit(&SceneEdit::Reset);
    bench.wait(100);
    assert_eq!((control(&mut bench, Control::Take), bench.nao.take_halt()), (Ok(()), None));
}

#[test]
fn it_stands_and_sits_when_asked_and_wakes_up_first() {
    let mut bench = Bench::new();
    control(&mut bench, Control::Sit).expect("it can");
    bench.wait(6_000);
    assert_eq!(bench.nao.scene().body.posture, "Sitting");
    assert_eq!(bench.nao.condition().stiff, Some(true));
    control(&mut bench, Control::Stand).expect("it can");
    bench.wait(500);
    bench.nao.stop(Millis(bench.now));
    bench.wait(6_000);
    assert_eq!(bench.nao.scene().body.posture, "Unknown", "Stop holds it on its way");
    control(&mut bench, Control::Rest).expect("it can");
    bench.wait(6_000);
    let refused = control(&mut bench, Control::Stand).expect_err("it rests");
    assert_eq!(refused.to_string(), "the robot cannot do this now: it rests; take control first");
    control(&mut bench, Control::WakeUp).expect("it can");
    bench.wait(6_000);
    assert_eq!((bench.nao.condition().awake, bench.nao.scene().body.posture.as_str()), (Some(true), "Standing"));
}

#[test]
fn faces_are_forgotten_and_counted() {
    let mut bench = Bench::new();
    bench.open("learn", "RememberFace", &[]);
    bench.person([1.6, 0.0], true);
    bench.wait(50);
    bench.tell("learn", true);
    assert_eq!(bench.nao.condition().faces, Some(1));
    assert_eq!(*bench.nao.faces(), ["face 1".to_owned()]);
    let nobody = control(&mut bench, Control::ForgetFace("face 2".to_owned())).expect_err("it never saw them");
    assert_eq!(nobody.to_string(), "the robot cannot do this now: it remembers nobody of that name");
    control(&mut bench, Control::ForgetFace("face 1".to_owned())).expect("it can");
    assert_eq!((bench.nao.condition().faces, bench.nao.faces().len()), (Some(0), 0));
    bench.tell("learn", true);
    assert_eq!(bench.nao.condition().faces, Some(1), "it can learn it again");
    control(&mut bench, Control::ForgetFaces).expect("it can");
    assert_eq!(bench.nao.condition().faces, Some(0));
    assert!(!bench.nao.scene().people[0].known);
}
