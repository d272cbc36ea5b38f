//! A text as tokens: words, numbers, signs, quoted texts and procedures, each with its place in the text.

use crate::Language;
use behaviour::{TypedNumber, number_at};
use std::ops::Range;

/// One token.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SentenceToken {
    /// A word in lower case; of Japanese, one character.
    Word(String),
    /// A number, with a minus before it.
    Number(f64),
    /// A number that may be read in two ways: `1,000`.
    Either(f64, f64),
    /// A text in quotes, without them.
    Quoted(String),
    /// A procedure in backticks, without them.
    Code(String),
    /// Any other sign.
    Sign(char),
}

/// A token and its bytes in the text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Placed {
    pub(crate) token: SentenceToken,
    pub(crate) range: Range<usize>,
    /// Whether it stands in place of what was not understood.
    pub(crate) is_doubtful: bool,
}

/// Words that mean nothing here.
const ARTICLES: [&str; 3] = ["the", "a", "an"];
/// What stands for an end of line inside quotes.
const LINE_END: char = '↵';
/// The longest number.
const NUMBER_MAX_CHARS: usize = 60;

/// The tokens of a text, in order. Articles and hyphens are left out.
pub(crate) fn tokens(text: &str, language: Language) -> Vec<Placed> {
    let mut reader = Tokenizer { chars: text.char_indices().collect(), end: text.len(), at: 0, language };
    let mut found = Vec::new();
    while let Some(placed) = reader.next() {
        found.extend(placed);
    }
    found
}

/// A text in the quotes of a language.
pub(crate) fn quoted(text: &str, language: Language) -> String {
    let (open, close) = match language {
        Language::English => ('“', '”'),
        Language::Japanese => ('「', '」'),
    };
    wrapped(text, open, close)
}

/// A procedure in backticks.
pub(crate) fn code(body: &str) -> String {
    if body.is_empty() { "`…`".to_owned() } else { wrapped(body, '`', '`') }
}

/// A text between signs; the closing one inside is doubled.
fn wrapped(text: &str, open: char, close: char) -> String {
    let mut all = String::from(open);
    for c in text.chars() {
        match c {
            '\n' => all.push(LINE_END),
            c if c == close => all.extend([c, c]),
            c => all.push(c),
        }
    }
    all.push(close);
    all
}

/// Full-width letters, digits and signs as plain ones.
fn plain(c: char) -> char {
    match c {
        '\u{3000}' | '\u{a0}' | '\u{202f}' => ' ',
        '、' => ',',
        '。' => '.',
        '’' => '\'',
        '−' => '-',
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        c => c,
    }
}

fn closing(open: char) -> Option<char> {
    match open {
        '“' => Some('”'),
        '"' => Some('"'),
        '「' => Some('」'),
        '『' => Some('』'),
        '`' => Some('`'),
        _ => None,
    }
}

struct Tokenizer {
    chars: Vec<(usize, char)>,
    end: usize,
    at: usize,
    language: Language,
}

impl Tokenizer {
    /// The next token, or nothing in place of what means nothing; none at the end.
    fn next(&mut self) -> Option<Option<Placed>> {
        let start = self.at;
        let c = plain(self.peek(0)?);
        let token = if let Some(close) = closing(c) {
            Some(self.quote(c, close))
        } else if c.is_ascii_digit() || (c == '-' && self.digit(1) && !self.is_after_word()) {
            Some(self.number())
        } else if self.is_letter(0) {
            let word = self.word();
            (!ARTICLES.contains(&word.as_str())).then_some(SentenceToken::Word(word))
        } else {
            self.at += 1;
            let means = !c.is_whitespace() && c != '-' && c != '\'';
            means.then(|| {
                if c.is_alphanumeric() || c == 'ー' {
                    SentenceToken::Word(c.to_string())
                } else {
                    SentenceToken::Sign(c)
                }
            })
        };
        let range = self.byte(start)..self.byte(self.at);
        Some(token.map(|token| Placed { token, range, is_doubtful: false }))
    }

    fn peek(&self, ahead: usize) -> Option<char> {
        self.chars.get(self.at + ahead).map(|(_, c)| *c)
    }

    fn digit(&self, ahead: usize) -> bool {
        self.peek(ahead).is_some_and(|c| plain(c).is_ascii_digit())
    }

    fn is_after_word(&self) -> bool {
        self.at > 0 && self.chars[self.at - 1].1.is_alphanumeric()
    }

