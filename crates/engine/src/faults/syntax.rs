//! The reasons why Rhai cannot read a text, in plain words.

use super::ValueKind;
use super::place::TextPlace;
use super::plain::plain;
use phrase::{Phrase, Phrased, phrase};
use rhai::{LexError, ParseError, ParseErrorType};

/// The reason why a text cannot be read as a procedure. [`std::fmt::Display`] says it in a few English words with its place.
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

    fn why(&self) -> Phrase {
        use ParseErrorType as E;
        match self.error.err_type() {
            E::BadInput(error) => lex_words(error),
            E::MissingToken(token, _) if matches!(token.as_str(), ")" | "]" | "}") => {
                phrase!("Syntax.Closing", "a closing {token} is missing")
            }
            E::MissingToken(token, _) | E::ExprExpected(token) => {
                phrase!("Syntax.Missing", "{token} is missing", token = missing(token))
            }
            E::UnexpectedEOF => phrase!("Syntax.End", "it ends too early"),
            E::VariableUndefined(name) => unknown_name(name, &self.arguments),
            E::ModuleUndefined(name) => phrase!("Syntax.NoModule", "there is no “{name}”"),
            E::Reserved(name) => phrase!("Syntax.Reserved", "“{name}” cannot be used here"),
            E::ExprTooDeep => phrase!("Syntax.TooDeep", "it is nested too deep; move a part into a helper"),
            E::LiteralTooLarge(..) => phrase!("Syntax.TooLarge", "a text, list or object is too large"),
            E::MismatchedType(wanted, got) => {
                let (wanted, got) = (ValueKind::of(wanted), ValueKind::of(got));
                phrase!("CallFault.Mismatch", "{wanted} is needed here, not {got}")
            }
            E::TooManyFunctions => phrase!("Syntax.Closures", "it has too many closures"),
            E::LoopBreak => phrase!("Syntax.LoopBreak", "break and continue belong inside a loop"),
            other => Phrase::Text(plain(&other.to_string())),
        }
    }
}

/// Says a missing token of Rhai: a sign, or one of its words.
fn missing(token: &str) -> Phrase {
    match token {
        "a boolean expression" => phrase!("Syntax.Condition", "a boolean expression"),
        sign => sign.phrase(),
    }
}

phrase::shown!(Syntax);

impl Phrased for Syntax {
    fn phrase(&self) -> Phrase {
        match self.unknown_value() {
            // The name tells where it is.
            Some(_) => self.why(),
            None => TextPlace::from(self.error.position()).of(self.why()),
        }
    }
}

fn lex_words(error: &LexError) -> Phrase {
    match error {
        LexError::UnterminatedString => phrase!("Syntax.Quote", "the closing quote of a text is missing"),
        LexError::UnexpectedInput(name) => phrase!("Syntax.Unexpected", "“{name}” is not expected here"),
        LexError::ImproperSymbol(name, why) if why.ends_with("is disabled") => {
            phrase!("Syntax.Reserved", "“{name}” cannot be used here")
        }
        LexError::ImproperSymbol(name, why) if why.is_empty() => {
            phrase!("Syntax.Unexpected", "“{name}” is not expected here")
        }
        other => Phrase::Text(plain(&other.to_string())),
    }
}

fn unknown_name(name: &str, arguments: &[String]) -> Phrase {
    if arguments.is_empty() {
        return phrase!("CallFault.NoValue", "no “{name}” here");
    }
    phrase!("Syntax.NoValue", "no “{name}” here; there is {arguments}")
}
