//! The room keeps its bounds, whatever happens in it; and the same story gives the same bits.

use super::bench::Bench;
use behaviour::Value;
use robot::{JOINTS, Millis, Robot, SceneEdit, Touchable};
use simulation::SimulatedNao;

#[test]
fn at_first_only_the_red_ball_is_seen_and_nobody_is_there() {
    let scene = Bench::new().nao.scene();
    let seen: Vec<_> = scene.balls.iter().map(|ball| (ball.id.as_str(), ball.seen)).collect();
    assert_eq!(seen, [("red", true), ("green", false), ("blue", false)]);
    assert!(!scene.people[0].present);
    assert_eq!((scene.body.joints.len(), scene.body.base), (JOINTS.len(), [0.0; 3]));
}

#[test]
fn green_and_blue_stay_out_of_view_while_the_head_looks_at_the_red_ball() {
    let mut bench = Bench::new();
    bench.open("tracker", "Tracker", &[]);
    bench.keep("tracker", true, 1_000);
    let scene = bench.nao.scene();
    assert!(scene.balls[0].seen && !scene.balls[1].seen && !scene.balls[2].seen);
}

#[test]
fn balls_stay_where_they_are_put_inside_the_room_and_outside_the_robot() {
    let mut bench = Bench::new();
    bench.ball("red", [0.7, -0.1, 0.8]);
    bench.wait(5_000);
    assert_eq!(bench.nao.scene().balls[0].at, [0.7, -0.1, 0.8]);
    bench.ball("red", [9.0, -9.0, 9.0]);
    bench.wait(20);
    assert_eq!(bench.nao.scene().balls[0].at, [2.0, -2.0, 1.5]);
    bench.ball("red", [0.0, 0.0, 0.3]);
    bench.wait(20);
    assert_eq!(bench.nao.scene().balls[0].at, [0.16, 0.0, 0.3]);
    let missing = SceneEdit::MoveBall { id: "pink".to_owned(), at: [0.0; 3] };
    let refused = bench.nao.edit(&missing).expect_err("there is no such ball");
    assert_eq!(refused.to_string(), "there is no ball called “pink”");
}

#[test]
fn a_ball_let_go_falls_and_lies_on_the_floor_until_somebody_lifts_it() {
    let mut bench = Bench::new();
    bench.nao.throw_ball("red", [0.0; 3]).expect("there is a red ball");
    bench.wait(6_000);
    let at = bench.nao.scene().balls[0].at;
    assert!((at[2] - 0.03).abs() < 0.01, "{at:?}");
    bench.ball("red", [0.6, 0.0, 0.45]);
    bench.wait(1_000);
    assert_eq!(bench.nao.scene().balls[0].at, [0.6, 0.0, 0.45]);
}

#[test]
fn a_rolling_ball_bounces_off_the_robot() {
    let mut bench = Bench::new();
    bench.ball("red", [0.6, 0.05, 0.03]);
    bench.nao.throw_ball("red", [-1.5, 0.0, 0.0]).expect("there is a red ball");
    bench.wait(3_000);
    assert!(bench.nao.scene().balls[0].at[0] > 0.05, "{:?}", bench.nao.scene().balls[0].at);
}

#[test]
fn reset_brings_everything_back() {
    let mut bench = Bench::new();
    bench.open("tracker", "Tracker", &[("mode", "Move")]);
    let first = bench.nao.scene();
    bench.ball("red", [1.5, 0.4, 0.5]);
    bench.person([1.0, 1.0], true);
    bench.touch(Touchable::HeadRear, true);
    bench.keep("tracker", true, 4_000);
    bench.nao.edit(&SceneEdit::Reset).expect("always possible");
    bench.wait(10);
    let again = bench.nao.scene();
    assert_eq!((first.body, first.balls, first.people), (again.body, again.balls, again.people));
}

fn assert_sound(bench: &Bench) {
    let scene = bench.nao.scene();
    let body = &scene.body;
    let numbers = body.joints.iter().chain(&body.base).chain(&body.gaze).chain(body.hands.iter().flatten());
    assert!(numbers.chain(scene.balls.iter().flat_map(|ball| &ball.at)).all(|number| number.is_finite()));
    assert!(body.joints[0].abs() <= 2.0857 && (-0.672..=0.5150).contains(&body.joints[1]), "{:?}", body.joints);
    assert!(body.base[..2].iter().all(|place| place.abs() <= 1.81));
    assert!(scene.balls.iter().all(|ball| ball.at.iter().all(|place| place.abs() < 10.0)));
}

