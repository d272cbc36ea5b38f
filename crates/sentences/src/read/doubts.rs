//! Words that were not understood: what could stand there instead, tried out.

use super::draft::Doubt;
use super::matcher::Matcher;
use super::parse::SentenceParser;
use super::tree::ToldSentence;
use crate::Language;
use crate::token::{Placed, SentenceToken, tokens};
use crate::words::words;

/// The most doubts of a text.
const DOUBTS_MAX: usize = 4;
/// The most suggestions of a doubt.
const SUGGESTIONS_MAX: usize = 3;
/// The most that is tried in place of words that were not understood.
const TRIED_MAX: usize = 12;

/// A text as it is understood, with something else in place of what is not.
pub(super) struct Repaired {
    pub(super) told: Vec<ToldSentence>,
    pub(super) tokens: Vec<Placed>,
    pub(super) doubts: Vec<Doubt>,
}

/// How a text was read.
struct ReadText {
    told: Vec<ToldSentence>,
    is_whole: bool,
    furthest: usize,
}

/// Something that was tried in place of so many tokens.
struct TokenTrial {
    words: String,
    tokens: Vec<Placed>,
    read: ReadText,
}

fn read(text: &str, tokens: &[Placed], language: Language) -> ReadText {
    let matcher = Matcher::new(text, tokens, language, None);
    let (told, is_whole) = SentenceParser::new(&matcher).sentences();
    ReadText { told, is_whole, furthest: matcher.furthest.get() }
}

/// What could stand at a token: the next word, and all that follows it, in the order of the grammar.
fn expected(text: &str, tokens: &[Placed], at: usize, language: Language) -> Vec<(String, String)> {
    let matcher = Matcher::new(text, tokens, language, Some(at));
    drop(SentenceParser::new(&matcher).sentences());
    matcher.expected()
}

impl ReadText {
    /// How many tokens were not understood.
    fn left(&self, tokens: &[Placed]) -> usize {
        if self.is_whole { 0 } else { 1 + tokens.len().saturating_sub(self.furthest) }
    }
}

/// Reads a text that is understood as it is, to its end.
pub(super) fn exact(text: &str, tokens: Vec<Placed>, language: Language) -> Option<Repaired> {
    if tokens.iter().any(|placed| matches!(placed.token, SentenceToken::Either(..))) {
        return None;
    }
    let read = read(text, &tokens, language);
    read.is_whole.then_some(Repaired { told: read.told, tokens, doubts: Vec::new() })
}

/// Reads a text; where it is not understood, with the best that could stand there.
pub(super) fn repaired(text: &str, tokens: Vec<Placed>, language: Language) -> Repaired {
    let mut tokens = tokens;
    let mut doubts = in_two_ways(&mut tokens);
    let mut read = read(text, &tokens, language);
    while !read.is_whole && !tokens.is_empty() && doubts.len() < DOUBTS_MAX {
        let (length, trials) = best_trials(text, &tokens, &read, language);
        let at = read.furthest.min(tokens.len());
        let is_at_end = at == tokens.len();
        let range = place(text, &tokens, at, length.unwrap_or(1));
        let suggestions = trials.iter().map(|trial| spaced(&trial.words, text, &range, language)).collect();
        doubts.push(Doubt { range, suggestions, why: None });
        let Some(best) = trials.into_iter().next() else { break };
        (tokens, read) = (best.tokens, best.read);
        // Only the next words are guessed, not the rest of the sentence.
        if is_at_end {
            break;
        }
    }
    Repaired { told: read.told, tokens, doubts }
}

/// Asks about every number that may be read in two ways; until somebody says which, the first stands there in doubt.
fn in_two_ways(tokens: &mut [Placed]) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    for placed in tokens {
        if let SentenceToken::Either(one, other) = placed.token {
            let suggestions = [one, other].map(crate::numbers::written).into();
            doubts.push(Doubt { range: placed.range.clone(), suggestions, why: None });
            *placed = Placed { token: SentenceToken::Number(one), range: placed.range.clone(), is_doubtful: true };
        }
    }
    doubts
}

/// The bytes of so many tokens, or the place before one.
fn place(text: &str, tokens: &[Placed], at: usize, length: usize) -> std::ops::Range<usize> {
    let start = tokens.get(at).map_or(text.trim_end().len(), |placed| placed.range.start);
    if length == 0 || at >= tokens.len() {
        return start..start;
    }
    let end = tokens.get(at + length - 1).or(tokens.last()).map_or(start, |placed| placed.range.end);
    start..end.max(start)
}

/// A suggestion with a space before it where it follows a word.
fn spaced(words: &str, text: &str, range: &std::ops::Range<usize>, language: Language) -> String {
    let follows = text[..range.start].chars().next_back().is_some_and(|c| !c.is_whitespace());
    let is_missing = range.is_empty() && language == Language::English;
    if !is_missing {
        words.to_owned()
    } else if follows {
        format!(" {words}")
    } else {
        words.to_owned() + if range.start < text.trim_end().len() { " " } else { "" }
    }
}

