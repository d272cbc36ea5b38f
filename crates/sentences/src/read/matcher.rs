//! Words of rules found in a text, in every way in which they fit there.

use super::tree::{HoleFilling, SaidWords};
use crate::Language;
use crate::does::CHANCES_MAX;
use crate::pattern::{Grammar, PatternElement, grammar};
use crate::token::{Placed, SentenceToken};
use crate::words::{ChosenWords, LanguageWords, words};
use behaviour::RATE_MS;
use robot::{Device, ParamKind};
use std::cell::{Cell, RefCell};

/// The most steps of one reading: a few milliseconds.
const FUEL: u32 = 400_000;
/// The most words of a text without quotes.
const PLAIN_TEXT_MAX: usize = 12;
/// Before which a text without quotes ends.
const PLAIN_TEXT_END: &str = "and";
/// The most that is remembered of what might have stood where reading ended.
const EXPECTED_MAX: usize = 200;

/// Something that fits, and the token after it.
pub(super) type Fits<T> = Vec<(T, usize)>;
type Holes = Vec<(&'static str, HoleFilling)>;

/// A text with its tokens, and how far it was understood.
pub(super) struct Matcher<'t> {
    pub(super) text: &'t str,
    pub(super) tokens: &'t [Placed],
    pub(super) grammar: &'static Grammar,
    pub(super) words: &'static LanguageWords,
    fuel: Cell<u32>,
    /// The first token that fitted nothing.
    pub(super) furthest: Cell<usize>,
    /// The token of which it is remembered what could stand there.
    asks: Option<usize>,
    /// Whether the words here come after what could be anything, and so are not missed.
    guesses: Cell<bool>,
    /// What could stand there: the next word and all that follows it.
    expected: RefCell<Vec<(String, String)>>,
    /// What could stand there in other words than those that are told.
    others: RefCell<Vec<(String, String)>>,
    is_other: Cell<bool>,
}

impl<'t> Matcher<'t> {
    pub(super) fn new(text: &'t str, tokens: &'t [Placed], language: Language, asks: Option<usize>) -> Self {
        Self {
            text,
            tokens,
            grammar: grammar(language),
            words: words(language),
            fuel: Cell::new(FUEL),
            furthest: Cell::new(0),
            asks,
            guesses: Cell::new(false),
            expected: RefCell::default(),
            others: RefCell::default(),
            is_other: Cell::new(false),
        }
    }

    pub(super) fn token(&self, at: usize) -> Option<&SentenceToken> {
        self.tokens.get(at).map(|placed| &placed.token)
    }

    pub(super) fn is_sign(&self, at: usize, sign: char) -> bool {
        self.token(at) == Some(&SentenceToken::Sign(sign))
    }

    /// The token after a comma, if there is one.
    pub(super) fn after_comma(&self, at: usize) -> usize {
        if self.is_sign(at, ',') { at + 1 } else { at }
    }

    /// Whether there is time left.
    pub(super) fn goes_on(&self) -> bool {
        self.fuel.set(self.fuel.get().saturating_sub(1));
        self.fuel.get() > 0
    }

    /// What a rule says at a token, in every way; holes that stand for parts of sentences are asked of `part`.
    pub(super) fn rule(
        &self,
        rule: &'static str,
        at: usize,
        device: Option<&'static Device>,
        part: MatchedParts,
    ) -> Fits<SaidWords> {
        let mut fits = Vec::new();
        for (number, pattern) in self.grammar.rule(rule).iter().enumerate() {
            self.is_other.set(number > 0);
            for (holes, end) in self.elements(pattern, at, device, part) {
                fits.push((SaidWords { rule, holes, span: at..end }, end));
            }
        }
        fits
    }

    fn elements(
        &self,
        elements: &[PatternElement],
        at: usize,
        device: Option<&'static Device>,
        part: MatchedParts,
    ) -> Fits<Holes> {
        if !self.goes_on() {
            return Vec::new();
        }
        let Some((first, rest)) = elements.split_first() else { return vec![(Vec::new(), at)] };
        let with = |holes: &Holes, end: usize| {
            let joined = |(more, end): (Holes, usize)| (holes.iter().cloned().chain(more).collect(), end);
            let guessed = self.guesses.get();
            self.guesses.set(guessed || holes.iter().any(|(_, bound)| matches!(bound, HoleFilling::Plain(_))));
            let fits = self.elements(rest, end, device, part).into_iter().map(joined).collect::<Vec<_>>();
            self.guesses.set(guessed);
            fits
        };
        match first {
            PatternElement::Literal(words) | PatternElement::Marked(words) => {
                let Some(end) = self.literal(&words.tokens, at, rest) else { return Vec::new() };
                self.elements(rest, end, device, part)
            }
            PatternElement::Optional(inside) => {
                let within = self.elements(inside, at, device, part);
                let mut fits: Fits<Holes> = within.iter().flat_map(|(holes, end)| with(holes, *end)).collect();
                fits.extend(self.elements(rest, at, device, part));
                fits
            }
            PatternElement::Hole(name) => {
                let found = self.hole(name, at, device, part, rest);
                found.into_iter().flat_map(|(bound, end)| with(&vec![(*name, bound)], end)).collect()
            }
        }
    }