#[test]
fn torture_neither_panics_nor_breaks_a_limit() {
    let mut bench = Bench::new();
    bench.open("move", "Tracker", &[("mode", "Move"), ("effector", "Nearest")]);
    bench.open("yaw", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.open("pitch", "SetJointPosition", &[("joint", "HeadPitch")]);
    bench.open("red", "RedBall", &[]);
    bench.open("face", "FaceDetection", &[]);
    let wild = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e30, -1e30, f64::MAX, 0.0, -0.0, 5e-324];
    for (round, value) in wild.into_iter().cycle().take(90).enumerate() {
        let narrow = value as f32;
        let _ = bench.try_tell("yaw", value);
        let _ = bench.try_tell("pitch", -value);
        let _ = bench.try_tell("move", value);
        let _ = bench.nao.edit(&SceneEdit::MoveBall { id: "red".to_owned(), at: [narrow, narrow, narrow] });
        let _ = bench.nao.edit(&SceneEdit::MovePerson { id: "person".to_owned(), at: [narrow, 0.0] });
        let _ = bench.nao.edit(&SceneEdit::SetPresent { id: "person".to_owned(), present: round % 2 == 0 });
        let _ = bench.nao.throw_ball("blue", [narrow, 1.0, -300.0]);
        let _ = bench.nao.throw_ball("green", [300.0, -300.0, 300.0]);
        bench.wait(70);
        assert_sound(&bench);
    }
}

#[test]
fn no_device_and_no_edit_breaks_on_wild_values() {
    let mut bench = Bench::new();
    // A NAO has no tablet.
    let actions: Vec<_> = robot::actuators().map(|device| device.name).filter(|name| *name != "Tablet").collect();
    for device in robot::sensors().chain(robot::actuators()).filter(|device| device.name != "Tablet") {
        bench.open(&device.name.to_lowercase(), device.name, &[]);
    }
    bench.open("head", "SetJointPosition", &[("joint", "Head")]);
    for (round, value) in
        [f64::NAN, f64::INFINITY, -1e30, f64::MAX, 0.0, 5e-324].into_iter().cycle().take(60).enumerate()
    {
        let (narrow, id) = (value as f32, "mark64".to_owned());
        for action in &actions {
            let velocity = Value::object([("x", value.into()), ("y", (-value).into()), ("turn", value.into())]);
            let _ = bench.try_tell(&action.to_lowercase(), velocity);
            let _ = bench.try_tell(&action.to_lowercase(), value);
        }
        let _ = bench.try_tell("head", Value::list([value.into(), value.into()]));
        for edit in [
            SceneEdit::MoveObstacle { id: "box".to_owned(), at: [narrow, -narrow] },
            SceneEdit::MoveLandmark { id: id.clone(), at: [narrow; 3], facing: narrow },
            SceneEdit::SetPresent { id: "box".to_owned(), present: round % 2 == 0 },
            SceneEdit::SetPresent { id, present: round % 3 == 0 },
            SceneEdit::Noise { at: [narrow; 3] },
            SceneEdit::SetBattery { percent: round as u8 * 4 },
            SceneEdit::Plug { plugged: round % 5 == 0 },
            if round % 7 == 0 { SceneEdit::Push } else { SceneEdit::HelpUp },
        ] {
            let _ = bench.nao.edit(&edit);
        }
        (0..40).for_each(|touch| bench.touch(Touchable::BumperLeft, touch % 3 == 0));
        (0..40).for_each(|_| drop(bench.nao.edit(&SceneEdit::Speak { words: "yes".to_owned() })));
        bench.wait(70);
        assert_sound(&bench);
    }
    assert!(bench.readings.iter().all(|reading| reading.value.is_finite()));
}

#[test]
fn thrown_at_the_robot_with_300_metres_a_second() {
    let mut bench = Bench::new();
    for from in [[1.0, 0.0, 0.45], [0.0, 1.0, 0.3], [0.5, 0.5, 0.5], [0.2, 0.0, 0.3]] {
        bench.ball("red", from);
        let at = from.map(|place| -300.0 * place);
        bench.nao.throw_ball("red", [at[0], at[1], 0.0]).expect("there is a red ball");
        bench.wait(500);
        assert_sound(&bench);
    }
}

