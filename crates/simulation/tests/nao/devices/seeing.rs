//! Tests of what the robot sees.

use crate::bench::{Bench, number};
use behaviour::Value;
use robot::{Robot, SceneEdit};

pub(super) fn red_ball() {
    let mut bench = Bench::new();
    bench.open("ball", "RedBall", &[]);
    bench.wait(1_000);
    let seen = bench.values("ball");
    assert_eq!(seen.len(), 30);
    assert!(number(&seen[0], "x") > 0.1 && number(&seen[0], "y") > 0.0 && number(&seen[0], "size") > 0.04);
    bench.obstacle("box", [0.45, 0.1]);
    bench.wait(100);
    bench.read("ball");
    bench.ball("red", [1.0, 0.2, 0.2]);
    bench.wait(1_000);
    assert!(bench.values("ball").is_empty(), "the box hides it");
    bench.present("box", false);
    bench.wait(1_000);
    assert!(bench.values("ball").len() >= 29, "and is gone");
}

pub(super) fn color_ball() {
    let mut bench = Bench::new();
    bench.open("green", "ColorBall", &[("color", "green")]);
    bench.obstacle("box", [1.0, 0.0]);
    bench.wait(500);
    assert!(bench.values("green").is_empty(), "a green box is no ball");
    bench.ball("green", [0.7, -0.1, 0.48]);
    bench.wait(500);
    let seen = bench.values("green");
    assert_eq!(seen.len(), 15);
    assert!((number(&seen[0], "x") - libm::atan2f(-0.1, 0.63)).abs() < 0.02);
}

pub(super) fn blob() {
    let mut bench = Bench::new();
    bench.open("any", "Blob", &[("color", "green")]);
    bench.open_with("large", "Blob", &[("color", Value::text("green")), ("size", Value::Float(0.1))]);
    bench.wait(500);
    assert!(bench.values("any").is_empty());
    bench.ball("green", [0.9, 0.0, 0.48]);
    bench.wait(500);
    assert_eq!((bench.values("any").len(), bench.values("large").len()), (15, 0), "a ball looks small");
    bench.obstacle("box", [1.2, 0.2]);
    bench.wait(500);
    let large = bench.values("large");
    assert_eq!(large.len(), 15, "a box looks large, whatever its form");
    assert!(number(&large[0], "size") >= 0.1 && number(&large[0], "x") > 0.1);
    assert_eq!(bench.values("any").last().map(|seen| number(seen, "x")), large.last().map(|seen| number(seen, "x")));
}

pub(super) fn face_detection() {
    let mut bench = Bench::new();
    bench.open("face", "FaceDetection", &[]);
    bench.wait(500);
    assert!(bench.values("face").is_empty(), "nobody is there");
    bench.person([1.6, 0.3], true);
    bench.wait(500);
    let seen = bench.values("face");
    assert_eq!((seen.len(), seen[0].field("new")), (5, Some(&Value::Bool(true))));
    assert!(number(&seen[0], "x") > 0.1 && number(&seen[0], "y") < -0.1);
    bench.person([-1.6, 0.3], true);
    bench.wait(500);
    assert!(bench.values("face").is_empty(), "behind it");
}

pub(super) fn people() {
    let mut bench = Bench::new();
    bench.open("people", "People", &[]);
    bench.wait(1_000);
    let nobody = bench.values("people");
    assert_eq!((nobody.len(), nobody[0].field("count"), nobody[0].field("id")), (5, Some(&0.into()), Some(&0.into())));
    assert_eq!((nobody[0].field("distance"), nobody[0].field("x")), (Some(&Value::Null), Some(&Value::Null)));
    bench.person([1.5, -0.3], true);
    bench.edit(&SceneEdit::MovePerson { id: "friend".to_owned(), at: [1.9, 0.5] });
    bench.present("friend", true);
    bench.wait(1_000);
    let both = bench.values("people").pop().expect("five a second");
    assert_eq!((both.field("count"), both.field("id")), (Some(&2.into()), Some(&1.into())));
    assert!((1.4..1.7).contains(&number(&both, "distance")) && number(&both, "x") < 0.0);
    bench.present("person", false);
    bench.wait(1_000);
    let friend = bench.values("people").pop().expect("five a second");
    assert_eq!((friend.field("count"), friend.field("id")), (Some(&1.into()), Some(&2.into())));
    bench.obstacle("block", [0.6, 0.2]);
    bench.wait(1_000);
    assert_eq!(bench.values("people").pop().expect("five a second").field("count"), Some(&1.into()), "it is low");
}

pub(super) fn landmark() {
    let mut bench = Bench::new();
    bench.open("any", "Landmark", &[]);
    bench.open_with("eighty", "Landmark", &[("number", Value::Int(80))]);
    bench.wait(500);
    assert!(bench.values("any").is_empty());
    bench.present("mark64", true);
    bench.wait(500);
    let seen = bench.values("any");
    assert_eq!((seen.len(), seen[0].field("number")), (5, Some(&64.into())));
    assert!(number(&seen[0], "x") > 0.1 && (0.05..0.08).contains(&number(&seen[0], "size")));
    assert!(bench.nao.scene().landmarks[0].seen);
    assert!(bench.values("eighty").is_empty());
    let place = |at: [f32; 3], facing: f32| SceneEdit::MoveLandmark { id: "mark64".to_owned(), at, facing };
    let pi = core::f32::consts::PI;
    for (at, facing, read) in [
        ([1.0, 0.0, 0.5], pi, true),
        ([1.0, 0.0, 0.5], pi - 0.7, true),
        ([1.0, 0.0, 0.5], pi - 0.9, false),
        ([1.0, 0.0, 0.5], 0.0, false),
        ([0.30, 0.0, 0.5], pi, false),
    ] {
        bench.edit(&place(at, facing));
        bench.wait(500);
        assert_eq!(!bench.values("any").is_empty(), read, "{at:?} {facing}");
    }
}