/// For how many tokens something else makes the text understood, and what, the best first.
fn best_trials(
    text: &str,
    tokens: &[Placed],
    before: &ReadText,
    language: Language,
) -> (Option<usize>, Vec<TokenTrial>) {
    let at = before.furthest.min(tokens.len());
    let is_word = |placed: &&Placed| {
        matches!(placed.token, SentenceToken::Word(_) | SentenceToken::Number(_) | SentenceToken::Quoted(_))
    };
    let following = tokens[at..].iter().take(8).take_while(is_word).count();
    let lengths = (1..=following.min(if language == Language::English { 3 } else { 8 })).chain([0]);
    let candidates = candidates(tokens, at, &expected(text, tokens, at, language), language);
    let mut best: (usize, Option<usize>, Vec<TokenTrial>) = (before.left(tokens), None, Vec::new());
    for length in lengths {
        let is_at_end = at == tokens.len();
        let helps = |trial: &TokenTrial| {
            let goes_on = is_at_end && trial.read.furthest >= trial.tokens.len();
            trial.read.left(&trial.tokens) < best.0 || goes_on
        };
        let mut trials: Vec<TokenTrial> = Vec::new();
        for words in &candidates {
            trials.extend(Some(trial(text, tokens, at, length, words, language)).filter(helps));
            if trials.iter().filter(|trial| trial.read.is_whole).count() == SUGGESTIONS_MAX {
                break;
            }
        }
        trials.sort_by_key(|trial| trial.read.left(&trial.tokens));
        if let Some(first) = trials.first() {
            let left = first.read.left(&first.tokens);
            trials.truncate(SUGGESTIONS_MAX);
            best = (left, Some(length), trials);
        }
        if best.0 == 0 {
            break;
        }
    }
    (best.1, best.2)
}

fn trial(text: &str, before: &[Placed], at: usize, length: usize, replaced: &str, language: Language) -> TokenTrial {
    let range = place(text, before, at, length);
    let instead = tokens(replaced, language).into_iter();
    let instead = instead.map(|placed| Placed { range: range.clone(), is_doubtful: true, ..placed });
    let mut tokens = before.to_vec();
    tokens.splice(at..(at + length).min(before.len()), instead);
    let read = read(text, &tokens, language);
    TokenTrial { words: replaced.to_owned(), tokens, read }
}

/// What could stand at a token, the likeliest first: what is written nearly so, what is meant by it, what the grammar
/// expects.
fn candidates(tokens: &[Placed], at: usize, expected: &[(String, String)], language: Language) -> Vec<String> {
    let here = match tokens.get(at).map(|placed| &placed.token) {
        Some(SentenceToken::Word(word)) => word.as_str(),
        _ => "",
    };
    let mut near: Vec<(usize, &str)> = Vec::new();
    for (next, _) in expected {
        let far = distance(here, next);
        if !here.is_empty() && far * 3 <= next.chars().count().max(3) && far > 0 && here.chars().count() > 2 {
            near.push((far, next));
        }
    }
    near.sort_by_key(|(far, _)| *far);
    let hints = words(language).hints.iter().filter(|(known, _)| begins(tokens, at, known, language));
    let hinted = hints.flat_map(|(_, says)| says.iter().copied());
    let expected = expected.iter().map(|(_, rest)| rest.as_str());
    let mut all: Vec<String> = Vec::new();
    for words in near.into_iter().map(|(_, word)| word).chain(hinted).chain(expected) {
        if !words.is_empty() && all.len() < TRIED_MAX && !all.iter().any(|known| known == words) {
            all.push(words.to_owned());
        }
    }
    all
}

/// Whether the words of a hint stand at a token.
fn begins(before: &[Placed], at: usize, hint: &str, language: Language) -> bool {
    let wanted = tokens(hint, language);
    wanted
        .iter()
        .enumerate()
        .all(|(number, one)| before.get(at + number).is_some_and(|placed| placed.token == one.token))
}

/// By how many letters two words differ: left out, added, another, or two in the wrong order.
fn distance(one: &str, other: &str) -> usize {
    let (one, other): (Vec<char>, Vec<char>) = (one.chars().collect(), other.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=other.len()).collect()];
    for (at, c) in one.iter().enumerate() {
        let mut row = vec![at + 1];
        for (to, d) in other.iter().enumerate() {
            let another = rows[at][to] + usize::from(c != d);
            let swaps = at > 0 && to > 0 && other[to - 1] == *c && one[at - 1] == *d;
            let swapped = if swaps { rows[at - 1][to - 1] + 1 } else { another };
            row.push(another.min(swapped).min(rows[at][to + 1] + 1).min(row[to] + 1));
        }
        rows.push(row);
    }
    rows[one.len()][other.len()]
}
