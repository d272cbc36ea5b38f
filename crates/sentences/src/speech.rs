//! What people say, understood: words by what they mean, clauses by what they tell, sentences by how clauses hang together.
//!
//! A text is cut into tokens, those into atoms with all that they may mean, those into clauses by a chart of what each of
//! them costs. Every word is used, or is in doubt.

mod act;
mod assemble;
mod atoms;
mod clause;
mod clocks;
mod frames;
mod lexicon;
pub(crate) mod meaning;
mod never;
mod phrases;
mod segments;
mod tokens;
mod turned;
mod unsure;

pub use lexicon::Lexicon;

pub(crate) use assemble::{ended, own_event};

use crate::Language;
use assemble::SaidSoFar;
use atoms::{Atom, atoms};
use clocks::with_times;
use meaning::{MeantRule, SensedEvent, TouchPhase, TouchedPart, VagueWord};
use std::ops::Range;
use tokens::{SpeechTokenKind, tokens};
use turned::turned;

/// What was said.
#[derive(Debug, Default)]
pub(crate) struct UnderstoodSpeech {
    pub(crate) rules: Vec<MeantRule>,
    /// The bytes of each token.
    pub(crate) places: Vec<Range<usize>>,
    /// Words in doubt, by their bytes, with why and what could stand there instead.
    pub(crate) doubts: Vec<(Range<usize>, Vec<String>, Option<&'static str>)>,
    /// Words that are known, by their bytes.
    known: Vec<Range<usize>>,
    /// Words that were taken as a text.
    pub(crate) texts: Vec<Range<usize>>,
    /// Words that got a number because nobody said one, by their bytes.
    pub(crate) vague: Vec<(Range<usize>, VagueWord)>,
}

/// The most tokens that are read.
const TOKENS_MAX: usize = 400;

/// Understands a text.
pub(crate) fn understood(text: &str, language: Language, lexicon: &Lexicon) -> UnderstoodSpeech {
    let mut speech = heard(text, language, lexicon);
    suggest(text, language, lexicon, &mut speech);
    speech
}

fn heard(text: &str, language: Language, lexicon: &Lexicon) -> UnderstoodSpeech {
    let all = tokens(text, language);
    let mut speech = UnderstoodSpeech {
        places: all.iter().map(|token| token.range.clone()).collect(),
        ..UnderstoodSpeech::default()
    };
    let bytes = |span: &Range<usize>| {
        let first = all.get(span.start).map_or(text.len(), |token| token.range.start);
        let last = all.get(span.end.max(span.start + 1) - 1).map_or(first, |token| token.range.end);
        first..last.max(first)
    };
    if all.len() > TOKENS_MAX {
        speech.doubts.push((bytes(&(TOKENS_MAX..all.len())), Vec::new(), None));
        return speech;
    }
    let source = |span: &Range<usize>| text.get(bytes(span)).unwrap_or_default().to_owned();
    let mut said = SaidSoFar::default();
    let mut spans: Vec<(Range<usize>, Option<&'static str>)> = Vec::new();
    let mut known: Vec<Range<usize>> = Vec::new();
    let mut unsure = unsure::UnsureWords::new();
    let mut manners: Vec<Range<usize>> = Vec::new();
    // *!head touched*: the sign may deny it.
    if all.first().is_some_and(|token| token.what == SpeechTokenKind::Sign('!')) && all.len() > 1 {
        spans.push((0..1, None));
    }
    let mut at = 0;
    while at < all.len() {
        let stops = |end: usize| {
            matches!(all[end].what, SpeechTokenKind::Sign('.' | '!' | '?' | ';')) || parts_arrows(&all, at, end)
        };
        let end = (at..all.len()).find(|end| stops(*end)).unwrap_or(all.len());
        let plain = with_times(atoms(&all, at, end, lexicon, language), language);
        let asks = all.get(end).is_some_and(|token| token.what == SpeechTokenKind::Sign('?'));
        unsure.extend(unsure::unsure(&plain, language, asks));
        let part = turned(plain, language);
        if !part.is_empty() {
            said.spoken_of = spoken_of(&all[..end], lexicon, language, said.spoken_of);
            let cover = segments::cover(&part, language, asks, &source);
            manners.extend(part.iter().filter(|atom| atom.is("manner", "")).map(|atom| atom.span.clone()));
            known.extend(part.iter().filter(|atom| !atom.is_unknown()).map(|atom| bytes(&atom.span)));
            for doubt in cover.doubts {
                let part_of_body = || touches_nowhere(&part, &doubt).then(|| lexicon.gap("touched")).flatten();
                spans.push((doubt.clone(), why(&part, &doubt, lexicon).or_else(part_of_body)));
            }
            unsure.extend(unsure::unquoted(&part, &cover.texts));
            speech.texts.extend(cover.texts.iter().map(bytes));
            said.sentence(&cover.segments, &(at..end));
        }
        at = end + 1;
    }
    // What cannot be done is to blame before anything else.
    if spans.iter().any(|(_, why)| why.is_some()) {
        spans.retain(|(_, why)| why.is_some());
    } else {
        spans.extend(said.doubts.iter().cloned().map(|span| (span, None)));
        // Only where all the rest is clear: other words may say more of it.
        if spans.is_empty() {
            unsure.append(&mut said.unsure);
            spans.extend(unsure.into_iter().map(|(span, why)| (span, Some(lexicon.gap(why).unwrap_or_default()))));
            spans.extend(said.never.iter().cloned().map(|span| (span, Some(lexicon.never()))));
        }
    }
    for (span, why) in &mut spans {
        if why.is_none() && manners.contains(span) {
            *why = lexicon.gap("manner");
        }
    }
    let offers = |why: &Option<&'static str>| {
        why.and_then(|why| lexicon.offer(why)).map(str::to_owned).into_iter().collect::<Vec<_>>()
    };
    speech.doubts = spans.iter().map(|(span, why)| (bytes(span), offers(why), *why)).collect();
    if speech.doubts.is_empty() && (said.is_missing || said.rules.is_empty()) {
        speech.doubts.push((text.len()..text.len(), Vec::new(), None));
    }
    speech.known = known;
    for rule in &said.rules {
        for cond in rule.event.iter().chain(&rule.states).chain(&rule.until) {
            let Some(vague) = &cond.vague else { continue };
            let range = bytes(&vague.span);
            if !speech.vague.iter().any(|(known, _)| *known == range) {
                speech.vague.push((range, vague.clone()));
            }
        }
    }
    speech.rules = said.rules;
    speech
}

/// True for the comma of *head touched -> wave, hand touched -> sit*: a sign that leads to what is done stands before and
/// after it.
fn parts_arrows(all: &[tokens::SpeechToken], from: usize, at: usize) -> bool {
    let is_sign = |token: &tokens::SpeechToken, sign: char| token.what == SpeechTokenKind::Sign(sign);
    let is_arrow = |at: usize| {
        let before = at.checked_sub(1).map_or(0, |before| all[before].range.end);
        is_sign(&all[at], ':') && before < all[at].range.start
    };
    let next = (at + 1..all.len()).find(|next| matches!(all[*next].what, SpeechTokenKind::Sign(_)));
    is_sign(&all[at], ',') && (from..at).any(is_arrow) && next.is_some_and(is_arrow)
}

/// Why words in doubt cannot be done, if they mean something.
fn why(atoms: &[Atom], span: &Range<usize>, lexicon: &Lexicon) -> Option<&'static str> {
    let atom = atoms.iter().find(|atom| atom.span == *span)?;
    let is_gap =
        atom.senses.iter().all(|sense| matches!(sense.kind, "gap" | "vague" | "daypart") || sense.arg == "ongoing");
    let sense = atom.of("gap").or_else(|| atom.of("vague")).filter(|_| is_gap);
    match sense {
        Some(sense) => Some(lexicon.gap(sense.arg).unwrap_or("")),
        // A colour that no sense has.
        None => atom.of("color").and_then(|_| lexicon.gap("eyes")),
    }
}

