//! Words with holes, as `words` writes them: `the {part} is touched[ for {d}]`, `is <nearer than> {n}`.

use crate::Language;
use crate::sentence::Piece;
use crate::token::{SentenceToken, tokens};
use crate::words::words;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A part of a pattern.
#[derive(Clone, Debug)]
pub(crate) enum PatternElement {
    /// Words as they are.
    Literal(Literal),
    /// Words that can be changed for their like.
    Marked(Literal),
    /// What is filled in.
    Hole(&'static str),
    /// What is told only if something in it is unusual.
    Optional(Vec<PatternElement>),
}

/// Words as they are told and as they are read.
#[derive(Clone, Debug)]
pub(crate) struct Literal {
    pub(crate) shown: &'static str,
    pub(crate) tokens: Vec<SentenceToken>,
}

/// What fills a hole: pieces, and whether they say what nobody chose.
pub(crate) struct HoleFiller {
    pub(crate) pieces: Vec<Piece>,
    pub(crate) is_default: bool,
}

/// The patterns of a language by their rules, the one that is told first.
pub(crate) struct Grammar {
    pub(crate) language: Language,
    patterns: BTreeMap<&'static str, Vec<Vec<PatternElement>>>,
    /// Words without holes, as they are read.
    phrases: BTreeMap<&'static str, Vec<SentenceToken>>,
}

static GRAMMARS: LazyLock<[Grammar; 2]> = LazyLock::new(|| Language::ALL.map(Grammar::of));

/// The grammar of a language.
pub(crate) fn grammar(language: Language) -> &'static Grammar {
    &GRAMMARS[language as usize]
}

impl Grammar {
    fn of(language: Language) -> Self {
        let rules = words(language).rules.iter().flat_map(|rules| rules.iter());
        let compiled = |says: &[&'static str]| says.iter().map(|text| elements(text, language)).collect();
        let patterns = rules.map(|(id, says)| (*id, compiled(says))).collect();
        let read = |text: &'static str| (text, tokens(text, language).into_iter().map(|placed| placed.token).collect());
        let phrases = words(language).phrases().into_iter().map(read).collect();
        Self { language, patterns, phrases }
    }

    /// Words that `Words::phrases` has, as they are read.
    pub(crate) fn phrase(&self, words: &str) -> &[SentenceToken] {
        self.phrases.get(words).map_or(&[], Vec::as_slice)
    }

    /// The patterns of a rule, the one that is told first; none if it has none.
    pub(crate) fn rule(&self, id: &str) -> &[Vec<PatternElement>] {
        self.patterns.get(id).map_or(&[], Vec::as_slice)
    }

    /// The pattern of a rule that is told.
    pub(crate) fn told(&self, id: &str) -> &[PatternElement] {
        self.rule(id).first().map_or(&[], Vec::as_slice)
    }
}

fn elements(text: &'static str, language: Language) -> Vec<PatternElement> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['{', '[', '<']) {
        let (before, from) = rest.split_at(at);
        found.extend(literal(before, language).map(PatternElement::Literal));
        let close = match from.as_bytes()[0] {
            b'{' => '}',
            b'[' => ']',
            _ => '>',
        };
        let end = from.find(close).unwrap_or(from.len());
        let inside = &from[1..end];
        match close {
            '}' => found.push(PatternElement::Hole(inside)),
            ']' => found.push(PatternElement::Optional(elements(inside, language))),
            _ => found.extend(literal(inside, language).map(PatternElement::Marked)),
        }
        rest = from.get(end + 1..).unwrap_or("");
    }
    found.extend(literal(rest, language).map(PatternElement::Literal));
    found
}

fn literal(shown: &'static str, language: Language) -> Option<Literal> {
    let tokens = tokens(shown, language).into_iter().map(|placed| placed.token).collect();
    (!shown.is_empty()).then_some(Literal { shown, tokens })
}

/// The names of the holes of a pattern.
pub(crate) fn holes(elements: &[PatternElement]) -> Vec<&'static str> {
    let hole = |element: &PatternElement| match element {
        PatternElement::Hole(name) => vec![*name],
        PatternElement::Optional(inside) => holes(inside),
        PatternElement::Literal(_) | PatternElement::Marked(_) => Vec::new(),
    };
    elements.iter().flat_map(hole).collect()
}

/// The words that can be changed for their like.
pub(crate) fn marked(elements: &[PatternElement]) -> Option<&'static str> {
    elements.iter().find_map(|element| match element {
        PatternElement::Marked(words) => Some(words.shown),
        PatternElement::Literal(_) | PatternElement::Hole(_) | PatternElement::Optional(_) => None,
    })
}

/// A pattern with its holes filled; a hole that nothing fills makes it none.
pub(crate) fn filled(
    elements: &[PatternElement],
    fill: &mut dyn FnMut(&str) -> Option<HoleFiller>,
    mark: &mut dyn FnMut(&str) -> Piece,
) -> Option<HoleFiller> {
    let mut all = HoleFiller { pieces: Vec::new(), is_default: true };
    for element in elements {
        match element {
            PatternElement::Literal(words) => all.pieces.push(Piece::Text(words.shown.to_owned())),
            PatternElement::Marked(words) => all.pieces.push(mark(words.shown)),
            PatternElement::Hole(name) => {
                let filling = fill(name)?;
                all.is_default &= filling.is_default;
                all.pieces.extend(filling.pieces);
            }
            PatternElement::Optional(inside) => {
                let filling = filled(inside, fill, mark)?;
                if !filling.is_default {
                    all.pieces.extend(filling.pieces);
                }
            }
        }
    }
    Some(all)
}
