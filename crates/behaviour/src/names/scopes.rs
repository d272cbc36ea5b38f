//! The meaning of each word of a procedure: a value from outside, one of its own, a function, a part or a key.

use super::is_identifier;
use super::tokens::{Bracket, PlacedToken, TokenKind, tokens};
use std::ops::Range;

/// Words that build a procedure and name nothing in it.
const BUILDING: [&str; 21] = [
    "let", "const", "for", "in", "if", "else", "while", "loop", "do", "until", "switch", "return", "break", "continue",
    "throw", "try", "catch", "true", "false", "fn", "_",
];
/// Words behind a block that go on with what began before it.
const GOING_ON: [&str; 4] = ["else", "catch", "while", "until"];

/// The meanings of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WordMeaning {
    /// A value from outside, such as an argument.
    Outer,
    /// A value of the procedure's own; with which of [`ReadProcedure::locals`].
    Local(usize),
    /// A function or a helper, called or pointed to.
    Function,
    /// A part of an object.
    Part,
}

/// A word of a procedure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ScopedWord {
    pub(super) place: Range<usize>,
    pub(super) meaning: WordMeaning,
    /// The values of its own that are known where a value from outside is used: so many of [`ReadProcedure::known`].
    known: Range<usize>,
}

/// A procedure that is read.
#[derive(Default)]
pub(super) struct ReadProcedure {
    pub(super) words: Vec<ScopedWord>,
    /// The names of the values of its own, in the order in which they are declared.
    pub(super) locals: Vec<String>,
    known: Vec<usize>,
}

impl ReadProcedure {
    /// The values of its own that are known where the word stands.
    pub(super) fn known_at(&self, word: &ScopedWord) -> &[usize] {
        &self.known[word.known.clone()]
    }
}

/// Reads a procedure. One that is not finished is read as far as it goes.
pub(super) fn read(body: &str) -> ReadProcedure {
    let tokens = tokens(body);
    let mut reader = ScopeReader {
        body,
        tokens: &tokens,
        scope: Vec::new(),
        levels: vec![Level::of(WordSurroundings::Block, 0)],
        read: ReadProcedure::default(),
    };
    let mut at = 0;
    while at < tokens.len() {
        at = reader.next(at);
    }
    reader.read
}

/// The surroundings of a word.
#[derive(Clone, Copy, PartialEq, Eq)]
enum WordSurroundings {
    Brackets,
    Block,
    Map,
    /// The values of a closure are known; true if it ends with its block.
    Closure(bool),
}

struct Level {
    inside: WordSurroundings,
    /// The number of values that were known before it.
    known: usize,
    /// Declared by a statement that is not over.
    declared: Vec<usize>,
    /// Known in the block that follows.
    for_block: Vec<usize>,
    /// A key of an object may come.
    key: bool,
}

impl Level {
    fn of(inside: WordSurroundings, known: usize) -> Self {
        Self { inside, known, declared: Vec::new(), for_block: Vec::new(), key: inside == WordSurroundings::Map }
    }
}

struct ScopeReader<'b> {
    body: &'b str,
    tokens: &'b [PlacedToken],
    /// The values of its own that are known here, by number.
    scope: Vec<usize>,
    levels: Vec<Level>,
    read: ReadProcedure,
}

