//! Tokens as atoms: words with all that they may mean, measures, quotes and signs.

use super::lexicon::{Lexicon, WordForm, WritingSense};
use super::tokens::{SpeechToken, SpeechTokenKind};
use crate::Language;
use std::ops::Range;

/// A part of a sentence that means something by itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Atom {
    /// Its tokens.
    pub(super) span: Range<usize>,
    /// What it may mean; of words that are not known, nothing.
    pub(super) senses: Vec<WritingSense>,
    pub(super) value: AtomValue,
}

/// What an atom says besides its words.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum AtomValue {
    #[default]
    Nothing,
    Measure(CountedNumber),
    Quote(String),
    Sign(char),
}

/// A number with what it counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CountedNumber {
    Number(f64),
    /// A length in centimetres or metres.
    Length(f64, &'static str),
    /// Milliseconds.
    Time(u64),
    /// Per cent.
    Share(f64),
    /// Radians.
    Angle(f64),
    Times(f64),
    People(f64),
    /// The number of a mark.
    Mark(f64),
    /// A time of day, in minutes after midnight.
    Clock(u32),
}

/// What a token costs that is not known, and a word.
const UNKNOWN: usize = 60;
const WORD: usize = 10;
/// The longest measure, in tokens.
const LONGEST_MS: f64 = 86_400_000.0;

impl Atom {
    /// What it means of this kind: its argument and form.
    pub(super) fn of(&self, kind: &str) -> Option<&WritingSense> {
        self.senses.iter().find(|sense| sense.kind == kind)
    }

    /// Whether it means this.
    pub(super) fn is(&self, kind: &str, arg: &str) -> bool {
        self.senses.iter().any(|sense| sense.kind == kind && (arg.is_empty() || sense.arg == arg))
    }

    /// What it means of this kind and argument.
    pub(super) fn sense(&self, kind: &str, arg: &str) -> Option<&WritingSense> {
        self.senses.iter().find(|sense| sense.kind == kind && (arg.is_empty() || sense.arg == arg))
    }

    /// Whether nobody knows it.
    pub(super) fn is_unknown(&self) -> bool {
        self.senses.is_empty() && self.value == AtomValue::Nothing
    }

    /// Whether it is a sign.
    pub(super) fn is_sign(&self, sign: char) -> bool {
        self.value == AtomValue::Sign(sign)
    }
}

/// The atoms of a sentence: the fewest that cover it, the longer ones first.
pub(super) fn atoms(
    tokens: &[SpeechToken],
    from: usize,
    to: usize,
    lexicon: &Lexicon,
    language: Language,
) -> Vec<Atom> {
    let words: Vec<&str> = tokens[from..to].iter().map(word).collect();
    let count = words.len();
    let mut best: Vec<(usize, Option<Atom>)> = vec![(0, None); count + 1];
    for at in (0..count).rev() {
        let token = &tokens[from + at];
        let mut options: Vec<(usize, usize, Atom)> = Vec::new();
        let mut add = |end: usize, cost: usize, senses: Vec<WritingSense>, value: AtomValue| {
            options.push((end, cost, Atom { span: from + at..from + end, senses, value }));
        };
        match &token.what {
            SpeechTokenKind::Quote(text) => add(at + 1, WORD, Vec::new(), AtomValue::Quote(text.clone())),
            SpeechTokenKind::Sign(sign) if lexicon.at(&words, at).is_empty() => {
                add(at + 1, WORD, Vec::new(), AtomValue::Sign(*sign))
            }
            SpeechTokenKind::Unsure => add(at + 1, UNKNOWN, Vec::new(), AtomValue::Nothing),
            _ => add(at + 1, UNKNOWN, Vec::new(), AtomValue::Nothing),
        }
        let found = lexicon.at(&words, at);
        if let Some((end, measure)) = measure(tokens, from, &words, at, lexicon, language) {
            let senses = found.iter().filter(|(other, _)| *other == end).map(|(_, sense)| *sense).collect();
            add(end, WORD, senses, AtomValue::Measure(measure));
        }
        let mut ends: Vec<usize> = found.iter().map(|(end, _)| *end).collect();
        ends.sort_unstable();
        ends.dedup();
        for end in ends {
            let senses: Vec<WritingSense> =
                found.iter().filter(|(other, _)| *other == end).map(|(_, sense)| *sense).collect();
            add(end, WORD, senses, AtomValue::Nothing);
        }
        let chosen = options.into_iter().min_by_key(|(end, cost, _)| (best[*end].0 + cost, usize::MAX - end));
        if let Some((end, cost, atom)) = chosen {
            best[at] = (best[end].0 + cost, Some(atom));
        }
    }
    let mut all: Vec<Atom> = Vec::new();
    let mut at = 0;
    while at < count {
        let Some(atom) = best[at].1.clone() else { break };
        at = atom.span.end - from;
        // Letters of Japanese that nobody knows are one word.
        match all.last_mut() {
            Some(last) if language == Language::Japanese && last.is_unknown() && atom.is_unknown() => {
                last.span.end = atom.span.end;
            }
            _ => all.push(atom),
        }
    }
    all
}

