//! Tests of what the robot says, shows, plays and remembers.

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

pub(super) fn voice() {
    let mut bench = Bench::new();
    bench.open("say", "SayParameter", &[("text", "one two three four five six")]);
    bench.open_with(
        "voice",
        "Voice",
        &[
            ("volume", 50.0.into()),
            ("speed", 200.0.into()),
            ("gestures", "yes".into()),
            ("language", "Japanese".into()),
        ],
    );
    let lasted = |bench: &mut Bench| {
        bench.tell("say", true);
        bench.wait(3_000);
        let last = bench.nao.spoken().last().expect("it spoke").clone();
        last.until.expect("it ended").0 - last.from.0
    };
    let usual = lasted(&mut bench);
    assert_eq!(bench.nao.speaks(), None, "as usual until a value comes");
    bench.tell("voice", true);
    assert_eq!(bench.nao.speaks().as_deref(), Some("50 %, 200 % fast, with gestures, in Japanese"));
    bench.tell("say", true);
    bench.wait(100);
    assert_eq!(bench.nao.scene().body.playing, "explaining");
    bench.wait(3_000);
    assert!(lasted(&mut bench).abs_diff(usual / 2) <= 10, "twice as fast");
    bench.nao.close(&user("voice"));
    assert_eq!((bench.nao.speaks(), lasted(&mut bench)), (None, usual), "as before");
    let klingon = [("language".to_owned(), Value::text("Klingon"))].into();
    let refused = bench.nao.open(&user("other"), "Voice", &klingon).expect_err("it does not speak that");
    assert!(refused.to_string().starts_with("the language “Klingon” is not installed"), "{refused}");
}

pub(super) fn lights() {
    let mut bench = Bench::new();
    bench.open("ears", "Lights", &[("color", "yellow")]);
    bench.open("chest", "Lights", &[("part", "chest"), ("color", "Value")]);
    bench.open("shoulders", "Lights", &[("part", "shoulders")]);
    assert!(bench.nao.scene().body.lights.is_empty());
    bench.tell("ears", true);
    bench.tell("chest", "green");
    let lights = bench.nao.scene().body.lights;
    assert_eq!((lights["ears"], lights["chest"]), ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]), "ears shine blue only");
    let refused = bench.try_tell("shoulders", true).expect_err("it is no Pepper");
    assert!(refused.to_string().contains("only a Pepper"), "{refused}");
    bench.nao.close(&user("chest"));
    assert_eq!(bench.nao.scene().body.lights.len(), 1, "the chest is the robot's own again");
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

pub(super) fn tablet() {
    let mut bench = Bench::new();
    let refused = bench.nao.open(&user("tablet"), "Tablet", &Default::default()).expect_err("it is no Pepper");
    assert_eq!(refused.to_string(), "this robot has no device called “Tablet”");
    let lacking = bench.nao.lacking();
    assert_eq!(
        lacking.iter().map(|one| (one.device.clone(), one.why.to_string())).collect::<Vec<_>>(),
        [("Tablet".to_owned(), "it has no tablet; a Pepper has one".to_owned())]
    );
}