    fn byte(&self, at: usize) -> usize {
        self.chars.get(at).map_or(self.end, |(byte, _)| *byte)
    }

    /// Whether a letter of a word of several stands there: in Japanese only plain letters make such words.
    fn is_letter(&self, ahead: usize) -> bool {
        let Some(c) = self.peek(ahead).map(plain) else { return false };
        if self.language == Language::Japanese || !c.is_alphabetic() { c.is_ascii_alphabetic() } else { c < '\u{2e80}' }
    }

    fn word(&mut self) -> String {
        let mut word = String::new();
        while self.is_letter(0) || (self.peek(0).map(plain) == Some('\'') && self.is_letter(1)) {
            word.extend(self.peek(0).map(plain).into_iter().flat_map(char::to_lowercase));
            self.at += 1;
        }
        word
    }

    /// The number that begins here, with both decimal signs.
    fn number(&mut self) -> SentenceToken {
        let rest: String = self.chars[self.at..].iter().take(NUMBER_MAX_CHARS).map(|(_, c)| *c).collect();
        let Some((number, length)) = number_at(&rest) else {
            return self.digits();
        };
        self.at += rest[..length].chars().count();
        match number {
            TypedNumber::Is(number) => SentenceToken::Number(number),
            TypedNumber::Either(one, other) => SentenceToken::Either(one, other),
        }
    }

    /// Digits that are no number with what follows them, such as those of a date: each by themselves.
    fn digits(&mut self) -> SentenceToken {
        let mut digits = String::new();
        while let Some(c) = self.peek(0).map(plain).filter(|c| c.is_ascii_digit() || (*c == '-' && digits.is_empty())) {
            digits.push(c);
            self.at += 1;
        }
        SentenceToken::Number(digits.parse().unwrap_or_default())
    }

    fn quote(&mut self, open: char, close: char) -> SentenceToken {
        let mut inside = String::new();
        self.at += 1;
        while let Some(c) = self.peek(0) {
            self.at += 1;
            if c == close {
                if self.peek(0) != Some(close) {
                    break;
                }
                self.at += 1;
            }
            inside.push(if c == LINE_END { '\n' } else { c });
        }
        match open {
            '`' if inside == "…" => SentenceToken::Code(String::new()),
            '`' => SentenceToken::Code(inside),
            _ => SentenceToken::Quoted(inside),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{SentenceToken, code, quoted, tokens};
    use crate::Language;

    fn read(text: &str, language: Language) -> Vec<SentenceToken> {
        tokens(text, language).into_iter().map(|placed| placed.token).collect()
    }

    #[test]
    fn words_numbers_and_quotes_are_told_apart() {
        let word = |word: &str| SentenceToken::Word(word.to_owned());
        let read_en = read("The ball’s 40cm, -0.5 “a ”” b”", Language::English);
        let quote = SentenceToken::Quoted("a ” b".to_owned());
        let number = SentenceToken::Number;
        assert_eq!(read_en, [word("ball's"), number(40.0), word("cm"), SentenceToken::Sign(','), number(-0.5), quote]);
        let read_ja = read("赤い４０ｃｍ。", Language::Japanese);
        assert_eq!(read_ja, [word("赤"), word("い"), number(40.0), word("cm"), SentenceToken::Sign('.')]);
    }

    #[test]
    fn numbers_are_read_as_one_with_both_decimal_signs() {
        let read_en = |text| read(text, Language::English);
        for text in ["1,5", "1.5", "１，５", "1．5"] {
            assert_eq!(read_en(text), [SentenceToken::Number(1.5)], "{text}");
        }
        assert_eq!(read_en("1,000"), [SentenceToken::Either(1000.0, 1.0)]);
        assert_eq!(read_en("5, 6"), [SentenceToken::Number(5.0), SentenceToken::Sign(','), SentenceToken::Number(6.0)]);
        let ten = SentenceToken::Number(1.0);
        assert_eq!(read_en("1.2.3")[0], ten);
    }

    #[test]
    fn what_is_quoted_is_read_as_it_was() {
        for text in ["", "a", "say “no”", "「」", "`x`", "a\nb", "””"] {
            for language in Language::ALL {
                assert_eq!(read(&quoted(text, language), language), [SentenceToken::Quoted(text.to_owned())], "{text}");
                assert_eq!(read(&code(text), language), [SentenceToken::Code(text.to_owned())], "{text}");
            }
        }
    }
}
