//! The reasons why Rhai cannot read a text, in plain words.

use super::ValueKind;
use super::place::TextPlace;
use super::plain::plain;
use rhai::{LexError, ParseError, ParseErrorType};
use std::fmt;

/// The reason why a text cannot be read as a procedure. [`fmt::Display`] says it in a few English words with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Syntax {
    error: ParseError,
    /// The names of the arguments.
    arguments: Vec<String>,
}

impl Syntax {
    /// Takes the error of a text with these arguments.
    pub(crate) fn of(error: ParseError, arguments: &[String]) -> Self {
        Self { error, arguments: arguments.to_vec() }
    }

    /// The name of a value that there is not, if that is why.
    pub(crate) fn unknown_value(&self) -> Option<&str> {
        if let ParseErrorType::VariableUndefined(name) = self.error.err_type() { Some(name) } else { None }
    }

    fn why(&self) -> String {
        use ParseErrorType as E;
        match self.error.err_type() {
            E::BadInput(error) => lex_words(error),
            E::MissingToken(token, _) if matches!(token.as_str(), ")" | "]" | "}") => {
                format!("a closing {token} is missing")
            }
            E::MissingToken(token, _) => format!("{token} is missing"),
            E::UnexpectedEOF => "it ends too early".to_owned(),
            E::VariableUndefined(name) => unknown_name(name, &self.arguments),
            E::ModuleUndefined(name) => format!("there is no “{name}”"),
            E::Reserved(name) => format!("“{name}” cannot be used here"),
            E::ExprTooDeep => "it is nested too deep; move a part into a helper".to_owned(),
            E::ExprExpected(what) => format!("{what} is missing"),
            E::LiteralTooLarge(..) => "a text, list or object is too large".to_owned(),
            E::MismatchedType(wanted, got) => {
                format!("{} is needed here, not {}", ValueKind::of(wanted), ValueKind::of(got))
            }
            E::TooManyFunctions => "it has too many closures".to_owned(),
            E::LoopBreak => "break and continue belong inside a loop".to_owned(),
            other => plain(&other.to_string()),
        }
    }
}

impl fmt::Display for Syntax {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self.unknown_value() {
            // The name tells where it is.
            Some(_) => to.write_str(&self.why()),
            None => write!(to, "{}{}", TextPlace::from(self.error.position()), self.why()),
        }
    }
}

fn lex_words(error: &LexError) -> String {
    match error {
        LexError::UnterminatedString => "the closing quote of a text is missing".to_owned(),
        LexError::UnexpectedInput(what) => format!("“{what}” is not expected here"),
        LexError::ImproperSymbol(what, why) if why.ends_with("is disabled") => {
            format!("“{what}” cannot be used here")
        }
        LexError::ImproperSymbol(what, why) if why.is_empty() => {
            format!("“{what}” is not expected here")
        }
        other => plain(&other.to_string()),
    }
}

fn unknown_name(name: &str, arguments: &[String]) -> String {
    if arguments.is_empty() {
        return format!("no “{name}” here");
    }
    format!("no “{name}” here; there is {}", arguments.join(", "))
}
