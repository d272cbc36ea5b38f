//! Tests of how the robot is: its posture, falling, its battery, its time.

use crate::bench::Bench;
use behaviour::Value;
use robot::{Control, Health, Millis, Robot, SceneEdit};

fn texts(values: Vec<Value>) -> Vec<String> {
    values.iter().filter_map(Value::as_text).map(str::to_owned).collect()
}

pub(super) fn posture_changed() {
    let mut bench = Bench::new();
    bench.open("posture", "PostureChanged", &[]);
    bench.wait(3_000);
    assert_eq!(texts(bench.values("posture")), ["Standing"], "at first, and then not again");
    for (name, family) in [("Crouch", "Crouching"), ("Sit", "Sitting"), ("StandInit", "Standing")] {
        bench.open("go", "Posture", &[("posture", name)]);
        bench.tell("go", true);
        bench.wait(5_000);
        assert_eq!(texts(bench.values("posture")).last().map(String::as_str), Some(family));
        assert_eq!(bench.nao.scene().body.posture, family);
    }
    bench.edit(&SceneEdit::Push);
    bench.wait(1_000);
    assert_eq!(texts(bench.values("posture")), ["Unknown", "LyingBelly"]);
}

pub(super) fn posture() {
    let mut bench = Bench::new();
    let high = bench.nao.scene().body.torso[0];
    let mut heights = Vec::new();
    for name in ["Crouch", "Sit", "Stand"] {
        bench.open("go", "Posture", &[("posture", name)]);
        bench.tell("go", true);
        bench.wait(150);
        bench.tell("go", true);
        bench.wait(5_000);
        heights.push(bench.nao.scene().body.torso[0]);
    }
    assert!(heights[0] < high - 0.05 && heights[1] < heights[0] && heights[2] > high, "{high} {heights:?}");
    assert!((bench.joint("LShoulderPitch") - 1.443).abs() < 0.01);
    bench.open("go", "Posture", &[("posture", "Crouch")]);
    bench.tell("go", true);
    bench.wait(400);
    bench.nao.stop(Millis(bench.now));
    let held = bench.nao.scene().body.joints;
    bench.wait(3_000);
    assert_eq!(bench.nao.scene().body.joints, held, "on its way it holds");
    bench.edit(&SceneEdit::Push);
    bench.wait(1_000);
    let refused = bench.try_tell("go", true).expect_err("it lies");
    assert_eq!(refused.to_string(), "the robot cannot do this now: it lies on the floor; help it up first");
}

pub(super) fn fall() {
    let mut bench = Bench::new();
    bench.open("fall", "Fall", &[]);
    bench.open("both", "Fall", &[("release", "yes")]);
    bench.open("walk", "Walk", &[]);
    bench.open("say", "SayInput", &[]);
    bench.keep("walk", 0.05, 1_000);
    bench.tell("say", "one two three four five six");
    bench.wait(50);
    assert!(bench.values("fall").is_empty() && bench.nao.take_halt().is_none());
    bench.edit(&SceneEdit::Push);
    bench.wait(1_000);
    assert_eq!((bench.values("fall"), bench.values("both")), (vec![Value::Bool(true)], vec![Value::Bool(true)]));
    assert_eq!((bench.nao.take_halt(), bench.nao.take_halt()), (Some("it fell".into()), None));
    let (body, condition) = (bench.nao.scene().body, bench.nao.condition());
    assert!(body.fallen && body.torso[0] < 0.15 && body.saying.is_empty() && body.torso[1] > 1.5, "{body:?}");
    assert_eq!((condition.fallen, condition.stiff, bench.nao.health()), (Some(true), Some(false), Health::Safe));
    assert!(bench.try_tell("walk", 0.05).is_err() && bench.nao.control(Control::Take, Millis(bench.now)).is_err());
    assert_eq!(bench.nao.scene().body.base, body.base, "nothing walks any more");
    bench.edit(&SceneEdit::HelpUp);
    bench.wait(3_000);
    assert_eq!((bench.values("fall"), bench.values("both")), (vec![], vec![Value::Bool(false)]));
    let again = bench.nao.scene().body;
    assert!(!again.fallen && again.torso[0] > 0.3 && again.base == body.base, "it stands and does not go on");
    bench.keep("walk", 0.05, 1_000);
    assert!(bench.nao.scene().body.base[0] > again.base[0]);
}

pub(super) fn battery() {
    let mut bench = Bench::new();
    bench.open("battery", "Battery", &[]);
    bench.wait(1_000);
    assert_eq!(bench.values("battery"), [Value::Int(100)]);
    for _ in 0..12 {
        bench.wait(10_000);
    }
    assert_eq!(bench.values("battery"), [] as [Value; 0], "at rest less than one in two minutes");
    bench.edit(&SceneEdit::SetBattery { percent: 40 });
    bench.wait(100);
    bench.edit(&SceneEdit::Plug { plugged: true });
    for _ in 0..6 {
        bench.wait(10_000);
    }
    assert_eq!(bench.values("battery"), [Value::Int(40), Value::Int(41), Value::Int(42)]);
    let condition = bench.nao.condition();
    assert_eq!((condition.battery, condition.plugged), (Some(42), Some(true)));
    bench.edit(&SceneEdit::Plug { plugged: false });
    bench.edit(&SceneEdit::SetBattery { percent: 0 });
    bench.wait(100);
    assert_eq!(bench.values("battery"), [Value::Int(0)]);
    assert_eq!(bench.nao.take_halt(), Some("its battery is empty".into()));
    bench.open("yaw", "SetJointPosition", &[]);
    assert!(bench.try_tell("yaw", 0.3).is_err());
    bench.edit(&SceneEdit::Plug { plugged: true });
    bench.wait(100);
    assert_eq!((bench.try_tell("yaw", 0.3), bench.nao.take_halt()), (Ok(()), None));
    let refused = bench.nao.edit(&SceneEdit::SetBattery { percent: 101 }).expect_err("too full");
    assert_eq!(refused.to_string(), "a battery holds 0 to 100 percent, not 101");
}

pub(super) fn tick() {
    let mut bench = Bench::new();
    bench.open_with("tick", "Tick", &[("period_ms", Value::Float(250.0))]);
    bench.wait(240);
    assert!(bench.values("tick").is_empty());
    bench.wait(760);
    assert_eq!(bench.values("tick"), [1, 2, 3, 4].map(Value::Int));
}

pub(super) fn time_of_day() {
    let mut bench = Bench::new();
    bench.open("time", "TimeOfDay", &[]);
    let at = |minutes| robot::time_of_day(minutes);
    let wait = |bench: &mut Bench, tens: u32| (0..tens).for_each(|_| bench.wait(10_000));
    wait(&mut bench, 5);
    assert_eq!(bench.values("time"), [at(8 * 60)], "told at first");
    wait(&mut bench, 2);
    assert_eq!(bench.values("time"), [at(8 * 60 + 1)], "and at every new minute");
    bench.edit(&SceneEdit::PassTime { minutes: 59 });
    bench.wait(100);
    assert_eq!(bench.values("time"), [at(9 * 60)]);
    bench.edit(&SceneEdit::PassTime { minutes: 15 * 60 });
    bench.wait(100);
    assert_eq!(bench.values("time"), [at(0)], "midnight begins a day");
    bench.edit(&SceneEdit::Reset);
    bench.wait(100);
    assert_eq!(bench.values("time"), [at(8 * 60 + 1)], "robot time goes on");
}
