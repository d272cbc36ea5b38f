//! Fields that are named like a word Rhai keeps for itself without using it: a face says `new`.

use rhai::{Engine, Position, Token};
use std::cell::Cell;

/// Words that Rhai 1.27 reserves and gives no meaning.
const IDLE_WORDS: [&str; 22] = [
    "async",
    "await",
    "case",
    "default",
    "is",
    "match",
    "new",
    "nil",
    "null",
    "package",
    "protected",
    "public",
    "shared",
    "spawn",
    "static",
    "super",
    "sync",
    "thread",
    "use",
    "var",
    "void",
    "with",
];

/// True if Rhai reserves a word and gives it no meaning.
pub(crate) fn is_idle_word(word: &str) -> bool {
    IDLE_WORDS.contains(&word)
}

/// Lets `face.new` and `#{new: true}` name a field. Nothing else changes: such a word is no variable.
pub(crate) fn allow_reserved_names(engine: &mut Engine) {
    let before_field = Cell::new(false);
    let map = move |token: Token, _: Position, _: &_| {
        let here = before_field.replace(matches!(token, Token::Period | Token::Elvis | Token::MapStart | Token::Comma));
        match token {
            Token::Reserved(word) if here && is_idle_word(&word) => Token::Identifier(word),
            token => token,
        }
    };
    #[expect(deprecated, reason = "not deprecated: Rhai marks the call as one that may change; its version is pinned")]
    engine.on_parse_token(map);
}

#[cfg(test)]
mod tests {
    use crate::{Limits, check_body, try_body};
    use behaviour::Value;

    #[test]
    fn a_field_may_have_a_reserved_name() {
        let face = ["face".to_owned()];
        let seen = Value::object([("new", Value::Bool(true))]);
        let run = |body: &str| try_body(&[], &face, body, std::slice::from_ref(&seen), &Limits::default());
        assert_eq!(run("!face.new"), Ok(Value::Bool(false)));
        assert_eq!(run("#{x: 1, new: face?.new}.new"), Ok(Value::Bool(true)));
        assert!(check_body(&face, "new").is_err() && check_body(&face, "let new = 1; new").is_err());
        assert!(check_body(&face, "[face, new]").is_err());
    }
}