    /// The token after these words, if they stand there.
    fn literal(&self, words: &[SentenceToken], at: usize, rest: &[PatternElement]) -> Option<usize> {
        for (number, word) in words.iter().enumerate() {
            if self.token(at + number) != Some(word) {
                // A comma that is missing is no mistake.
                if *word == SentenceToken::Sign(',') && number + 1 == words.len() {
                    return Some(at + number);
                }
                self.expect(at + number, || (shown(word), join(&words[number..], rest, self)));
                return None;
            }
        }
        Some(at + words.len())
    }

    /// Remembers what could stand at a token.
    fn expect(&self, at: usize, what: impl FnOnce() -> (String, String)) {
        if self.guesses.get() {
            return;
        }
        self.furthest.set(at.max(self.furthest.get()));
        let mut list = if self.is_other.get() { self.others.borrow_mut() } else { self.expected.borrow_mut() };
        if self.asks == Some(at) && list.len() < EXPECTED_MAX {
            let what = what();
            if !what.0.is_empty() && !list.contains(&what) {
                list.push(what);
            }
        }
    }

    /// What could stand at the token that was asked for: the next word, and all that follows it; in the order of the
    /// grammar, the words that are told before the others.
    pub(super) fn expected(&self) -> Vec<(String, String)> {
        [self.expected.take(), self.others.take()].concat()
    }

    fn hole(
        &self,
        name: &str,
        at: usize,
        device: Option<&'static Device>,
        part: MatchedParts,
        rest: &[PatternElement],
    ) -> Fits<HoleFilling> {
        let param = device.and_then(|device| device.params.iter().find(|param| param.name == name));
        match (name, param.map(|param| param.kind)) {
            (_, Some(ParamKind::Choice(_))) => self.choice(name, at, device, rest),
            (_, Some(ParamKind::Number { unit: "ms", .. })) | ("d" | "every", None) => self.duration(at),
            (_, Some(ParamKind::Number { .. })) | ("n", None) => self.number(at),
            (_, Some(ParamKind::Text { .. })) | ("text", None) => self.plain_text(at),
            ("quoted" | "name" | "helper", None) => match self.token(at) {
                Some(SentenceToken::Quoted(text)) => vec![(HoleFilling::Text(text.clone()), at + 1)],
                _ => Vec::new(),
            },
            ("texts", None) => self.texts(at),
            ("code" | "start", None) => match self.token(at) {
                Some(SentenceToken::Code(text)) => vec![(HoleFilling::Text(text.clone()), at + 1)],
                _ => Vec::new(),
            },
            ("field", None) => self.field(at),
            _ => part(name, at),
        }
    }

    /// Several texts with “or” between them.
    fn texts(&self, at: usize) -> Fits<HoleFilling> {
        let (mut texts, mut end) = (Vec::new(), at);
        while let Some(SentenceToken::Quoted(text)) = self.token(end)
            && texts.len() < CHANCES_MAX
        {
            texts.push(text.clone());
            end += 1;
            match self
                .words_at(self.words.or, end)
                .filter(|next| matches!(self.token(*next), Some(SentenceToken::Quoted(_))))
            {
                Some(next) => end = next,
                None => break,
            }
        }
        if texts.len() < 2 { Vec::new() } else { vec![(HoleFilling::Texts(texts), end)] }
    }

    fn choice(
        &self,
        name: &str,
        at: usize,
        device: Option<&'static Device>,
        rest: &[PatternElement],
    ) -> Fits<HoleFilling> {
        let device = device.map_or("", |device| device.name);
        let mut fits = self.chosen(self.words.choices(device, name), at, rest);
        if name == "target" {
            let it = self.words.rule("target.it").first().map_or("", |it| it);
            if let Some(end) = self.words_at(it, at) {
                fits.push((HoleFilling::It, end));
            }
        }
        fits
    }

    /// Those of several whose words stand there, the longest words first.
    fn chosen(&self, known: &'static [ChosenWords], at: usize, rest: &[PatternElement]) -> Fits<HoleFilling> {
        let mut fits: Fits<HoleFilling> = Vec::new();
        for (value, says) in known {
            let ends = says.iter().filter_map(|words| self.words_at(words, at));
            match ends.max() {
                Some(end) => fits.push((HoleFilling::Chosen(value), end)),
                None => {
                    if let Some(words) = says.first() {
                        self.expect(at, || ((*words).to_owned(), format!("{words}{}", join(&[], rest, self))));
                    }
                }
            }
        }
        fits.sort_by_key(|(_, end)| std::cmp::Reverse(*end));
        fits
    }

    /// The token after these words, if they stand there.
    pub(super) fn words_at(&self, words: &str, at: usize) -> Option<usize> {
        let wanted = self.grammar.phrase(words);
        let fits = wanted.iter().enumerate().all(|(number, word)| self.token(at + number) == Some(word));
        fits.then_some(at + wanted.len())
    }

