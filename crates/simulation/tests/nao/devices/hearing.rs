//! Tests of what the robot hears.

use crate::bench::{Bench, number};
use behaviour::Value;
use robot::{Robot, SceneEdit};

pub(super) fn word_recognized() {
    let mut bench = Bench::new();
    bench.open("words", "WordRecognized", &[("words", "yes, no, good morning")]);
    bench.open_with("sure", "WordRecognized", &[("confidence", Value::Float(0.7))]);
    bench.speak("Good MORNING, robot!");
    bench.speak("I know");
    bench.speak("No.");
    bench.wait(100);
    let heard = bench.read("words");
    let words: Vec<_> = heard.iter().filter_map(|reading| reading.value.field("word")?.as_text()).collect();
    assert_eq!(words, ["good morning", "no"]);
    assert!(number(&heard[0].value, "confidence") < number(&heard[1].value, "confidence"), "alone it is clearer");
    assert_eq!(heard[0].value.field("time"), Some(&Value::Int(heard[0].at.0.cast_signed())));
    assert_eq!(bench.values("sure").len(), 1);
    assert_eq!(bench.nao.scene().body.heard, "No.");
    bench.open("say", "SayInput", &[]);
    bench.tell("say", "I talk and do not listen");
    bench.speak("yes");
    bench.wait(100);
    assert!(bench.values("words").is_empty());
    bench.wait(5_000);
    bench.speak("yes");
    bench.wait(100);
    assert_eq!(bench.values("words").len(), 1);
    for (words, said) in [
        ("  ", "there are no words to say; write some"),
        ("a".repeat(201).as_str(), "somebody may say 200 characters at once"),
    ] {
        let refused = bench.nao.edit(&SceneEdit::Speak { words: words.to_owned() }).expect_err("refused");
        assert_eq!(refused.to_string(), said);
    }
}

pub(super) fn sound_located() {
    let mut bench = Bench::new();
    let clap = |at: [f32; 3]| SceneEdit::Noise { at };
    bench.open("sound", "SoundLocated", &[]);
    bench.open_with("deaf", "SoundLocated", &[("sensitivity", Value::Float(0.2))]);
    bench.wait(1_000);
    assert!(bench.values("sound").is_empty(), "silence");
    bench.edit(&clap([1.0, 1.0, 0.5]));
    bench.wait(100);
    let heard = bench.values("sound").pop().expect("one clap");
    assert!((number(&heard, "azimuth") - core::f32::consts::FRAC_PI_4).abs() < 0.02);
    assert!(number(&heard, "elevation").abs() < 0.1 && (0.0..=1.0).contains(&number(&heard, "energy")));
    assert!(bench.values("deaf").is_empty(), "too far for a dull ear");
    bench.open("head", "SetJointPosition", &[("joint", "HeadYaw")]);
    bench.tell("head", 0.8);
    bench.wait(2_000);
    bench.edit(&clap([1.0, 1.0, 1.5]));
    bench.person([1.5, -0.5], true);
    bench.speak("hello");
    bench.wait(100);
    let heard = bench.values("sound");
    assert!(number(&heard[0], "azimuth").abs() < 0.05, "it looks there now");
    assert!(number(&heard[0], "elevation") > 0.5);
    assert!(number(&heard[1], "azimuth") < -0.9, "where the speaker is");
    bench.open("beep", "Sound", &[]);
    bench.tell("beep", true);
    bench.edit(&clap([0.5, 0.0, 0.5]));
    bench.wait(100);
    assert!(bench.values("sound").is_empty(), "it is loud itself");
}
