//! Sentences as people say them: what they mean, what is asked about, and back again.

use crate::dice::Dice;
use crate::support::{draft_behaviour, same_acting, sentences_of};
use behaviour::Helper;
use sentences::{Language, Lexicon, Reading, explain, read_speech};

/// Sentences with what the program does that they make, or with the words that are asked about.
const SAID: [(Language, &str); 2] =
    [(Language::English, include_str!("../speech-en.txt")), (Language::Japanese, include_str!("../speech-ja.txt"))];

fn heard(text: &str, language: Language) -> Reading {
    let helpers = robot::shipped_helpers();
    read_speech(text, language, Lexicon::of(language), &helpers.iter().collect::<Vec<&Helper>>(), None)
}

fn told(reading: &Reading, language: Language) -> String {
    let helpers = robot::shipped_helpers();
    sentences_of(&reading.draft.behaviour(), &helpers, language).join(" ")
}

/// What a sentence was understood as, or the words in doubt.
fn answer(text: &str, language: Language) -> String {
    let reading = heard(text, language);
    if reading.is_whole() {
        return format!("= {}", told(&reading, language));
    }
    let doubts = reading.doubts.iter().map(|doubt| match &doubt.suggestions[..] {
        [] => format!("[{}]", &text[doubt.range.clone()]),
        words => format!("[{}: {}]", &text[doubt.range.clone()], words.join(", ")),
    });
    format!("? {}", doubts.collect::<Vec<_>>().join(" "))
}

