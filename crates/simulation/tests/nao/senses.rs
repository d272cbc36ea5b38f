//! Senses give what geometry says, at their beat, and nothing when there is nothing.

use super::bench::{Bench, number};
use behaviour::Value;
use robot::{Millis, Robot, Touchable};

#[test]
fn the_red_ball_is_seen_thirty_times_a_second_where_it_is() {
    let mut bench = Bench::new();
    bench.wait(1_000);
    assert!(bench.readings.is_empty(), "nothing before it is opened");
    bench.open("ball", "RedBall", &[]);
    bench.wait(1_000);
    let seen = bench.read("ball");
    assert_eq!(seen.len(), 30);
    let (first, gaze) = (&seen[0], bench.nao.scene().body.gaze);
    assert_eq!((first.at, first.value.field("time")), (Millis(1_040), Some(&Value::Int(1_040))));
    let way = [0.60 - gaze[0], 0.15 - gaze[1], 0.45 - gaze[2]];
    let distance = libm::sqrtf(way.iter().map(|part| part * part).sum());
    assert!((number(&first.value, "x") - libm::atan2f(way[1], way[0])).abs() < 0.005);
    assert!(number(&first.value, "y") > 0.0, "it is below the camera");
    assert!((0.03 / libm::sinf(number(&first.value, "size")) - distance).abs() < 0.002);
}

#[test]
fn a_ball_outside_the_view_is_not_there() {
    let mut bench = Bench::new();
    bench.open("red", "RedBall", &[]);
    bench.ball("red", [0.3, 0.9, 0.45]);
    bench.wait(1_000);
    assert!(bench.read("red").is_empty());
    assert!(!bench.nao.scene().balls[0].seen);
}

#[test]
fn green_and_blue_are_out_of_view_until_somebody_moves_them_ahead() {
    let mut bench = Bench::new();
    for color in ["green", "blue"] {
        bench.open(color, "Blob", &[("color", color)]);
        bench.wait(500);
        assert!(bench.read(color).is_empty(), "{color}");
        bench.ball(color, [0.9, 0.0, 0.45]);
        bench.wait(500);
        assert_eq!(bench.read(color).len(), 15, "{color}");
        bench.ball(color, [-1.0, 0.0, 0.45]);
    }
}

#[test]
fn a_person_hides_the_ball() {
    let mut bench = Bench::new();
    bench.open("ball", "RedBall", &[]);
    bench.ball("red", [1.5, 0.0, 0.45]);
    bench.wait(100);
    assert_eq!(bench.read("ball").len(), 3);
    bench.person([1.0, 0.0], true);
    bench.wait(100);
    assert!(bench.read("ball").is_empty());
    bench.person([1.0, 0.6], true);
    bench.wait(100);
    assert_eq!(bench.read("ball").len(), 3);
}

#[test]
fn a_ball_in_front_hides_one_behind() {
    let mut bench = Bench::new();
    bench.open("ball", "RedBall", &[]);
    bench.ball("red", [1.2, 0.0, 0.47]);
    bench.ball("blue", [0.6, 0.0, 0.485]);
    bench.wait(100);
    assert!(bench.read("ball").is_empty());
}

#[test]
fn a_new_face_is_learned_once() {
    let mut bench = Bench::new();
    bench.open("face", "FaceDetection", &[]);
    bench.open("learn", "RememberFace", &[]);
    bench.wait(500);
    assert!(bench.read("face").is_empty());
    assert!(bench.try_tell("learn", true).is_err(), "nobody is there");
    bench.person([1.6, -0.2], true);
    bench.wait(500);
    let before = bench.read("face");
    assert_eq!(before.len(), 5);
    let field = |reading: &robot::Reading, name: &str| reading.value.field(name).cloned();
    assert_eq!(field(&before[0], "new"), Some(Value::Bool(true)));
    assert_eq!(field(&before[0], "recognized_new_face"), Some(Value::Bool(true)));
    assert!(number(&before[0].value, "y") < 0.0 && number(&before[0].value, "x") < 0.0);
    bench.tell("learn", true);
    bench.wait(500);
    let after = bench.read("face");
    assert_eq!(field(&after[0], "new"), Some(Value::Bool(false)));
    assert_eq!(field(&after[0], "recognized_new_face"), Some(Value::Bool(false)));
    assert_eq!(field(&after[0], "label"), Some(Value::text("face 1")));
    let person = &bench.nao.scene().people[0];
    assert!(person.known && person.seen && person.present);
}