/// The word of a token; what is none looks like no word.
fn word(token: &SpeechToken) -> &str {
    match &token.what {
        SpeechTokenKind::Word(word) => word,
        SpeechTokenKind::Sign('%') => "%",
        SpeechTokenKind::Sign('<') => "<",
        SpeechTokenKind::Sign('>') => ">",
        SpeechTokenKind::Sign('≤') => "≤",
        SpeechTokenKind::Sign('≥') => "≥",
        SpeechTokenKind::Sign('=') => "=",
        _ => "\0",
    }
}

/// The number that begins here and where it ends.
fn number(tokens: &[SpeechToken], from: usize, words: &[&str], at: usize, lexicon: &Lexicon) -> Option<(usize, f64)> {
    if let SpeechTokenKind::Number(number) = tokens.get(from + at)?.what {
        return Some((at + 1, number));
    }
    let numeral = |at: usize| -> Option<(usize, f64)> {
        let found = lexicon.at(words, at);
        let (end, sense) = found.iter().filter(|(_, sense)| sense.kind == "num").max_by_key(|(end, _)| *end)?;
        Some((*end, sense.arg.parse().ok()?))
    };
    let (mut end, first) = numeral(at)?;
    // Ones follow tens, tens follow hundreds: *twenty five*, 二十五.
    let (mut sum, mut part) = (0.0, first);
    while let Some((next, value)) = numeral(end) {
        if value >= 10.0 && part < value && part > 0.0 {
            part *= value;
        } else if value < part && part % 10.0 == 0.0 {
            sum += part;
            part = value;
        } else {
            return None;
        }
        end = next;
    }
    Some((end, sum + part))
}

fn measure(
    tokens: &[SpeechToken],
    from: usize,
    words: &[&str],
    at: usize,
    lexicon: &Lexicon,
    language: Language,
) -> Option<(usize, CountedNumber)> {
    let unit = |at: usize| -> Option<(usize, &'static str)> {
        let found = lexicon.at(words, at);
        let (end, sense) = found.iter().filter(|(_, sense)| sense.kind == "unit").max_by_key(|(end, _)| *end)?;
        Some((*end, sense.arg))
    };
    if let Some(named) = named_measure(lexicon, words, at) {
        return Some(named);
    }
    // *Every second press* counts presses.
    if words.get(at) == Some(&"second") && at > 0 && lexicon.at(words, at + 1).iter().any(counts_more) {
        return None;
    }
    let is = |at: usize, wanted: &[&str]| words.get(at..at + wanted.len()).is_some_and(|words| words == wanted);
    if language == Language::Japanese {
        // 半分 is a half, and no time.
        if words[at] == "半"
            && words.get(at + 1) != Some(&"分")
            && let Some((end, unit)) = unit(at + 1)
        {
            return Some((end, measured(0.5, unit)?));
        }
        if at > 0
            && words[at - 1] == "毎"
            && let Some((end, unit)) = unit(at)
        {
            return Some((end, measured(1.0, unit)?));
        }
        let (after, mut value) = number(tokens, from, words, at, lexicon)?;
        let Some((mut end, unit_of)) = unit(after) else { return Some((after, CountedNumber::Number(value))) };
        if is(end, &["半"]) && !is(end, &["半", "分"]) {
            (value, end) = (value + 0.5, end + 1);
            if words.get(end) == Some(&"間") {
                end += 1;
            }
        }
        let first = measured(value, unit_of)?;
        return Some(more_time(first, end, &|at| {
            let (after, value) = number(tokens, from, words, at, lexicon)?;
            let (end, unit) = unit(after)?;
            Some((end, measured(value, unit)?))
        }));
    }
    if is(at, &["half"]) {
        let after = if is(at + 1, &["a"]) || is(at + 1, &["an"]) { at + 2 } else { at + 1 };
        let (end, unit) = unit(after)?;
        return Some((end, measured(0.5, unit)?));
    }
    // *Another two seconds*
    if ["another", "further", "exactly", "about"].iter().any(|word| is(at, &[word])) || is(at, &["a", "further"]) {
        let after = if is(at, &["a"]) { at + 2 } else { at + 1 };
        let (end, time) = measure(tokens, from, words, after, lexicon, language)
            .or_else(|| Some((unit(after)?.0, measured(1.0, unit(after)?.1)?)))?;
        return matches!(time, CountedNumber::Time(_)).then_some((end, time));
    }
    let article = is(at, &["a"]) || is(at, &["an"]) || is(at, &["one"]);
    if is(at, &["a"]) && is(at + 1, &["second"]) && lexicon.at(words, at + 2).iter().any(is_next) {
        return None;
    }
    if article
        && let Some((end, unit)) = unit(at + 1)
        && !["times", "foot"].contains(&unit)
    {
        let half = is(end, &["and", "a", "half"]);
        return Some((if half { end + 3 } else { end }, measured(if half { 1.5 } else { 1.0 }, unit)?));
    }
    let Some((mut after, mut value)) = number(tokens, from, words, at, lexicon) else {
        // *every minute*
        let (end, unit) = unit(at)?;
        return ["s", "min", "h"].contains(&unit).then(|| measured(1.0, unit).map(|measure| (end, measure))).flatten();
    };
    if is(after, &["and", "a", "half"]) {
        (value, after) = (value + 0.5, after + 3);
    }
    let Some((end, unit_of)) = unit(after) else { return Some((after, CountedNumber::Number(value))) };
    let first = measured(value, unit_of)?;
    Some(more_time(first, end, &|at| {
        let at = if is(at, &["and"]) { at + 1 } else { at };
        let (after, value) = number(tokens, from, words, at, lexicon)?;
        let (end, unit) = unit(after)?;
        Some((end, measured(value, unit)?))
    }))
}