impl<'b> ScopeReader<'b> {
    fn text(&self, at: usize) -> &'b str {
        self.tokens.get(at).map_or("", |token| &self.body[token.place.clone()])
    }

    fn is(&self, at: usize, kind: TokenKind) -> bool {
        self.tokens.get(at).is_some_and(|token| token.kind == kind)
    }

    fn level(&mut self) -> &mut Level {
        if self.levels.is_empty() {
            self.levels.push(Level::of(WordSurroundings::Block, 0));
        }
        let last = self.levels.len() - 1;
        &mut self.levels[last]
    }

    /// Reads one piece or several that belong together; tells where the next is.
    fn next(&mut self, at: usize) -> usize {
        match self.tokens[at].kind {
            TokenKind::Word => return self.word(at),
            TokenKind::Open(bracket) => self.open(bracket),
            TokenKind::Close(bracket) => self.close(bracket, at),
            TokenKind::Sign => return self.sign(at),
            TokenKind::Number | TokenKind::Text => {}
        }
        at + 1
    }

    fn open(&mut self, bracket: Bracket) {
        let known = self.scope.len();
        let inside = match bracket {
            Bracket::Round | Bracket::Square => WordSurroundings::Brackets,
            Bracket::Block | Bracket::Hole => WordSurroundings::Block,
            Bracket::Map => WordSurroundings::Map,
        };
        if bracket == Bracket::Block {
            let values = std::mem::take(&mut self.level().for_block);
            self.scope.extend(values);
        }
        self.levels.push(Level::of(inside, known));
    }

    fn close(&mut self, bracket: Bracket, at: usize) {
        self.end_closures();
        self.end_level();
        let goes_on = self.is(at + 1, TokenKind::Word) && GOING_ON.contains(&self.text(at + 1));
        if bracket == Bracket::Block && self.level().inside == WordSurroundings::Closure(true) && !goes_on {
            self.end_level();
        }
    }

    fn end_closures(&mut self) {
        while matches!(self.level().inside, WordSurroundings::Closure(_)) {
            self.end_level();
        }
    }

    fn end_level(&mut self) {
        if let Some(level) = self.levels.pop() {
            self.scope.truncate(level.known);
        }
    }

    fn sign(&mut self, at: usize) -> usize {
        match self.text(at) {
            ";" => {
                self.end_closures();
                let declared = std::mem::take(&mut self.level().declared);
                self.scope.extend(declared);
            }
            "," => {
                self.end_closures();
                let level = self.level();
                level.key = level.inside == WordSurroundings::Map;
            }
            "|" if !self.is_behind_value(at) => return self.closure(at),
            "||" if !self.is_behind_value(at) => {
                self.begin_closure(at + 1, self.scope.len());
            }
            _ => {}
        }
        at + 1
    }

    /// True if a value stands before, so that a `|` takes it.
    fn is_behind_value(&self, at: usize) -> bool {
        let Some(before) = at.checked_sub(1) else { return false };
        match self.tokens[before].kind {
            TokenKind::Number | TokenKind::Text => true,
            TokenKind::Close(bracket) => bracket != Bracket::Block,
            TokenKind::Word => matches!(self.text(before), "true" | "false") || !BUILDING.contains(&self.text(before)),
            TokenKind::Open(_) | TokenKind::Sign => false,
        }
    }

    /// The values of a closure, `|a, b|`, and what is behind them.
    fn closure(&mut self, at: usize) -> usize {
        let known = self.scope.len();
        let mut next = at + 1;
        while next < self.tokens.len() && self.text(next) != "|" {
            if self.is(next, TokenKind::Word) {
                let local = self.declare(next);
                self.scope.push(local);
            }
            next += 1;
        }
        self.begin_closure(next + 1, known);
        next + 1
    }

    fn begin_closure(&mut self, body: usize, known: usize) {
        let is_statement = self.is(body, TokenKind::Open(Bracket::Block))
            || matches!(self.text(body), "if" | "switch" | "while" | "loop" | "do" | "for" | "try");
        self.levels.push(Level::of(WordSurroundings::Closure(is_statement), known));
    }

    fn word(&mut self, at: usize) -> usize {
        let text = self.text(at);
        let level = self.level();
        let is_key = std::mem::take(&mut level.key);
        if at > 0 && matches!(self.text(at - 1), "." | "?.") && self.is(at - 1, TokenKind::Sign) {
            self.put(at, WordMeaning::Part);
        } else if is_key && self.text(at + 1) == ":" {
            return at + 2;
        } else if text == "let" || text == "const" {
            if self.is(at + 1, TokenKind::Word) {
                let local = self.declare(at + 1);
                self.level().declared.push(local);
                return at + 2;
            }
        } else if text == "for" || text == "catch" {
            return self.block_values(at + 1);
        } else if self.is_called(at) {
            self.put(at, WordMeaning::Function);
            self.named_in_text(at);
        } else if !BUILDING.contains(&text) {
            let meaning = self.meaning_of(text);
            self.put(at, meaning);
        }
        at + 1
    }

    /// The values of a `for` or `catch`, with brackets or without, which are known in the block that follows.
    fn block_values(&mut self, at: usize) -> usize {
        if self.is(at, TokenKind::Word) {
            let local = self.declare(at);
            self.level().for_block.push(local);
            return at + 1;
        }
        if !self.is(at, TokenKind::Open(Bracket::Round)) {
            return at;
        }
        let mut next = at + 1;
        while next < self.tokens.len() && !self.is(next, TokenKind::Close(Bracket::Round)) {
            if self.is(next, TokenKind::Word) {
                let local = self.declare(next);
                self.level().for_block.push(local);
            }
            next += 1;
        }
        next + 1
    }

    fn is_called(&self, at: usize) -> bool {
        let opens = |at: usize| self.is(at, TokenKind::Open(Bracket::Round));
        let is_name = !BUILDING.contains(&self.text(at));
        is_name && (opens(at + 1) || (self.text(at + 1) == "!" && opens(at + 2)))
    }

    /// Notes the function that a text names in a call such as `Fn("near")`.
    fn named_in_text(&mut self, at: usize) {
        let Some(token) = self.tokens.get(at + 2).filter(|token| token.kind == TokenKind::Text) else { return };
        let text = &self.body[token.place.clone()];
        let name = text.get(1..text.len().saturating_sub(1)).filter(|name| is_identifier(name));
        let place = token.place.start + 1..token.place.end.saturating_sub(1);
        match (self.text(at), name) {
            ("Fn" | "is_def_fn", Some(_)) => self.put_at(place, WordMeaning::Function),
            ("is_def_var", Some(name)) => self.put_at(place, self.meaning_of(name)),
            _ => {}
        }
    }

    fn meaning_of(&self, name: &str) -> WordMeaning {
        let local = self.scope.iter().rev().find(|local| self.read.locals[**local] == name);
        local.map_or(WordMeaning::Outer, |local| WordMeaning::Local(*local))
    }

    fn declare(&mut self, at: usize) -> usize {
        let local = self.read.locals.len();
        self.read.locals.push(self.text(at).to_owned());
        self.put(at, WordMeaning::Local(local));
        local
    }

    fn put(&mut self, at: usize, meaning: WordMeaning) {
        self.put_at(self.tokens[at].place.clone(), meaning);
    }

    fn put_at(&mut self, place: Range<usize>, meaning: WordMeaning) {
        let start = self.read.known.len();
        if meaning == WordMeaning::Outer {
            self.read.known.extend(&self.scope);
        }
        self.read.words.push(ScopedWord { place, meaning, known: start..self.read.known.len() });
    }
}