/// True if words in doubt tell of a touch, and no words say what is touched: *each tap*.
fn touches_nowhere(atoms: &[Atom], span: &Range<usize>) -> bool {
    let touches = |atom: &Atom| {
        let inside = span.start <= atom.span.start && atom.span.end <= span.end;
        inside && (atom.is("v", "touch") || atom.is("noun", "touch")) && !atom.is("v", "see")
    };
    let names = |atom: &Atom| {
        atom.is_unknown() || ["part", "it", "gap"].iter().any(|kind| atom.is(kind, "")) || atom.is("noun", "button")
    };
    atoms.iter().any(touches) && !atoms.iter().any(names)
}

/// The parts of the body that texts speak of: “touch my hand”.
fn spoken_of(
    all: &[tokens::SpeechToken],
    lexicon: &Lexicon,
    language: Language,
    mut known: Vec<SensedEvent>,
) -> Vec<SensedEvent> {
    for token in all {
        let SpeechTokenKind::Quote(text) = &token.what else { continue };
        let inside = tokens(text, language);
        if inside.len() > TOKENS_MAX {
            continue;
        }
        for atom in atoms(&inside, 0, inside.len(), lexicon, language) {
            let device = match atom.of("part").map(|sense| sense.arg) {
                Some("hand") => TouchedPart::Hand,
                Some("head") => TouchedPart::Head,
                Some("foot") => TouchedPart::Foot,
                _ => continue,
            };
            let event = SensedEvent::Touch(device, Vec::new(), TouchPhase::Begins);
            if !known.contains(&event) {
                known.push(event);
            }
        }
    }
    known
}