#[test]
fn a_far_face_is_new_but_not_near_enough_to_learn() {
    let mut bench = Bench::new();
    bench.open("face", "FaceDetection", &[]);
    bench.person([2.0, 0.7], true);
    bench.wait(200);
    let seen = bench.read("face");
    assert_eq!(seen[0].value.field("new"), Some(&Value::Bool(true)));
    assert_eq!(seen[0].value.field("recognized_new_face"), Some(&Value::Bool(false)));
}

#[test]
fn a_touch_is_told_once_and_when_let_go_only_if_that_is_wanted() {
    let mut bench = Bench::new();
    bench.open("any", "HeadTouch", &[]);
    bench.open("rear", "HeadTouch", &[("part", "rear"), ("release", "yes")]);
    bench.wait(100);
    for down in [true, true, false] {
        bench.touch(Touchable::HeadRear, down);
    }
    bench.wait(100);
    let mut felt =
        |stream| bench.read(stream).into_iter().map(|reading| (reading.at.0, reading.value)).collect::<Vec<_>>();
    assert_eq!(felt("any"), [(110, Value::Bool(true))]);
    assert_eq!(felt("rear"), [(110, Value::Bool(true)), (120, Value::Bool(false))]);
}

#[test]
fn a_tick_counts_at_its_beat_and_a_joint_is_read_twenty_times_a_second() {
    let mut bench = Bench::new();
    bench
        .nao
        .open(
            &super::bench::user("tick"),
            "Tick",
            &[("period_ms".to_owned(), Value::Float(333.0))].into_iter().collect(),
        )
        .expect("it ticks");
    bench.open("joint", "JointPosition", &[("joint", "LShoulderPitch")]);
    bench.wait(1_000);
    let ticks: Vec<_> = bench.read("tick").into_iter().map(|reading| (reading.at.0, reading.value)).collect();
    assert_eq!(ticks, [(333, Value::Int(1)), (666, Value::Int(2)), (999, Value::Int(3))]);
    let angles = bench.read("joint");
    assert_eq!((angles.len(), angles[0].at), (20, Millis(50)));
    assert!((angles[0].value.as_number().expect("a number") - 1.4).abs() < 1e-3);
}

#[test]
fn readings_come_in_order_of_time() {
    let mut bench = Bench::new();
    bench.open("a", "RedBall", &[]);
    bench.open("b", "Tick", &[]);
    bench.open("c", "JointPosition", &[]);
    bench.wait(3_000);
    assert!(bench.readings.windows(2).all(|pair| (pair[0].at, &pair[0].to) < (pair[1].at, &pair[1].to)));
}

#[test]
fn what_the_robot_does_not_have_or_cannot_do_is_refused_with_a_sentence() {
    let mut bench = Bench::new();
    let fault = bench.nao.open(&super::bench::user("x"), "Wings", &Default::default()).expect_err("it has no wings");
    assert_eq!(fault.to_string(), "this robot has no device called “Wings”");
    let params = [("color".to_owned(), Value::text("pink"))].into_iter().collect();
    assert!(bench.nao.open(&super::bench::user("x"), "Blob", &params).is_err());
    bench.open("ball", "RedBall", &[]);
    assert!(bench.try_tell("ball", 1.0).is_err());
    assert!(bench.try_tell("nobody", 1.0).is_err());
}

#[test]
fn noise_is_seeded_and_drops_pictures() {
    let mut bench = Bench::new();
    bench.nao.set_noise(simulation::Noise { angle: 0.01, size: 0.05, drop: 0.5 });
    bench.open("ball", "RedBall", &[]);
    bench.wait(10_000);
    let seen = bench.read("ball");
    assert!((100..200).contains(&seen.len()), "{}", seen.len());
    assert_ne!(seen[0].value.field("x"), seen[1].value.field("x"));
}
