//! Tests of what the robot feels, and what is near.

use crate::bench::{Bench, user};
use behaviour::Value;
use robot::{Millis, Robot, SceneEdit, Touchable};

const TRUE: Value = Value::Bool(true);
const FALSE: Value = Value::Bool(false);

fn tap(bench: &mut Bench, part: Touchable) {
    for down in [true, false] {
        bench.touch(part, down);
        bench.wait(50);
    }
}

pub(super) fn head_touch() {
    let mut bench = Bench::new();
    bench.open("any", "HeadTouch", &[]);
    bench.open("front", "HeadTouch", &[("part", "front"), ("release", "yes")]);
    tap(&mut bench, Touchable::HeadRear);
    assert_eq!((bench.values("any"), bench.values("front")), (vec![TRUE], vec![]));
    tap(&mut bench, Touchable::HeadFront);
    assert_eq!((bench.values("any"), bench.values("front")), (vec![TRUE], vec![TRUE, FALSE]));
    tap(&mut bench, Touchable::HandLeftBack);
    assert_eq!((bench.values("any"), bench.values("front")), (vec![], vec![]));
    for part in [Touchable::HeadFront, Touchable::HeadMiddle] {
        bench.touch(part, true);
    }
    bench.wait(1_000);
    assert_eq!(bench.values("any"), [TRUE], "once, however long and wide the touch is");
    assert_eq!(bench.nao.scene().body.touched, [Touchable::HeadFront, Touchable::HeadMiddle]);
}

pub(super) fn hand_touch() {
    let mut bench = Bench::new();
    bench.open("any", "HandTouch", &[]);
    bench.open("left", "HandTouch", &[("hand", "left"), ("release", "yes")]);
    bench.open("backs", "HandTouch", &[("part", "back")]);
    tap(&mut bench, Touchable::HandLeftRight);
    tap(&mut bench, Touchable::HandRightBack);
    tap(&mut bench, Touchable::HeadRear);
    assert_eq!(bench.values("any"), [TRUE, TRUE]);
    assert_eq!(bench.values("left"), [TRUE, FALSE]);
    assert_eq!(bench.values("backs"), [TRUE]);
}

pub(super) fn bumper() {
    let mut bench = Bench::new();
    bench.open("any", "Bumper", &[("release", "yes")]);
    bench.open("right", "Bumper", &[("foot", "right")]);
    tap(&mut bench, Touchable::BumperLeft);
    assert_eq!((bench.values("any"), bench.values("right")), (vec![TRUE, FALSE], vec![]));
    bench.obstacle("box", [0.6, 0.0]);
    bench.open("walk", "Walk", &[]);
    bench.keep("walk", 0.05, 1_000);
    assert!(bench.values("any").is_empty(), "not there yet");
    bench.keep("walk", 0.05, 9_000);
    assert_eq!((bench.values("any"), bench.values("right")), (vec![TRUE], vec![TRUE]), "it met the box");
    let here = bench.nao.scene().body.base[0];
    assert!((0.2..0.45).contains(&here), "and did not walk into it: {here}");
    bench.keep("walk", -0.05, 2_000);
    assert_eq!((bench.values("any"), bench.values("right")), (vec![FALSE], vec![]));
    assert!(bench.nao.scene().body.base[0] < here - 0.05, "away from it, it walks");
}

pub(super) fn sonar() {
    let mut bench = Bench::new();
    for side in ["nearest", "left", "right"] {
        bench.open(side, "Sonar", &[("side", side)]);
    }
    let measured = |bench: &mut Bench| {
        bench.wait(1_000);
        ["nearest", "left", "right"].map(|side| {
            let values = bench.values(side);
            assert_eq!(values.len(), 10);
            values.last().and_then(Value::as_number).expect("a number of metres")
        })
    };
    assert!(measured(&mut bench).iter().all(|far| (1.9..=2.55).contains(far)), "the walls, and not the floor");
    bench.obstacle("box", [0.75, 0.35]);
    let [nearest, left, right] = measured(&mut bench);
    assert!((0.55..0.75).contains(&left) && right > 1.5, "{left} {right}");
    assert_eq!(nearest.to_bits(), left.to_bits());
    bench.present("box", false);
    bench.person([0.9, -0.4], true);
    let [_, left, right] = measured(&mut bench);
    assert!((0.7..1.0).contains(&right) && left > 1.5, "{left} {right}");
    bench.present("person", false);
    bench.ball("red", [0.17, 0.0, 0.4]);
    assert_eq!(measured(&mut bench)[0].to_bits(), f64::from(0.2_f32).to_bits(), "no nearer than it can measure");
}

pub(super) fn button() {
    let mut bench = Bench::new();
    bench.open("button", "Button", &[("label", "Go on")]);
    bench.edit(&SceneEdit::Touch { part: Touchable::HeadFront, down: true });
    bench.wait(5_000);
    assert!(bench.values("button").is_empty(), "only people on the page press it");
    assert!(bench.nao.command(&user("button"), &TRUE, Millis(0)).is_err());
}
