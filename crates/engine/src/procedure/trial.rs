//! Procedures outside a run: whether a body is one, and what it makes of some inputs.

use crate::cost::Limits;
use crate::procedure::Procedure;
use crate::procedure::helpers::{Helpers, check_distinct};
use crate::procedure::parse::compile;
use crate::rhai::maths::has_power;
use crate::rhai::sandbox::hardened_engine;
use behaviour::{FileHelper, Value};

thread_local! {
    /// Made once per thread: it takes longer than reading a body. Reading changes nothing in it.
    static CHECKING: rhai::Engine = hardened_engine(&Limits::default());
}

/// Whether a body with these arguments is a procedure.
///
/// # Errors
/// One short reason with its place: `line 1, column 12: a closing ) is missing`.
pub fn check_body(arguments: &[String], body: &str) -> Result<(), String> {
    check_distinct(arguments)?;
    CHECKING.with(|engine| compile(engine, arguments, body).map(drop))
}

/// What a body makes of some inputs, for the preview beside the editor.
///
/// # Errors
/// A short reason, if it is no procedure or faults on these inputs.
pub fn try_body(
    helpers: &[FileHelper],
    arguments: &[String],
    body: &str,
    inputs: &[Value],
    limits: &Limits,
) -> Result<Value, String> {
    check_distinct(arguments)?;
    if arguments.len() != inputs.len() {
        return Err(format!("it takes {} values, but gets {}", arguments.len(), inputs.len()));
    }
    let mut engine = hardened_engine(limits);
    let powers = has_power(body) || helpers.iter().any(|helper| has_power(&helper.body));
    engine.set_fast_operators(!powers);
    let first = |faults: Vec<crate::Fault>| faults.first().map_or_else(String::new, ToString::to_string);
    let helpers = Helpers::compile(&engine, helpers, limits).map_err(first)?;
    let mut procedure = Procedure::compile(&engine, &helpers, arguments, body)?;
    procedure.call(&engine, &inputs.iter().collect::<Vec<_>>()).map_err(|failed| failed.reason)
}
