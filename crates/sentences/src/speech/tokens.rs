//! A typed text as tokens with their places: words in English, letters in Japanese, numbers, quotes and signs.

use crate::Language;
use behaviour::{TypedNumber, number_at};
use std::ops::Range;

/// A token and its bytes in the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SpeechToken {
    pub(super) what: SpeechTokenKind,
    pub(super) range: Range<usize>,
}

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum SpeechTokenKind {
    /// A word in lower case; of Japanese, one letter.
    Word(String),
    Number(f64),
    /// A number that may be read in two ways.
    Unsure,
    /// What stands in quotes.
    Quote(String),
    /// `.`, `,`, `:`, `(` or another sign.
    Sign(char),
}

/// The longest number.
const NUMBER_MAX_CHARS: usize = 60;
/// What begins a quote, and what ends it.
const QUOTES: [(char, char); 8] =
    [('“', '”'), ('"', '"'), ('「', '」'), ('｢', '｣'), ('『', '』'), ('‘', '’'), ('«', '»'), ('\'', '\'')];

/// A sign, letter or digit as it is written on a narrow keyboard.
fn plain(c: char) -> char {
    match c {
        '\u{3000}' | '\u{a0}' | '\u{202f}' => ' ',
        '、' | '，' => ',',
        '。' => '.',
        '’' | '‘' => '\'',
        '−' | '–' => '-',
        '—' | '→' | '⇒' => ':',
        '…' => '.',
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        // Several lines are several sentences.
        '｡' | '\n' => '.',
        '､' => ',',
        '･' => '・',
        c => c,
    }
}

/// Half-width kana in the order of their code, from `ｦ` on, in full width.
const FULL_WIDTH: &str =
    "ヲァィゥェォャュョッーアイウエオカキクケコサシスセソタチツテトナニヌネノハヒフヘホマミムメモヤユヨラリルレロワン";

/// A half-width kana in full width, with the mark of its voice if that follows; and how many letters these are.
fn full_width(c: char, mark: Option<char>) -> Option<(char, usize)> {
    let place = (c as u32).checked_sub('ｦ' as u32)?;
    let full = FULL_WIDTH.chars().nth(place as usize)?;
    let voiced = match mark {
        Some('ﾞ') if full == 'ウ' => Some('ヴ'),
        Some('ﾞ') if "カキクケコサシスセソタチツテトハヒフヘホ".contains(full) => {
            char::from_u32(full as u32 + 1)
        }
        Some('ﾟ') if "ハヒフヘホ".contains(full) => char::from_u32(full as u32 + 2),
        _ => None,
    };
    Some(voiced.map_or((full, 1), |voiced| (voiced, 2)))
}

/// The tokens of a text.
pub(super) fn tokens(text: &str, language: Language) -> Vec<SpeechToken> {
    let chars: Vec<(usize, char)> = text.char_indices().collect();
    let mut all = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        let (next, what) = one(&chars, at, text, language);
        let byte = |at: usize| chars.get(at).map_or(text.len(), |(byte, _)| *byte);
        if let Some(what) = what {
            all.push(SpeechToken { what, range: byte(at)..byte(next) });
        }
        at = next;
    }
    if language == Language::English {
        all.into_iter().flat_map(|token| contracted(token, text)).collect()
    } else {
        all
    }
}

