//! The translation of Rhai's errors of a procedure into data.

use crate::cost::callers::is_caller;
use crate::faults::{CallFault, ValueKind};
use crate::rhai::conversion::from_rhai;
use crate::rhai::sandbox::is_interrupted;
use rhai::{Dynamic, EvalAltResult};

/// Returns the fault that an error of Rhai is.
pub(crate) fn fault(error: &EvalAltResult) -> CallFault {
    use EvalAltResult as E;
    match error {
        E::ErrorInFunctionCall(name, _, inner, _) if is_closure(name) || is_caller(name) => fault(inner),
        E::ErrorInFunctionCall(name, _, inner, _) => CallFault::InHelper(name.clone(), Box::new(fault(inner))),
        E::ErrorRuntime(thrown, _) => of_thrown(thrown),
        E::ErrorArithmetic(what, _) => arithmetic(what),
        E::ErrorPropertyNotFound(name, _) => CallFault::NoField(name.clone()),
        E::ErrorDotExpr(what, _) => no_field(what),
        E::ErrorFunctionNotFound(signature, _) => CallFault::NoFunction(signature.clone()),
        E::ErrorMismatchDataType(wanted, got, _) | E::ErrorMismatchOutputType(wanted, got, _) => {
            CallFault::Mismatch(ValueKind::of(wanted), ValueKind::of(got))
        }
        E::ErrorIndexingType(kind, _) => CallFault::NoParts(ValueKind::of(kind.split(" [").next().unwrap_or_default())),
        E::ErrorArrayBounds(many, at, _) => CallFault::NoItem(*many, *at),
        E::ErrorStringBounds(many, at, _) => CallFault::NoLetter(*many, *at),
        E::ErrorVariableNotFound(name, _) => CallFault::NoValue(name.clone()),
        E::ErrorFor(_) => CallFault::NotIterable,
        E::ErrorTerminated(token, _) if is_interrupted(token) => CallFault::Interrupted,
        E::ErrorTerminated(..) => CallFault::Steps,
        E::ErrorStackOverflow(_) => CallFault::Nested,
        E::ErrorDataTooLarge(..) => CallFault::TooLarge,
        E::ErrorTooManyVariables(_) => CallFault::Variables,
        other => CallFault::Rhai(other.to_string()),
    }
}

/// Returns the fault of a thrown value. Rhai's own way to write it calls itself as deep as the value is nested.
fn of_thrown(thrown: &Dynamic) -> CallFault {
    if let Ok(text) = thrown.as_immutable_string_ref() {
        return CallFault::Said(text.to_string());
    }
    from_rhai(thrown.clone()).map_or_else(CallFault::Value, CallFault::Thrown)
}

fn is_closure(name: &str) -> bool {
    name.starts_with("anon$")
}

fn arithmetic(what: &str) -> CallFault {
    let what = what.to_lowercase();
    if what.contains("by zero") || what.contains("zero division") {
        CallFault::ByZero
    } else if what.contains("overflow") {
        CallFault::Overflow
    } else {
        CallFault::Arithmetic(what)
    }
}

/// From `Unknown property 'x' - a getter is not registered for type 'i64'` and the like.
fn no_field(what: &str) -> CallFault {
    let quoted: Vec<&str> = what.split('\'').skip(1).step_by(2).collect();
    match quoted.as_slice() {
        [field, kind, ..] => CallFault::NoFieldOf(ValueKind::of(kind), (*field).to_owned()),
        _ => CallFault::Field(what.to_owned()),
    }
}