    fn field(&self, at: usize) -> Fits<HoleFilling> {
        if let Some(SentenceToken::Quoted(name)) = self.token(at) {
            return vec![(HoleFilling::Text(name.clone()), at + 1)];
        }
        let known = self.chosen(self.words.fields, at, &[]);
        known.into_iter().collect()
    }

    fn number(&self, at: usize) -> Fits<HoleFilling> {
        let Some(SentenceToken::Number(number)) = self.token(at) else {
            self.expect(at, || ("1".to_owned(), "1".to_owned()));
            return Vec::new();
        };
        let mut fits: Fits<HoleFilling> = Vec::new();
        for (unit, says) in self.words.units {
            let end = says.iter().filter_map(|words| self.words_at(words, at + 1)).max();
            fits.extend(end.map(|end| (HoleFilling::Number(*number, Some(unit)), end)));
        }
        fits.sort_by_key(|(_, end)| std::cmp::Reverse(*end));
        fits.push((HoleFilling::Number(*number, None), at + 1));
        fits
    }

    fn duration(&self, at: usize) -> Fits<HoleFilling> {
        let (count, from) = match self.token(at) {
            Some(SentenceToken::Number(count)) => (*count, at + 1),
            _ => (1.0, at),
        };
        let mut best: Option<(u64, usize)> = None;
        for (size, one, several, others) in self.words.durations {
            let says = [*one, *several].into_iter().chain(others.iter().copied());
            if let Some(end) = says.filter_map(|words| self.words_at(words, from)).max()
                && best.is_none_or(|(_, longest)| end > longest)
            {
                best = Some((*size, end));
            }
        }
        if best.is_none() {
            self.expect(at, || (self.usual_duration(), self.usual_duration()));
        }
        let kept = |(size, end): (u64, usize)| {
            let period = (count * size as f64).round();
            RATE_MS.contains(&(period as u64)).then_some((HoleFilling::Duration(period as u64), end))
        };
        best.and_then(kept).into_iter().collect()
    }

    /// A duration to suggest.
    fn usual_duration(&self) -> String {
        let second = self.words.durations.iter().find(|(size, ..)| *size == 1_000);
        format!("1 {}", second.map_or("", |(_, one, ..)| one))
    }

    /// A text, with or without quotes; without, in every length, the shortest first.
    fn plain_text(&self, at: usize) -> Fits<HoleFilling> {
        if let Some(SentenceToken::Quoted(text)) = self.token(at) {
            return vec![(HoleFilling::Text(text.clone()), at + 1)];
        }
        let is_word = |token: &SentenceToken| match token {
            SentenceToken::Word(word) => word != PLAIN_TEXT_END,
            SentenceToken::Number(_) => true,
            SentenceToken::Quoted(_) | SentenceToken::Code(_) | SentenceToken::Sign(_) | SentenceToken::Either(..) => {
                false
            }
        };
        let rest = self.tokens.get(at..).unwrap_or_default();
        let count = rest.iter().take(PLAIN_TEXT_MAX).take_while(|placed| is_word(&placed.token)).count();
        let text = |count: usize| {
            let (first, last) = (rest.first()?, rest.get(count - 1)?);
            Some((HoleFilling::Plain(self.text.get(first.range.start..last.range.end)?.to_owned()), at + count))
        };
        (1..=count).filter_map(text).collect()
    }
}

/// What parts of sentences stand at a token, by the name of their hole.
pub(super) type MatchedParts<'p> = &'p dyn Fn(&str, usize) -> Fits<HoleFilling>;

/// No parts of sentences.
pub(super) fn no_parts(_: &str, _: usize) -> Fits<HoleFilling> {
    Vec::new()
}

fn shown(token: &SentenceToken) -> String {
    match token {
        SentenceToken::Word(word) => word.clone(),
        SentenceToken::Number(number) => number.to_string(),
        SentenceToken::Sign(_) | SentenceToken::Quoted(_) | SentenceToken::Code(_) | SentenceToken::Either(..) => {
            String::new()
        }
    }
}

/// The rest of a pattern as words that could stand there.
fn join(words: &[SentenceToken], rest: &[PatternElement], matcher: &Matcher) -> String {
    let is_english = matcher.grammar.language == Language::English;
    let between = if is_english { " " } else { "" };
    let mut all = words.iter().map(shown).collect::<Vec<_>>().join(between);
    for element in rest {
        match element {
            PatternElement::Literal(words) | PatternElement::Marked(words) => all.push_str(words.shown),
            PatternElement::Hole("d" | "every") => {
                if is_english && !all.ends_with(' ') {
                    all.push(' ');
                }
                all.push_str(&matcher.usual_duration());
            }
            PatternElement::Hole("n") => all.push_str(if is_english { " 1" } else { "1 " }),
            PatternElement::Hole(_) => break,
            PatternElement::Optional(_) => {}
        }
    }
    all.trim().to_owned()
}