#[test]
fn what_people_say_is_understood_or_asked_about() {
    let mut wrong = Vec::new();
    for (language, said) in SAID {
        let lines: Vec<&str> = said.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).collect();
        for pair in lines.chunks(2) {
            let [text, wanted] = pair else { panic!("{pair:?}") };
            let got = answer(text, language);
            if got != wanted.trim() {
                wrong.push(format!("{text}\n  {got}\n  not {}", wanted.trim()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_understood_is_told_and_understood_again() {
    let mut tried = 0;
    for (language, said) in SAID {
        let lines: Vec<&str> = said.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).collect();
        for text in lines.chunks(2).map(|pair| pair[0]) {
            tried += usize::from(is_understood_again(text, language));
        }
    }
    assert!(tried > 200, "{tried}");
}

/// Whether a text is understood; then what is told of it is understood as the same.
fn is_understood_again(text: &str, language: Language) -> bool {
    let reading = heard(text, language);
    if !reading.is_whole() {
        return false;
    }
    let first = draft_behaviour(&reading.draft);
    let told = told(&reading, language);
    let again = heard(&told, language);
    assert!(again.doubts.is_empty(), "{text}\n{told}\n{:?}", again.doubts);
    let second = draft_behaviour(&again.draft);
    assert_eq!(same_acting(&first, &second), Ok(()), "{text}\n{told}");
    let helpers = robot::shipped_helpers();
    let helpers: Vec<&Helper> = helpers.iter().collect();
    let twice: Vec<String> = explain(&second, &helpers, &|_| None, language).iter().map(ToString::to_string).collect();
    assert_eq!(twice.join(" "), told, "{text}");
    true
}

const EVENTS: [&[&str]; 2] = [
    &[
        "the head is touched",
        "somebody pats the back of the head",
        "I press the button",
        "you see a face",
        "a new face appears",
        "you recognise the child",
        "the red ball is there",
        "you see something green",
        "the blue ball shows up",
        "the child says \"yes\"",
        "the child says “hi” or “hello”",
        "somebody claps",
        "there is a loud noise",
        "it is quiet for 10 seconds",
        "nobody is there for half a minute",
        "the ball is not seen for 5 seconds",
        "the left hand is held for 2 seconds",
        "the right hand is let go",
        "the left foot bumps into something",
        "you fall over",
        "the battery is below 20 %",
        "someone is closer than 1.5 m",
        "the red ball is between 30 and 60 cm away",
        "something is nearer than half a metre in front of you",
        "more than two people are there",
        "you are sitting",
        "you see mark 64",
        "the head or a hand is touched",
        "the head is touched three times",
        "another person comes",
        "the child leaves",
    ],
    &[
        "頭を触ったら",
        "頭の後ろを触られたら",
        "ボタンを押したら",
        "顔が見えたら",
        "知らない人が来たら",
        "知っている顔が見えたら",
        "赤いボールを見つけたら",
        "緑のものが見えたら",
        "青いボールが見えたら",
        "子どもが「はい」と言ったら",
        "「うん」か「はい」と言われたら",
        "手をたたいたら",
        "大きな音がしたら",
        "10秒間静かだったら",
        "30秒間誰もいなかったら",
        "5秒間ボールが見えなかったら",
        "左手を2秒間触り続けたら",
        "右手から手が離れたら",
        "左足が何かにぶつかったら",
        "転んだら",
        "電池が20%を切ったら",
        "人が1.5メートルより近いとき",
        "赤いボールが30cmから60cmの間にあるとき",
        "目の前50センチ以内に何かあったら",
        "3人以上いたら",
        "ロボットが座ったら",
        "64番のマークが見えたら",
        "頭か手を触られたら",
        "頭を3回触ったら",
        "別の人が来たら",
        "人がいなくなったら",
    ],
];

const ACTS: [&[&str]; 2] = [
    &[
        "say \"well done\"",
        "wave",
        "nod",
        "bow",
        "cheer",
        "sit down",
        "stand up",
        "turn the eyes green",
        "turn the eyes off",
        "beep",
        "play a high beep",
        "open the right hand",
        "raise both arms",
        "look at the red ball",
        "walk forward",
        "set the brightness of the eyes to 30 %",
        "say how many people there are",
        "turn the head 20 degrees to the left",
        "say \"one\", and 2 seconds later nod",
        "wave and say \"hello\"",
    ],
    &[
        "「よくできました」と言う",
        "手を振る",
        "うなずく",
        "おじぎをする",
        "喜ぶ",
        "座る",
        "立つ",
        "目を緑にする",
        "目を消す",
        "音を鳴らす",
        "高い音を鳴らす",
        "右手を開く",
        "両腕を上げる",
        "赤いボールを見る",
        "前に歩く",
        "目の明るさを30%にする",
        "人の数を言う",
        "頭を左に20度向ける",
        "「いち」と言って、2秒後にうなずく",
        "手を振って「やあ」と言う",
    ],
];

/// A sentence of random clauses.
fn random(dice: &mut Dice, language: Language) -> String {
    let at = usize::from(language == Language::Japanese);
    let (event, act, other) = (dice.one(EVENTS[at]), dice.one(ACTS[at]), dice.one(ACTS[at]));
    if at == 0 {
        return match dice.below(9) {
            0 => format!("{act} when {event}"),
            1 => format!("When {event}, {act}, but at most once a minute."),
            2 => format!("When {event}, {act} once."),
            3 => format!("When {event}, {act} unless the battery is below 10 %."),
            4 => format!("Every 20 seconds if {event} {act}"),
            5 => format!("When {event}, {act}. Then {other}."),
            6 => format!("NAO, please {act} as soon as {event}!"),
            7 => format!("When {event}: {act}. If {}, {other}.", dice.one(EVENTS[0])),
            _ => format!("When {event}, {act}"),
        };
    }
    match dice.below(6) {
        0 => format!("{event}{act}。ただし1分に1回まで。"),
        1 => format!("{event}、一度だけ{act}"),
        2 => format!("20秒ごとに、{event}{act}"),
        3 => format!("{event}{act}。それから{other}。"),
        4 => format!("{event}{act}。{}{other}。", dice.one(EVENTS[1])),
        _ => format!("もし{event}、{act}。"),
    }
}

#[test]
fn two_thousand_random_programs_are_told_and_understood_again() {
    let mut dice = Dice::seeded(36);
    let mut understood = 0;
    for at in 0..2_000 {
        let language = Language::ALL[at % 2];
        understood += usize::from(is_understood_again(&random(&mut dice, language), language));
    }
    assert!(understood > 1_700, "{understood}");
}

#[test]
fn strange_and_mutated_sentences_are_in_doubt_where_they_stand() {
    let pieces = [
        "(",
        "“",
        "”",
        "「",
        "」",
        ",",
        ".",
        "-",
        "9",
        "1e9",
        "99999999999999999999",
        "\u{0}",
        "é",
        "とき",
        "、",
        " when ",
        " or ",
        " and ",
        " every ",
        "が",
        "😀",
        "\n",
        "|",
        "ー",
        "００",
        "'",
        "n't",
        " 1,000 ",
        "半",
        "十百",
        " a half ",
        " until ",
        "まで",
        "ないで",
        " twenty ",
    ];
    let mut dice = Dice::seeded(7);
    for at in 0..2_000 {
        let language = Language::ALL[at % 2];
        let mut chars: Vec<char> = if at % 5 == 0 {
            (0..dice.below(40)).flat_map(|_| dice.one(&pieces).chars()).collect()
        } else {
            random(&mut dice, language).chars().collect()
        };
        for _ in 0..=dice.below(6) {
            let at = dice.below(chars.len() + 1);
            match dice.below(3) {
                0 if at < chars.len() => drop(chars.remove(at)),
                1 => chars.truncate(at.max(3)),
                _ => drop(chars.splice(at..at, dice.one(&pieces).chars())),
            }
        }
        let text: String = chars.into_iter().collect();
        let read = heard(&text, language);
        assert!(read.doubts.iter().all(|doubt| doubt.suggestions.len() <= 3));
        for range in read.doubts.iter().map(|doubt| &doubt.range).chain(&read.texts) {
            assert!(text.get(range.clone()).is_some(), "{range:?} of {text}");
        }
        for connector in &read.draft.connectors {
            assert!(connector.inputs.iter().chain([&connector.output]).all(|at| *at < read.draft.streams.len()));
        }
    }
}

#[test]
fn long_texts_are_read_no_further_than_their_bounds() {
    let texts = [
        "when ".repeat(200),
        "say ".repeat(240),
        "the head ".repeat(110),
        "頭を触ったら".repeat(160),
        "と言".repeat(480),
        "9".repeat(1_000),
        "twenty ".repeat(140),
        "a half ".repeat(140),
        "'".repeat(1_000),
        "十".repeat(1_000),
        "and then wave or ".repeat(60),
        "ない".repeat(500),
    ];
    for text in texts {
        for language in Language::ALL {
            assert!(!heard(&text, language).doubts.is_empty(), "{text}");
        }
    }
}

#[test]
fn words_to_be_heard_are_those_of_the_language_that_is_typed() {
    let languages = [
        (Language::English, "When the child says \"yes\", nod."),
        (Language::Japanese, "「はい」と言われたとき、うなずきます。"),
    ];
    for (language, text) in languages {
        let reading = heard(text, language);
        let stream = reading.draft.streams.iter().find(|stream| stream.device.as_deref() == Some("WordRecognized"));
        let chosen = stream.unwrap().params.get("language").and_then(behaviour::Value::as_text).map(str::to_owned);
        assert_eq!(chosen.as_deref(), Some(if language == Language::English { "English" } else { "Japanese" }));
    }
}

#[test]
fn what_cannot_be_done_is_said() {
    let reading = heard("When the child cries, wave.", Language::English);
    assert_eq!(reading.doubts[0].why.as_deref(), Some("The robot cannot notice crying. It can hear a loud sound."));
    let reading = heard("頭を触ったら踊る", Language::Japanese);
    assert!(reading.doubts[0].why.as_deref().unwrap().starts_with("ロボットの身ぶりに踊りはありません"));
}

#[test]
fn every_meaning_without_a_sense_or_action_says_so_in_both_languages() {
    for (language, text) in [
        (Language::English, include_str!("../../../../static/speech-en.txt")),
        (Language::Japanese, include_str!("../../../../static/speech-ja.txt")),
    ] {
        let says: Vec<&str> = text
            .lines()
            .filter_map(|line| line.strip_prefix("! "))
            .filter_map(|line| line.split(" =").next())
            .collect();
        let meant = text.lines().filter(|line| !line.starts_with(['#', '!', '%', '+']));
        for kind in meant.filter_map(|line| line.rsplit_once("= ")).map(|(_, means)| means) {
            if let Some(gap) = kind.strip_prefix("gap ").or_else(|| kind.strip_prefix("vague ")) {
                assert!(says.contains(&gap), "{language:?}: {gap}");
            }
        }
    }
}
