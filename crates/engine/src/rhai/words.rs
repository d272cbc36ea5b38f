//! Rhai's refusals and faults in plain words.

use crate::cost::callers::is_caller;
use crate::rhai::conversion::from_rhai;
use crate::rhai::sandbox::is_interrupted;
use rhai::{Dynamic, EvalAltResult, LexError, ParseError, ParseErrorType, Position};

/// Why a text is no procedure: `line 1, column 12: a closing ) is missing`.
pub(crate) fn refusal(error: &ParseError, arguments: &[String]) -> String {
    placed(error.position(), &parse_words(error.err_type(), arguments))
}

/// A reason with its place in front.
pub(crate) fn placed(at: Position, reason: &str) -> String {
    match (at.line(), at.position()) {
        (Some(line), Some(column)) => format!("line {line}, column {column}: {reason}"),
        (Some(line), None) => format!("line {line}: {reason}"),
        (None, _) => reason.to_owned(),
    }
}

fn parse_words(error: &ParseErrorType, arguments: &[String]) -> String {
    use ParseErrorType as E;
    match error {
        E::BadInput(error) => lex_words(error),
        E::MissingToken(token, _) if matches!(token.as_str(), ")" | "]" | "}") => {
            format!("a closing {token} is missing")
        }
        E::MissingToken(token, _) => format!("{token} is missing"),
        E::UnexpectedEOF => "it ends too early".to_owned(),
        E::VariableUndefined(name) => unknown_name(name, arguments),
        E::ModuleUndefined(name) => format!("there is no “{name}”"),
        E::Reserved(name) => format!("“{name}” cannot be used here"),
        E::ExprTooDeep => "it is nested too deep; move a part into a helper".to_owned(),
        E::ExprExpected(what) => format!("{what} is missing"),
        E::LiteralTooLarge(..) => "a text, list or object is too large".to_owned(),
        E::MismatchedType(wanted, got) => format!("{} is needed here, not {}", kind_of(wanted), kind_of(got)),
        E::TooManyFunctions => "it has too many closures".to_owned(),
        E::LoopBreak => "break and continue belong inside a loop".to_owned(),
        other => plain(&other.to_string()),
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
        return format!("there is no value “{name}”");
    }
    format!("there is no value “{name}”, only {}", arguments.join(", "))
}

/// Lower case in front, no dot at the end, one line.
fn plain(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default().trim().trim_end_matches('.');
    let mut rest = line.chars();
    rest.next().map_or_else(String::new, |first| first.to_lowercase().chain(rest).collect())
}

/// What went wrong while a procedure ran, and what to do about it.
pub(crate) fn fault(error: &EvalAltResult) -> String {
    use EvalAltResult as E;
    match error {
        E::ErrorInFunctionCall(name, _, inner, _) if is_closure(name) || is_caller(name) => fault(inner),
        E::ErrorInFunctionCall(name, _, inner, _) => format!("in the helper “{name}”: {}", fault(inner)),
        E::ErrorRuntime(thrown, _) => plain(&thrown_words(thrown)),
        error => match advice(error) {
            Some(advice) => format!("{}; {advice}", happened(error)),
            None => happened(error),
        },
    }
}

fn happened(error: &EvalAltResult) -> String {
    use EvalAltResult as E;
    match error {
        E::ErrorArithmetic(what, _) => arithmetic(what),
        E::ErrorPropertyNotFound(name, _) => format!("there is no field “{name}” in this object"),
        E::ErrorDotExpr(what, _) => no_field(what),
        E::ErrorFunctionNotFound(signature, _) => no_function(signature),
        E::ErrorMismatchDataType(wanted, got, _) | E::ErrorMismatchOutputType(wanted, got, _) => {
            format!("{} is needed here, not {}", kind_of(wanted), kind_of(got))
        }
        E::ErrorIndexingType(kind, _) => {
            let kind = kind.split(" [").next().unwrap_or_default();
            format!("{} has no parts to take with [ ]", kind_of(kind))
        }
        E::ErrorArrayBounds(many, at, _) => format!("there is no item {at} in a list of {many}"),
        E::ErrorStringBounds(many, at, _) => format!("there is no letter {at} in a text of {many}"),
        E::ErrorVariableNotFound(name, _) => format!("there is no value “{name}”"),
        E::ErrorFor(_) => "for goes through a list, a text or a range only".to_owned(),
        E::ErrorTerminated(token, _) if is_interrupted(token) => "it took too long and was ended".to_owned(),
        E::ErrorTerminated(..) => "it takes too many steps".to_owned(),
        E::ErrorStackOverflow(_) => "calls are nested too deep".to_owned(),
        E::ErrorDataTooLarge(..) => "a text, list or object became too large".to_owned(),
        E::ErrorTooManyVariables(_) => "it has too many variables".to_owned(),
        other => plain(&other.to_string()),
    }
}