/// A busy story, with every device open; every call is a pure function of the beat.
fn story(seed: u64) -> (u64, usize) {
    let mut bench = Bench::new();
    bench.nao = SimulatedNao::new(seed);
    for device in robot::sensors() {
        bench.open(&device.name.to_lowercase(), device.name, &[]);
    }
    bench.open("move", "Tracker", &[("mode", "Move"), ("effector", "Nearest")]);
    bench.open("say", "SayInput", &[]);
    for action in ["Animation", "Posture", "Walk", "Sound"] {
        bench.open(&action.to_lowercase(), action, &[]);
    }
    for id in ["person", "friend", "mark64"] {
        bench.present(id, true);
    }
    bench.obstacle("box", [1.4, -0.5]);
    for beat in 0..200 {
        let aside = 0.5 * libm::sinf(beat as f32 * 0.07);
        bench.ball("red", [1.2, aside, 0.45]);
        happen(&mut bench, beat);
        bench.wait(33);
    }
    (bench.nao.state_hash(), bench.readings.len())
}

fn happen(bench: &mut Bench, beat: u64) {
    match beat {
        10 | 11 => bench.touch(Touchable::HandLeftBack, beat == 10),
        20 => bench.speak("yes please"),
        25 => bench.edit(&SceneEdit::Noise { at: [0.5, 1.0, 0.3] }),
        30 => bench.tell("animation", true),
        50 => bench.nao.throw_ball("green", [-2.0, -1.0, 1.0]).expect("there is a green ball"),
        60 => bench.tell("sound", true),
        70 => bench.edit(&SceneEdit::SetBattery { percent: 50 }),
        80..100 => bench.tell("walk", 0.05),
        100 => bench.tell("posture", true),
        160 => bench.edit(&SceneEdit::Push),
        180 => bench.edit(&SceneEdit::HelpUp),
        _ => {}
    }
    if !(80..=130).contains(&beat) {
        let _refused_on_the_floor = bench.try_tell("move", true);
    }
    if beat.is_multiple_of(20) {
        bench.tell("say", format!("beat {beat}").as_str());
    }
}

#[test]
fn the_same_story_gives_the_same_bits_and_another_seed_others() {
    assert_eq!(story(1), story(1));
    assert_ne!(story(1).0, story(2).0);
    assert!(story(1).1 > 100);
}

#[test]
fn the_size_of_the_calls_does_not_matter() {
    let (mut one, mut many) = (SimulatedNao::new(3), SimulatedNao::new(3));
    let mut readings = Vec::new();
    one.poll(Millis(5_000), &mut readings);
    (0..=5_000).step_by(7).for_each(|now| many.poll(Millis(now), &mut readings));
    many.poll(Millis(5_000), &mut readings);
    assert_eq!(one.state_hash(), many.state_hash());
}

#[test]
fn a_long_jump_of_time_is_computed_in_parts() {
    let mut nao = SimulatedNao::new(3);
    let mut readings = Vec::new();
    nao.poll(Millis(u64::MAX), &mut readings);
    assert_eq!(nao.time(), Millis(10_000));
    nao.poll(Millis(5), &mut readings);
    assert_eq!(nao.time(), Millis(10_000));
}

#[test]
fn a_robot_may_be_handed_to_its_thread() {
    fn handed<T: Send + 'static>() {}
    handed::<SimulatedNao>();
}

/// Ten minutes of following on the virtual clock; how long it takes is not a promise, that it stays sound is.
#[test]
fn ten_minutes_stay_sound() {
    let mut bench = Bench::new();
    bench.open("body", "Tracker", &[("mode", "WholeBody"), ("effector", "Nearest")]);
    for beat in 0..600 {
        let aside = beat as f32 * 0.02;
        bench.ball("red", [0.9 * libm::cosf(aside), 0.9 * libm::sinf(aside), 0.45]);
        bench.tell("body", true);
        bench.wait(1_000);
    }
    assert_sound(&bench);
    let scene = bench.nao.scene();
    assert!(scene.balls[0].seen, "it turned after the ball for nearly two rounds");
}
