//! A procedure cut into its words, texts and signs, as Rhai cuts it: code is also what stands in the holes `${…}` of a text,
//! to any depth, and nothing else of a text or a comment is.

use super::{after_word, is_name_start, quotes};
use std::ops::Range;

/// Signs of several characters, the longest first.
const SIGNS: [&str; 23] = [
    "...", "..=", "**=", "<<=", ">>=", "..", "?.", "::", "=>", "==", "!=", "<=", ">=", "&&", "||", "|=", "**", "+=",
    "-=", "*=", "/=", "%=", "&=",
];

/// The kinds of pieces of a procedure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TokenKind {
    Word,
    Number,
    /// A text, or what stands in one before, between or behind its holes.
    Text,
    Open(Bracket),
    Close(Bracket),
    Sign,
}

/// The kinds of brackets, by what they hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bracket {
    Round,
    Square,
    Block,
    /// `#{ … }`
    Map,
    /// `${ … }`
    Hole,
}

/// A piece and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PlacedToken {
    pub(crate) kind: TokenKind,
    pub(crate) place: Range<usize>,
}

/// The pieces of a procedure, in order. One that is not finished has them as far as it goes.
pub(crate) fn tokens(body: &str) -> Vec<PlacedToken> {
    let mut cutter = Cutter { body, at: 0, braces: Vec::new(), found: Vec::new() };
    while cutter.at < body.len() {
        cutter.next();
    }
    cutter.found
}

struct Cutter<'b> {
    body: &'b str,
    at: usize,
    /// The braces that are open.
    braces: Vec<Bracket>,
    found: Vec<PlacedToken>,
}

impl Cutter<'_> {
    fn next(&mut self) {
        let (start, rest) = (self.at, &self.body[self.at..]);
        let bytes = rest.as_bytes();
        match bytes[0] {
            b'"' => self.put(TokenKind::Text, start + quoted(bytes)),
            b'\'' => self.put(TokenKind::Text, start + quoted(bytes)),
            b'`' => {
                self.at += 1;
                self.template(start);
            }
            b'#' if bytes.get(1) == Some(&b'{') => self.open(Bracket::Map, 2),
            b'#' => self
                .put(raw_text(rest).map_or(TokenKind::Sign, |_| TokenKind::Text), start + raw_text(rest).unwrap_or(1)),
            b'/' if bytes.get(1) == Some(&b'/') => self.at += rest.find('\n').unwrap_or(rest.len()),
            b'/' if bytes.get(1) == Some(&b'*') => self.at += comment(bytes),
            b'(' => self.open(Bracket::Round, 1),
            b'[' => self.open(Bracket::Square, 1),
            b'{' => self.open(Bracket::Block, 1),
            b')' => self.put(TokenKind::Close(Bracket::Round), start + 1),
            b']' => self.put(TokenKind::Close(Bracket::Square), start + 1),
            b'}' => self.close_brace(),
            byte if byte.is_ascii_digit() => self.put(TokenKind::Number, after_word(self.body, start)),
            _ => self.word_or_sign(),
        }
    }

    fn word_or_sign(&mut self) {
        let (start, rest) = (self.at, &self.body[self.at..]);
        let first = rest.chars().next().unwrap_or(' ');
        if is_name_start(first) {
            self.put(TokenKind::Word, after_word(self.body, start));
        } else if first.is_ascii_whitespace() {
            self.at += first.len_utf8();
        } else if let Some(length) = quotes::quoted(rest) {
            self.put(TokenKind::Text, start + length);
        } else {
            let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
            self.put(TokenKind::Sign, start + sign.map_or(first.len_utf8(), |sign| sign.len()));
        }
    }

    fn put(&mut self, kind: TokenKind, end: usize) {
        self.found.push(PlacedToken { kind, place: self.at..end });
        self.at = end;
    }

    fn open(&mut self, bracket: Bracket, length: usize) {
        if !matches!(bracket, Bracket::Round | Bracket::Square) {
            self.braces.push(bracket);
        }
        self.put(TokenKind::Open(bracket), self.at + length);
    }

    /// The end of a block, of an object, or of a hole: behind that the text goes on.
    fn close_brace(&mut self) {
        let Some(bracket) = self.braces.pop() else { return self.put(TokenKind::Sign, self.at + 1) };
        self.put(TokenKind::Close(bracket), self.at + 1);
        if bracket == Bracket::Hole {
            self.template(self.at);
        }
    }

    /// A text between backticks from here to its end or its next hole. Two backticks are one in the text, and `\${` opens
    /// no hole.
    fn template(&mut self, start: usize) {
        let bytes = self.body.as_bytes();
        let is = |at: usize, text: &[u8]| bytes[at..].starts_with(text);
        let mut at = self.at;
        self.at = start;
        while at < bytes.len() {
            if is(at, b"${") {
                self.put(TokenKind::Text, at);
                return self.open(Bracket::Hole, 2);
            }
            if is(at, b"`") && !is(at, b"``") {
                return self.put(TokenKind::Text, at + 1);
            }
            at += if is(at, b"\\${") {
                3
            } else if is(at, b"``") {
                2
            } else {
                1
            };
        }
        self.put(TokenKind::Text, bytes.len());
    }
}