#[cfg(test)]
mod tests {
    use super::{WordMeaning, read};

    /// The values from outside, in order.
    fn outer(body: &str) -> Vec<&str> {
        let words = read(body).words.into_iter();
        words.filter(|word| word.meaning == WordMeaning::Outer).map(|word| &body[word.place]).collect()
    }

    #[test]
    fn values_of_its_own_are_none_from_outside() {
        let cases: [(&str, &[&str]); 20] = [
            ("let a = a + b; a", &["a", "b"]),
            ("{ let a = 1; a } + a", &["a"]),
            ("[b].map(|a| a + b) == a", &["b", "b", "a"]),
            ("[1].map(|a| { a }) + [a]", &["a"]),
            ("f(|a| if a { 1 } else { a }, a)", &["a"]),
            ("let f = |a| a; f.call(a)", &["a"]),
            ("for a in a { a } a", &["a", "a"]),
            ("for (a, i) in b { a + i } i", &["b", "i"]),
            ("try { a } catch (e) { e } e", &["a", "e"]),
            ("#{a: a, b: #{a: b}}.a", &["a", "b"]),
            ("a.b.c + a?.b", &["a", "a"]),
            ("a | b", &["a", "b"]),
            ("`a ${let b = a; b} ${b}`", &["a", "b"]),
            ("if a { let a = 2; a } else { a }", &["a", "a"]),
            ("switch a { 1 => |b| b, _ => b }", &["a", "b"]),
            ("near(near) && Fn(\"near\")", &["near"]),
            ("let a; let b = || a; b.call() + c", &["c"]),
            ("is_def_var(\"a\")", &["a"]),
            ("0..a", &["a"]),
            ("[|a| a, a]", &["a"]),
        ];
        cases.into_iter().for_each(|(body, wanted)| assert_eq!(outer(body), wanted, "{body}"));
    }

    #[test]
    fn what_is_not_finished_is_read_as_far_as_it_goes() {
        for body in ["}", ")", "|", "let", "for", "for (", "catch (a", "#{", "`${", "|a", "a |", "}}} a", "\u{e9}."] {
            let _ = read(body);
        }
        assert_eq!(outer("}} a"), ["a"]);
    }
}