/// What to do about it, where that can be said.
fn advice(error: &EvalAltResult) -> Option<&'static str> {
    use EvalAltResult as E;
    Some(match error {
        E::ErrorArithmetic(what, _) if is_by_zero(what) => "check first that the number is not 0",
        E::ErrorArithmetic(what, _) if is_overflow(what) => "use a measured number, such as 1.0",
        E::ErrorPropertyNotFound(..) | E::ErrorVariableNotFound(..) => "check how its name is written",
        E::ErrorDotExpr(..) => "take fields of objects only",
        E::ErrorFunctionNotFound(signature, _) if is_operator(signature) => "take a field or an item of the right kind",
        E::ErrorFunctionNotFound(..) => "check its name and what it is given",
        E::ErrorMismatchDataType(..) | E::ErrorMismatchOutputType(..) => "change what stands here",
        E::ErrorIndexingType(..) => "take parts of lists, objects and texts only",
        E::ErrorArrayBounds(..) | E::ErrorStringBounds(..) => "ask for its length first, and count from 0",
        E::ErrorFor(_) => "give it one of these",
        E::ErrorTerminated(token, _) if is_interrupted(token) => "let it do less for one value",
        E::ErrorTerminated(..) => "look for a loop without an end, or use smaller lists and texts",
        E::ErrorStackOverflow(_) => "let fewer helpers and closures call each other",
        E::ErrorDataTooLarge(..) => "keep only what is needed of it",
        E::ErrorTooManyVariables(_) => "move a part into a helper",
        _ => return None,
    })
}

/// What a procedure threw. Rhai's own way to write it calls itself as deep as the value is nested.
fn thrown_words(thrown: &Dynamic) -> String {
    if let Ok(text) = thrown.as_immutable_string_ref() {
        return text.to_string();
    }
    from_rhai(thrown.clone()).map_or_else(|reason| reason, |value| value.to_string())
}

fn is_closure(name: &str) -> bool {
    name.starts_with("anon$")
}

fn arithmetic(what: &str) -> String {
    if is_by_zero(what) {
        "division by zero has no result".to_owned()
    } else if is_overflow(what) {
        "a whole number became too large".to_owned()
    } else {
        plain(&what.to_lowercase())
    }
}

fn is_by_zero(what: &str) -> bool {
    let what = what.to_lowercase();
    what.contains("by zero") || what.contains("zero division")
}

fn is_overflow(what: &str) -> bool {
    what.to_lowercase().contains("overflow")
}

/// From `Unknown property 'x' - a getter is not registered for type 'i64'` and the like.
fn no_field(what: &str) -> String {
    let quoted: Vec<&str> = what.split('\'').skip(1).step_by(2).collect();
    match quoted.as_slice() {
        [field, kind, ..] => format!("{} has no field “{field}”", kind_of(kind)),
        _ => plain(what),
    }
}

/// From a signature such as `- (map, i64)` or `distanc (f64)`.
fn no_function(signature: &str) -> String {
    let (name, kinds) = signature.split_once(" (").unwrap_or((signature, ""));
    let kinds: Vec<&str> =
        kinds.trim_end_matches(')').split(", ").filter(|kind| !kind.is_empty()).map(kind_of).collect();
    let operator = is_operator(signature);
    match kinds.as_slice() {
        [left, right] if operator => format!("{left} and {right} cannot be combined with {name}"),
        [one] if operator => format!("{name} does not work on {one}"),
        [] => format!("there is no function “{name}”"),
        kinds => format!("there is no function “{name}” of {}", kinds.join(" and ")),
    }
}

fn is_operator(signature: &str) -> bool {
    !signature.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Rhai's name of a kind of value in words.
pub(crate) fn kind_of(name: &str) -> &str {
    match name {
        "()" => "nothing",
        "i64" | "int" => "a whole number",
        "f64" | "float" => "a measured number",
        "bool" | "a boolean expression" => "true or false",
        "char" => "a letter",
        "map" => "an object",
        "array" => "a list",
        "Fn" => "a function",
        name if name.contains("string") || name.contains("String") || name == "&str" => "a text",
        name if name.contains("Range") || name == "range" || name == "range=" => "a range",
        name => name,
    }
}