/// Suggests words for those that look like slips: those with which more of the rest is understood. Where slips were all
/// that was wrong, only they stay in doubt.
fn suggest(text: &str, language: Language, lexicon: &Lexicon, speech: &mut UnderstoodSpeech) {
    const TRIED_MAX: usize = 12;
    // A text is read again with each word: a long one with fewer of them.
    const READ_TOKENS_MAX: usize = 400;
    let tried_max = (READ_TOKENS_MAX / speech.places.len().max(1)).clamp(2, TRIED_MAX);
    let mut tried = 0;
    let mut mended = text.to_owned();
    let mut left = speech.doubts.len();
    for at in (0..speech.doubts.len()).rev() {
        let (range, _, why) = speech.doubts[at].clone();
        if why.is_some() || range.is_empty() || speech.known.contains(&range) {
            continue;
        }
        // A Japanese verb has its known beginning before the slip: 押しらた.
        let before = speech.known.iter().find(|before| before.end == range.start);
        let starts = match (language, before) {
            (Language::Japanese, Some(before)) => vec![range.start, before.start],
            _ => vec![range.start],
        };
        let whole = range.clone();
        // A slip may reach into words that are known: おじきをする.
        let rest = text[whole.end..].find(['、', '。', '，', ',']).map_or(text.len(), |length| whole.end + length);
        let ends =
            if language == Language::Japanese && rest > whole.end { vec![rest, whole.end] } else { vec![whole.end] };
        let ranges = ends.iter().flat_map(|end| starts.iter().map(move |start| *start..*end));
        for range in ranges {
            let Some(words) = text.get(range.clone()) else { continue };
            // Doubts may overlap: what was mended is not mended again.
            if mended.get(range.clone()) != Some(words) {
                continue;
            }
            let like = match language {
                Language::English => lexicon.like(&words.to_lowercase()),
                Language::Japanese => lexicon.inflected_like(words),
            };
            let (mut good, mut hidden) = (Vec::new(), Vec::new());
            let mut best = left;
            let mut best_text = None;
            for word in like {
                tried += 1;
                if tried > tried_max {
                    break;
                }
                let mut other = mended.clone();
                other.replace_range(range.clone(), &word);
                let doubts = heard(&other, language, lexicon).doubts;
                let again = doubts.len();
                if again < left {
                    // A word for what cannot be done hides what else is in doubt.
                    if doubts.iter().any(|(.., why)| why.is_some()) {
                        hidden.push(word);
                    } else if again < best {
                        (best, best_text) = (again, Some(other));
                        good.insert(0, word);
                    } else {
                        good.push(word);
                    }
                }
            }
            good.append(&mut hidden);
            if good.is_empty() {
                continue;
            }
            if let Some(other) = best_text {
                (mended, left) = (other, best);
            }
            (speech.doubts[at].0, speech.doubts[at].1) = (range, good);
            break;
        }
    }
    if left == 0 && speech.doubts.iter().any(|(_, good, _)| !good.is_empty()) {
        speech.doubts.retain(|(_, good, _)| !good.is_empty());
    }
}