fn one(chars: &[(usize, char)], at: usize, text: &str, language: Language) -> (usize, Option<SpeechTokenKind>) {
    let raw = chars[at].1;
    let c = plain(raw);
    if let Some((kana, length)) = full_width(raw, chars.get(at + 1).map(|(_, c)| *c)) {
        return (at + length, Some(SpeechTokenKind::Word(kana.to_string())));
    }
    let is_word_before = at > 0 && chars[at - 1].1.is_alphanumeric();
    if let Some(end) = quote_end(chars, at, is_word_before) {
        let inside = &text[chars[at + 1].0..chars[end].0];
        return (end + 1, Some(SpeechTokenKind::Quote(inside.replace('↵', "\n").trim().to_owned())));
    }
    let is_digit = |at: usize| chars.get(at).is_some_and(|(_, c)| plain(*c).is_ascii_digit());
    if c.is_ascii_digit() || (c == '-' && is_digit(at + 1) && !is_word_before) {
        let rest: String = chars[at..]
            .iter()
            .take(NUMBER_MAX_CHARS)
            .take_while(|(_, c)| !is_list(*c))
            .map(|(_, c)| plain(*c))
            .collect();
        return match number_at(&rest) {
            // 2,3秒 is two or three.
            Some((TypedNumber::Is(_), length)) if language == Language::Japanese && rest[..length].contains(',') => {
                (at + length, Some(SpeechTokenKind::Unsure))
            }
            Some((number, length)) => {
                let next = at + rest[..length].chars().count();
                let what = match number {
                    TypedNumber::Is(number) => SpeechTokenKind::Number(number),
                    TypedNumber::Either(..) => SpeechTokenKind::Unsure,
                };
                (next, Some(what))
            }
            None => {
                let length = rest.chars().skip(1).take_while(|c| c.is_ascii_digit()).count() + 1;
                (at + length, Some(SpeechTokenKind::Unsure))
            }
        };
    }
    // *9 a.m.* does not end a sentence.
    let dotted: String = chars[at..].iter().take(4).map(|(_, c)| c.to_ascii_lowercase()).collect();
    if !is_word_before && matches!(&dotted[..], "a.m." | "p.m.") {
        return (at + 4, Some(SpeechTokenKind::Word(dotted.replace('.', ""))));
    }
    let is_letter = |c: char| {
        if language == Language::Japanese { c.is_ascii_alphabetic() } else { c.is_alphabetic() && c < '\u{2e80}' }
    };
    if is_letter(c) {
        let mut word = String::new();
        let mut next = at;
        while let Some(c) = chars.get(next).map(|(_, c)| plain(*c)) {
            let joins = c == '\'' && chars.get(next + 1).is_some_and(|(_, c)| is_letter(plain(*c)));
            if !is_letter(c) && !joins {
                break;
            }
            word.extend(c.to_lowercase());
            next += 1;
        }
        return (next, Some(SpeechTokenKind::Word(word)));
    }
    let equals = chars.get(at + 1).is_some_and(|(_, c)| plain(*c) == '=');
    if equals && matches!(c, '<' | '>') {
        return (at + 2, Some(SpeechTokenKind::Sign(if c == '<' { '≤' } else { '≥' })));
    }
    // *2-3 people*, 2〜3人
    if matches!(c, '-' | '~' | '〜') && is_word_before && is_digit(at + 1) && plain(chars[at - 1].1).is_ascii_digit() {
        return (at + 1, Some(SpeechTokenKind::Sign('~')));
    }
    // *Head touched -> wave*, *head touched - wave*
    let next = chars.get(at + 1).map(|(_, c)| *c);
    let is_alone = at > 0 && chars[at - 1].1 == ' ' && next == Some(' ');
    if c == '-' && (next == Some('>') || is_alone) {
        return (at + if is_alone { 1 } else { 2 }, Some(SpeechTokenKind::Sign(':')));
    }
    let what = if c.is_whitespace() || matches!(c, '-' | '\'' | '・') {
        None
    } else if c.is_alphanumeric() || c == 'ー' || c == '々' {
        Some(SpeechTokenKind::Word(c.to_string()))
    } else {
        Some(SpeechTokenKind::Sign(c))
    };
    (at + 1, what)
}

/// True for a comma that never stands inside of a number: 2、3人.
fn is_list(c: char) -> bool {
    matches!(c, '、' | '､')
}

/// Where the quote that begins here ends; none if nothing begins or nobody ended it.
fn quote_end(chars: &[(usize, char)], at: usize, is_word_before: bool) -> Option<usize> {
    let open = if plain(chars[at].1) == '"' { '"' } else { chars[at].1 };
    let (_, close) = QUOTES.into_iter().find(|(known, _)| *known == open)?;
    let is_single = matches!(close, '\'' | '’');
    if is_single && is_word_before {
        return None;
    }
    (at + 1..chars.len()).find(|end| {
        let c = if plain(chars[*end].1) == '"' { '"' } else { chars[*end].1 };
        let goes_on = chars.get(end + 1).is_some_and(|(_, c)| c.is_alphanumeric());
        c == close && !(is_single && goes_on)
    })
}

/// *isn't* as *is* and *not*, *it's* as *it* and *'s*.
fn contracted(token: SpeechToken, text: &str) -> Vec<SpeechToken> {
    let SpeechTokenKind::Word(word) = &token.what else { return vec![token] };
    let cut = |ending: &str, second: &str| {
        let first = word.strip_suffix(ending).filter(|first| !first.is_empty())?;
        let kept = text[token.range.clone()].char_indices().nth(first.chars().count())?.0;
        let middle = token.range.start + kept;
        let one = SpeechToken { what: SpeechTokenKind::Word(first.to_owned()), range: token.range.start..middle };
        let two = SpeechToken { what: SpeechTokenKind::Word(second.to_owned()), range: middle..token.range.end };
        Some(vec![one, two])
    };
    let endings =
        [("n't", "not"), ("'s", "'s"), ("'re", "are"), ("'m", "am"), ("'ve", "have"), ("'ll", "will"), ("'d", "would")];
    endings.into_iter().find_map(|(ending, second)| cut(ending, second)).unwrap_or_else(|| vec![token])
}
