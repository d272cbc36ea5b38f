//! What the robot says, shows, plays and remembers.

use crate::bench::{Bench, user};
use behaviour::Value;
use robot::{Millis, Robot};

fn said(bench: &Bench) -> Vec<&str> {
    bench.nao.spoken().iter().map(|spoken| spoken.text.as_str()).collect()
}

pub(super) fn say_input() {
    let mut bench = Bench::new();
    bench.open("say", "SayInput", &[]);
    bench.wait(500);
    assert!(said(&bench).is_empty());
    bench.tell("say", "hello there");
    bench.tell("say", 7_i64);
    bench.wait(100);
    assert_eq!(bench.nao.scene().body.saying, "hello there");
    bench.wait(3_000);
    assert_eq!(said(&bench), ["hello there", "7"]);
    assert!(bench.try_tell("say", Value::Null).is_err());
}

pub(super) fn say_parameter() {
    let mut bench = Bench::new();
    bench.open("say", "SayParameter", &[("text", "Well done")]);
    bench.tell("say", 3.0);
    bench.wait(2_000);
    bench.tell("say", Value::Null);
    bench.wait(2_000);
    assert_eq!(said(&bench), ["Well done", "Well done"]);
}

pub(super) fn sound() {
    let mut bench = Bench::new();
    bench.open("beep", "Sound", &[("sound", "high")]);
    bench.open("file", "Sound", &[("sound", "file"), ("file", "/home/nao/song.ogg")]);
    bench.tell("beep", true);
    bench.wait(100);
    bench.tell("beep", true);
    assert_eq!(bench.nao.scene().body.playing, "high");
    bench.wait(1_000);
    assert_eq!((bench.nao.sounds().len(), bench.nao.scene().body.playing.as_str()), (1, ""), "not begun again");
    let high = &bench.nao.sounds()[0];
    assert_eq!((high.from, high.until, high.cut, high.volume), (Millis(0), Some(Millis(300)), false, 50));
    bench.tell("file", true);
    bench.tell("beep", true);
    bench.wait(100);
    bench.nao.close(&user("file"));
    assert_eq!(bench.nao.scene().body.playing, "high", "only its own ends");
    bench.nao.stop(Millis(bench.now));
    let cut: Vec<_> = bench.nao.sounds().iter().map(|played| (played.sound.as_str(), played.cut)).collect();
    assert_eq!(cut, [("high", false), ("/home/nao/song.ogg", true), ("high", true)]);
    let nameless = [("sound".to_owned(), Value::text("file"))].into_iter().collect();
    assert!(bench.nao.open(&user("none"), "Sound", &nameless).is_err(), "a file has a name");
}

pub(super) fn eye_led_color() {
    let mut bench = Bench::new();
    bench.open("green", "EyeLedColor", &[("color", "green")]);
    assert_eq!(bench.nao.scene().body.eyes, [1.0; 3]);
    bench.tell("green", true);
    assert_eq!(bench.nao.scene().body.eyes, [0.0, 1.0, 0.0]);
    bench.open("value", "EyeLedColor", &[("color", "Value")]);
    assert!(bench.try_tell("value", "plaid").is_err());
    assert_eq!(bench.nao.scene().body.eyes, [0.0, 1.0, 0.0]);
}

pub(super) fn eye_brightness() {
    let mut bench = Bench::new();
    bench.open("bright", "EyeBrightness", &[]);
    bench.tell("bright", 0.25);
    assert_eq!(bench.nao.scene().body.eyes, [0.25; 3]);
    assert!(bench.try_tell("bright", "very").is_err());
}

pub(super) fn remember_face() {
    let mut bench = Bench::new();
    bench.open("learn", "RememberFace", &[]);
    assert!(bench.try_tell("learn", true).is_err(), "nobody is there");
    bench.person([1.6, 0.0], true);
    bench.wait(50);
    bench.tell("learn", true);
    let people = bench.nao.scene().people;
    assert!(people[0].known && !people[1].known);
}

pub(super) fn print() {
    let mut bench = Bench::new();
    bench.open("print", "Print", &[]);
    bench.tell("print", "a text");
    bench.tell("print", Value::list([1_i64.into(), 2_i64.into()]));
    let printed = bench.nao.scene().body.printed;
    assert_eq!(printed.iter().map(|one| one.text.as_str()).collect::<Vec<_>>(), ["a text", "[1, 2]"]);
    assert!(printed.iter().all(|one| one.by.stream.as_str() == "print"));
}