/// True for what is counted after *every second*.
fn counts_more((_, sense): &(usize, WritingSense)) -> bool {
    let felt = ["touch", "press", "hold", "clap", "bump"].contains(&sense.arg);
    sense.kind == "time" || sense.kind == "v" && felt
}

/// True for what may be the next one of its kind: *a second person*.
fn is_next(found: &(usize, WritingSense)) -> bool {
    matches!(found.1.kind, "who" | "whom" | "part" | "noun") || counts_more(found)
}

/// A measure that has words of its own: *a quarter of an hour*, and *a quarter*, of the battery.
fn named_measure(lexicon: &Lexicon, words: &[&str], at: usize) -> Option<(usize, CountedNumber)> {
    let found = lexicon.at(words, at);
    let longest = |kind: &str| found.iter().filter(|(_, sense)| sense.kind == kind).max_by_key(|(end, _)| *end);
    if let Some((end, sense)) = longest("span") {
        return Some((*end, CountedNumber::Time(sense.arg.parse().ok()?)));
    }
    let (end, sense) = longest("share")?;
    Some((*end, CountedNumber::Share(sense.arg.parse().ok()?)))
}

/// *1 minute 30 seconds* is one time.
fn more_time(
    first: CountedNumber,
    end: usize,
    next: &dyn Fn(usize) -> Option<(usize, CountedNumber)>,
) -> (usize, CountedNumber) {
    match (first, next(end)) {
        (CountedNumber::Time(long), Some((end, CountedNumber::Time(short)))) if short < long && long >= 60_000 => {
            (end, CountedNumber::Time(long + short))
        }
        // １ｍ５０ｃｍ
        (CountedNumber::Length(long, "m"), Some((end, CountedNumber::Length(short, "cm")))) if short < 100.0 => {
            (end, CountedNumber::Length((long * 100.0 + short).round() / 100.0, "m"))
        }
        _ => (end, first),
    }
}

/// So many of a unit.
fn measured(value: f64, unit: &'static str) -> Option<CountedNumber> {
    if !value.is_finite() || value.abs() > 1e9 {
        return None;
    }
    let time = |ms: f64| {
        let all = (value * ms).round();
        (1.0..=LONGEST_MS).contains(&all).then_some(CountedNumber::Time(all as u64))
    };
    let rounded = |value: f64| (value * 1e6).round() / 1e6;
    match unit {
        "cm" => Some(CountedNumber::Length(value, "cm")),
        "mm" => Some(CountedNumber::Length(rounded(value / 10.0), "cm")),
        "m" => Some(CountedNumber::Length(value, "m")),
        "foot" => Some(CountedNumber::Length((value * 30.48).round(), "cm")),
        "inch" => Some(CountedNumber::Length((value * 2.54).round(), "cm")),
        "ms" => time(1.0),
        "s" => time(1_000.0),
        "min" => time(60_000.0),
        "h" => time(3_600_000.0),
        "pct" => Some(CountedNumber::Share(value)),
        "tenth" => Some(CountedNumber::Share(rounded(value * 10.0))),
        "deg" => Some(CountedNumber::Angle((value.to_radians() * 1e4).round() / 1e4)),
        // 三度 is three times, 30度 an angle.
        "degtimes" if value <= 5.0 => Some(CountedNumber::Times(value)),
        "degtimes" => Some(CountedNumber::Angle((value.to_radians() * 1e4).round() / 1e4)),
        "rad" => Some(CountedNumber::Angle(value)),
        "times" => Some(CountedNumber::Times(value)),
        "people" => Some(CountedNumber::People(value)),
        "mark" => Some(CountedNumber::Mark(value)),
        _ => None,
    }
}

/// The form of an atom's sense of this kind.
pub(super) fn form(atom: &Atom, kind: &str) -> WordForm {
    atom.of(kind).map_or_else(WordForm::default, |sense| sense.form)
}
