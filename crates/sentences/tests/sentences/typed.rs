//! Sentences as people type them.

use crate::support::{draft_behaviour, reading, sentences_of};
use behaviour::Procedure;
use sentences::{Language, looks_like_sentence};

/// What somebody may type, and the sentence that is meant.
const ENGLISH: &[(&str, &str)] = &[
    (
        "when the red ball is closer than 40cm the head follows it",
        "When the red ball is nearer than 40 cm, the head follows it.",
    ),
    ("WHEN RED BALL IS WITHIN 400 mm, LOOK AT IT", "When the red ball is nearer than 40 cm, the head follows it."),
    ("when the ball is near, follow it", "When the red ball is nearer than 50 cm, the head follows it."),
    ("If the robot sees a face, it says hello", "When a face is seen, the robot says “hello”."),
    (
        "When there is a new face, the robot says \"Hello there\"",
        "When a new face is seen, the robot says “Hello there”.",
    ),
    ("Wave when somebody touches the left hand", "When the left hand is touched, the robot waves."),
    ("the eyes turn green when the head is touched.", "When the head is touched, the eyes turn green."),
    ("When the head is touched for 1 second, sit down", "When the head is touched for 1 second, the robot sits down."),
    ("When a green ball is seen, green eyes", "When a green-colored ball is seen, the eyes turn green."),
    (
        "when nobody is there for 5 s the robot says goodbye",
        "When nobody was seen for 5 seconds, the robot says “goodbye”.",
    ),
    ("every 2 s when a face is seen, nod", "Every 2 seconds when a face is seen, the robot nods."),
    (
        "when somebody claps, 2 seconds later the robot stands up",
        "When a loud sound is heard, 2 seconds later, the robot stands up.",
    ),
    ("When the battery is below 20 %, the robot sits", "When the battery is less than 20 %, the robot sits down."),
    (
        "When somebody is closer than 1 m, the robot waves",
        "When the nearest person is nearer than 1 m, the robot waves.",
    ),
    (
        "When the red ball is nearer than 40 cm, the head follows it. Otherwise the eyes shine brighter the nearer it is.",
        "When the red ball is nearer than 40 cm, the head follows it. Otherwise the eyes shine brighter the nearer it is.",
    ),
    (
        "When the head is touched, the robot waves and says hello",
        "When the head is touched, the robot waves. When the head is touched, the robot says “hello”.",
    ),
    (
        "When the red ball is far away, then the body follows it",
        "When the red ball is farther than 50 cm, the whole body follows it.",
    ),
    ("when someone says hello the robot waves", "When somebody says “hello”, the robot waves."),
    ("When the robot sees the red ball, it says red", "When the red ball is seen, the robot says “red”."),
    (
        "When the left foot hits something, the robot says \"Ouch\"",
        "When the left foot bumps into something, the robot says “Ouch”.",
    ),
    ("When the robot falls, it plays a high beep", "When the robot falls, the robot plays a high beep."),
    (
        "If the number of people is more than 2, the robot bows",
        "When the number of people is more than 2, the robot bows.",
    ),
    (
        "When the head is touched or the left hand is touched, the robot says it",
        "When the head is touched or the left hand is touched, the robot says it.",
    ),
];

const JAPANESE: &[(&str, &str)] = &[
    ("赤いボールが４０ｃｍより近いとき頭で追いかけます", "赤いボールが 40 cm より近いとき、頭で追いかけます。"),
    (
        "赤いボールが 40 cm より近いとき、頭で追いかけます。それ以外のとき、近いほど目が明るく光ります。",
        "赤いボールが 40 cm より近いとき、頭で追いかけます。 それ以外のとき、近いほど目が明るく光ります。",
    ),
    ("頭に触ったら、目が緑に光る", "頭に触られたとき、目が緑に光ります。"),
    ("顔が見えたら「こんにちは」と話す", "顔が見えたとき、「こんにちは」と言います。"),
    ("顔が見えたとき、こんにちはと言います", "顔が見えたとき、「こんにちは」と言います。"),
    ("1秒ごとに、顔が見えたとき、うなずく", "1 秒ごとに、顔が見えたとき、うなずきます。"),
];

#[test]
fn what_people_type_is_understood() {
    for (language, cases) in [(Language::English, ENGLISH), (Language::Japanese, JAPANESE)] {
        for (typed, meant) in cases {
            let read = reading(typed, language, &[]);
            let told = sentences_of(&draft_behaviour(&read.draft), &[], language).join(" ");
            assert_eq!((told.as_str(), &read.doubts[..]), (*meant, &[][..]), "{typed}");
        }
    }
}

#[test]
fn names_say_what_streams_are() {
    let names = |text: &str, language| {
        let read = reading(text, language, &[]);
        read.draft.streams.into_iter().map(|stream| stream.name).collect::<Vec<_>>().join(", ")
    };
    let en = Language::English;
    assert_eq!(names("When the head is touched, the eyes turn green.", en), "Head touch, Touched, Green eyes");
    let far = "When the red ball is nearer than 40 cm, the head follows it. Otherwise the eyes turn red.";
    assert_eq!(names(far, en), "Red ball, Distance, Close ball, Otherwise, Tracker, Red eyes");
    let near = "赤いボールが 40 cm より近いとき、頭で追いかけます。";
    assert_eq!(names(near, Language::Japanese), "赤いボール, 距離, 近いボール, トラッカー");
}