/// Returns the length of a text that begins with its quote.
fn quoted(bytes: &[u8]) -> usize {
    let mut at = 1;
    while at < bytes.len() && bytes[at] != bytes[0] {
        at += if bytes[at] == b'\\' { 2 } else { 1 };
    }
    (at + 1).min(bytes.len())
}

/// Returns the length of a text in which nothing is escaped: `#"…"#`, with as many `#` behind as before.
fn raw_text(rest: &str) -> Option<usize> {
    let marks = rest.len() - rest.trim_start_matches('#').len();
    rest[marks..].strip_prefix('"').filter(|_| marks > 0)?;
    let end = format!("\"{}", &rest[..marks]);
    Some(rest[marks + 1..].find(&end).map_or(rest.len(), |length| marks + 1 + length + end.len()))
}

/// Returns the length of a comment, in which others may stand.
fn comment(bytes: &[u8]) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while at < bytes.len() {
        let before = at;
        match &bytes[at..(at + 2).min(bytes.len())] {
            b"/*" => (depth, at) = (depth + 1, at + 2),
            b"*/" => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 && at > before {
            break;
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::{TokenKind, tokens};

    fn words(body: &str) -> Vec<&str> {
        tokens(body).into_iter().filter(|token| token.kind == TokenKind::Word).map(|token| &body[token.place]).collect()
    }

    #[test]
    fn only_code_has_words() {
        let cases: [(&str, &[&str]); 12] = [
            ("`the ball is at ${ball.x}`", &["ball", "x"]),
            ("`one ${`ball ${ball.x}`} ball's` + b", &["ball", "x", "b"]),
            ("`a ${#{a: `${b}`}.a} c` + d", &["a", "b", "a", "d"]),
            ("`a `` b \\${c} ${d}`", &["d"]),
            ("#\"a \"b\" ${c}\"# + d", &["d"]),
            ("##\"a \"# b\"## + c", &["c"]),
            ("\"a \\\" b\" + 'c' + d", &["d"]),
            ("/* a /* b */ c */ d // e\nf", &["d", "f"]),
            ("1x + 0..y", &["y"]),
            ("`${{ let a = 1; a }} b", &["let", "a", "a"]),
            ("`${a}${b} c", &["a", "b"]),
            ("} a \"b", &["a"]),
        ];
        cases.into_iter().for_each(|(body, wanted)| assert_eq!(words(body), wanted, "{body}"));
    }

    #[test]
    fn every_byte_of_any_text_is_passed_once() {
        let pieces =
            ["`", "${", "}", "#", "\"", "'", "\\", "/*", "*/", "//", "\n", "a", "é", "距", "(", "{", "#{", "😀", " "];
        let mut dice = 3_u64;
        for _ in 0..20_000 {
            let body: String = (0..12)
                .map(|_| {
                    dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    pieces[(dice >> 33) as usize % pieces.len()]
                })
                .collect();
            let mut done = 0;
            for token in tokens(&body) {
                assert!(token.place.start >= done && body.get(token.place.clone()).is_some(), "{body:?} {token:?}");
                done = token.place.end;
            }
            assert!(done <= body.len());
        }
    }
}
