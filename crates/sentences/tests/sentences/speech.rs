//! Sentences as people say them: what they mean, what is asked about, and back again.

use crate::dice::Dice;
use crate::said::{random, strange};
use crate::support::{draft_behaviour, same_acting, sentences_of};
use behaviour::Helper;
use sentences::{Language, Lexicon, TEXT_MAX_CHARS, TextReading, explain, read_speech};

/// Sentences with what the program does that they make, or with the words that are asked about.
const SAID: [(Language, &str); 2] =
    [(Language::English, include_str!("../speech-en.txt")), (Language::Japanese, include_str!("../speech-ja.txt"))];

fn heard(text: &str, language: Language) -> TextReading {
    let helpers = robot::shipped_helpers();
    read_speech(text, language, Lexicon::of(language), &helpers.iter().collect::<Vec<&Helper>>(), None)
}

fn told(reading: &TextReading, language: Language) -> String {
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
    // A longer text is not read.
    if told.chars().count() > TEXT_MAX_CHARS {
        return false;
    }
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

/// The environment variable that says how many strange and mutated sentences are tried in the whole run.
const STRANGE: &str = "RRP_STRANGE_SENTENCES";

/// True if every word of a text that was understood means something in what was made of it, or nothing anywhere.
fn uses_every_word(text: &str, language: Language, unknown: &str) -> bool {
    let mut chars: Vec<char> = text.chars().collect();
    // A word that nobody knows, put between others, is never passed over.
    let places: Vec<usize> = (0..=chars.len()).filter(|at| is_between(&chars, *at)).collect();
    let at = places.get(places.len() / 2).copied().unwrap_or(0);
    chars.splice(at..at, unknown.chars());
    let text: String = chars.into_iter().collect();
    let reading = heard(&text, language);
    !reading.is_whole() || reading.texts.iter().any(|range| text[range.clone()].contains(unknown.trim()))
}

/// True if a place lies between words and outside of quotes.
fn is_between(chars: &[char], at: usize) -> bool {
    let before = &chars[..at];
    let count = |of: &[char]| before.iter().filter(|c| of.contains(c)).count();
    let is_open = count(&['"', '“', '”']) % 2 == 1 || count(&['「']) > count(&['」']);
    !is_open && (at == 0 || at == chars.len() || chars[at] == ' ' || chars[at] == '、')
}

#[test]
fn a_word_that_nobody_knows_is_used_as_a_text_or_named() {
    let mut dice = Dice::seeded(11);
    for at in 0..1_000 {
        let language = Language::ALL[at % 2];
        let unknown = if language == Language::English { " zorblat " } else { "ゾルブ" };
        let text = random(&mut dice, language);
        assert!(uses_every_word(&text, language, unknown), "{text}");
    }
}

#[test]
fn strange_and_mutated_sentences_are_in_doubt_where_they_stand() {
    let count = std::env::var(STRANGE).ok().and_then(|count| count.parse().ok()).unwrap_or(2_000);
    let mut dice = Dice::seeded(7);
    for at in 0..count {
        let language = Language::ALL[at % 2];
        let text = strange(&mut dice, language, at % 5 == 0);
        let read = heard(&text, language);
        assert!(read.doubts.iter().all(|doubt| doubt.suggestions.len() <= 3));
        for range in read.doubts.iter().map(|doubt| &doubt.range).chain(&read.texts) {
            assert!(text.get(range.clone()).is_some(), "{range:?} of {text}");
        }
        for connector in &read.draft.connectors {
            assert!(connector.inputs.iter().chain([&connector.output]).all(|at| *at < read.draft.streams.len()));
        }
        assert!(!read.is_whole() || !read.draft.streams.is_empty(), "{text}");
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
fn a_length_of_time_in_a_name_says_once_that_it_is_one() {
    let read = heard("頭が 1 時間触られなかったら、おじぎします。", Language::Japanese);
    let names: Vec<&str> = read.draft.streams.iter().map(|stream| stream.name.as_str()).collect();
    assert_eq!(names, ["頭のタッチ", "1 時間頭のタッチなし", "おじぎをします"]);
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
    assert!(reading.doubts[0].why.as_deref().unwrap().starts_with("踊りのないロボットもあります"));
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

#[test]
fn vague_words_tell_their_number_and_take_another() {
    let cases = [
        (Language::English, "When the child is near, wave.", "near", 1.0, "When the child is closer than 0.8 m, wave."),
        (
            Language::English,
            "When the ball is far away, wave.",
            "far away",
            100.0,
            "When the ball is farther than 0.8 cm, wave.",
        ),
        (
            Language::English,
            "When someone approaches, wave.",
            "approaches",
            1.0,
            "When someone comes closer than 0.8 m, wave.",
        ),
        (
            Language::English,
            "When the battery is low, sit down.",
            "low",
            20.0,
            "When the battery is below 0.8 %, sit down.",
        ),
        (Language::Japanese, "人が近づいたら手を振る", "近づいたら", 1.0, "人が0.8 mより近づいたら手を振る"),
        (Language::Japanese, "ボールが近ければうなずく", "近ければ", 50.0, "ボールが0.8 cmより近ければうなずく"),
    ];
    for (language, text, word, value, said) in cases {
        let reading = heard(text, language);
        let [vague] = &reading.vague[..] else { panic!("{text}: {:?}", reading.doubts) };
        assert_eq!((&text[vague.range.clone()], vague.value), (word, value), "{text}");
        let mut other = text.to_owned();
        other.replace_range(vague.range.clone(), &vague.said(0.8));
        assert_eq!(other, said);
        let again = heard(&other, language);
        assert!(again.is_whole() && again.vague.is_empty(), "{other}: {:?}", again.doubts);
        let mut same = text.to_owned();
        same.replace_range(vague.range.clone(), &vague.said(value));
        assert_eq!(told(&heard(&same, language), language), told(&reading, language), "{same}");
    }
}

#[test]
fn several_lines_are_several_sentences() {
    let reading = heard("When the head is touched, wave\nWhen you see a face, say hello", Language::English);
    let said = "When the head is touched, the robot waves. When a face is seen, the robot says “hello”.";
    assert_eq!(told(&reading, Language::English), said);
    let reading = heard("頭を触ったら手を振る\n顔が見えたら「やあ」と言う", Language::Japanese);
    assert_eq!(
        told(&reading, Language::Japanese),
        "頭に触られたとき、手を振ります。 顔が見えたとき、「やあ」と言います。"
    );
}