#[test]
fn a_typed_otherwise_follows_its_test_like_one_made_by_a_button() {
    let (en, ja) = (Language::English, Language::Japanese);
    let cases = [
        (en, "When the red ball is nearer than 40 cm, the head follows it. Otherwise the eyes turn red.", "Otherwise"),
        (en, "When the head is touched, the robot waves. If not, the robot sits down.", "Otherwise"),
        (en, "When “hello” is heard, the robot waves. Otherwise the robot nods.", "Otherwise"),
        (ja, "赤いボールが 40 cm より近いとき、頭で追いかけます。それ以外のとき、目が赤く光ります。", "それ以外"),
    ];
    for (language, text, name) in cases {
        let read = reading(text, language, &[]);
        let behaviour = draft_behaviour(&read.draft);
        let named = behaviour
            .connectors()
            .filter(|(_, connector)| behaviour.stream(&connector.output).is_some_and(|stream| stream.name == name));
        let follows: Vec<_> = named.map(|(_, connector)| behaviour::follows_test(&behaviour, connector)).collect();
        assert_eq!(follows, [true], "{text}: {behaviour:?}");
    }
}

#[test]
fn a_word_that_is_not_known_gets_suggestions() {
    let text = "When the head is patted, the eyes turn green.";
    let read = reading(text, Language::English, &[]);
    let [doubt] = &read.doubts[..] else { panic!("{:?}", read.doubts) };
    assert_eq!(&text[doubt.range.clone()], "patted");
    assert_eq!(doubt.suggestions, ["touched", "let go", "touched for 1 second"]);
    let names: Vec<_> = read.draft.streams.iter().map(|stream| (stream.name.as_str(), stream.doubtful)).collect();
    assert_eq!(names, [("Head touch", false), ("Touched", true), ("Green eyes", false)]);
    assert_eq!(read.draft.connectors.iter().map(|one| one.doubtful).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn a_slip_is_mended_by_what_is_written_nearly_so() {
    let cases = [
        ("When the red ball is nearr than 40 cm, the head follows it.", "nearr", "nearer"),
        ("When the haed is touched, the eyes turn green.", "haed", "head"),
        ("When a face is seen, the eyes turn gren.", "gren", "green"),
        ("When a face is seen, the robot wawes.", "wawes", "waves"),
        ("When a face is seen, the robot sings.", "sings", ""),
        ("When the head is", "", ""),
    ];
    for (text, slip, meant) in cases {
        let read = reading(text, Language::English, &[]);
        let [doubt] = &read.doubts[..] else { panic!("{text}: {:?}", read.doubts) };
        assert_eq!(&text[doubt.range.clone()], slip, "{text}: {doubt:?}");
        assert!(!doubt.suggestions.is_empty() && doubt.suggestions.len() <= 3, "{text}");
        assert!(meant.is_empty() || doubt.suggestions[0] == meant, "{text}: {doubt:?}");
        let mut mended = text.to_owned();
        mended.replace_range(doubt.range.clone(), &doubt.suggestions[0]);
        let again = reading(&mended, Language::English, &[]);
        assert!(again.doubts.first() != Some(doubt), "{mended}");
    }
    let text = "頭をなでられたとき、目が緑に光ります。";
    let read = reading(text, Language::Japanese, &[]);
    let [doubt] = &read.doubts[..] else { panic!("{:?}", read.doubts) };
    assert!(text[doubt.range.clone()].starts_with('な') && !doubt.suggestions.is_empty(), "{doubt:?}");
}

#[test]
fn sentences_look_like_sentences() {
    for text in ["when ", "When the", "the eyes turn", "赤いボールが近いとき", "every second"] {
        assert!(looks_like_sentence(text), "{text}");
    }
    for text in ["", "when", "Red ball", "Head tou", "赤いボール"] {
        assert!(!looks_like_sentence(text), "{text}");
    }
}

#[test]
fn a_decimal_comma_is_one_number_and_a_doubtful_one_is_asked_about() {
    let said = |text: &str| {
        let reading = sentences::read(text, Language::English, &[], None);
        let bodies = reading.draft.connectors.iter().filter_map(|one| one.operation.procedure());
        let bodies: Vec<String> = bodies
            .filter_map(|procedure| match procedure {
                Procedure::Body { body, .. } => Some(body.clone()),
                Procedure::Helper(_) => None,
            })
            .collect();
        let samples = reading.draft.connectors.iter().any(|one| one.operation.period_ms().is_some());
        (bodies, samples, reading.doubts)
    };
    let sentence = |number: &str| format!("When the red ball is nearer than {number} m, the head follows it.");
    for (number, body) in [("1,5", "distance < 1.5"), ("0,5", "distance < 0.5"), ("１，５", "distance < 1.5")] {
        let (bodies, samples, doubts) = said(&sentence(number));
        assert_eq!((bodies, samples, doubts.len()), (vec![body.to_owned()], false, 0), "{number}");
    }
    let (_, samples, doubts) = said(&sentence("1,000"));
    assert!(!samples);
    let typed = sentence("1,000");
    let asked = doubts.into_iter().map(|doubt| (typed[doubt.range].to_owned(), doubt.suggestions));
    let asked: Vec<_> = asked.collect();
    assert_eq!(asked, [("1,000".to_owned(), vec!["1000".to_owned(), "1".to_owned()])]);
}
