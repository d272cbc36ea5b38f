//! Procedures outside a run: whether a body is one, and what it makes of some inputs.

use crate::cost::Limits;
use crate::faults::{BodyFault, TrialFault};
use crate::procedure::ConnectorProcedure;
use crate::procedure::helpers::{HelperPrograms, check_distinct};
use crate::procedure::parse::compile;
use crate::rhai::maths::has_power;
use crate::rhai::sandbox::hardened_engine;
use behaviour::{FileHelper, Value};

thread_local! {
    /// Made once per thread: it takes longer than reading a body. Reading changes nothing in it.
    static CHECKING: rhai::Engine = hardened_engine(&Limits::default());
}

/// Checks that a body with these arguments is a procedure.
///
/// # Errors
/// The first reason why not.
pub fn check_body(arguments: &[String], body: &str) -> Result<(), BodyFault> {
    check_distinct(arguments)?;
    CHECKING.with(|engine| compile(engine, arguments, body).map(drop))
}

/// Returns the value that a body makes of some inputs, for the preview beside the editor.
///
/// # Errors
/// Returns the reason if it is no procedure or faults on these inputs.
pub fn try_body(
    helpers: &[FileHelper],
    arguments: &[String],
    body: &str,
    inputs: &[Value],
    limits: &Limits,
) -> Result<Value, TrialFault> {
    check_distinct(arguments)?;
    if arguments.len() != inputs.len() {
        return Err(TrialFault::Inputs { takes: arguments.len(), gets: inputs.len() });
    }
    let mut engine = hardened_engine(limits);
    let powers = has_power(body) || helpers.iter().any(|helper| has_power(&helper.body));
    engine.set_fast_operators(!powers);
    let helpers = HelperPrograms::compile(&engine, helpers, limits).map_err(TrialFault::Helpers)?;
    let mut procedure = ConnectorProcedure::compile(&engine, &helpers, arguments, body)?;
    procedure.call(&engine, &inputs.iter().collect::<Vec<_>>()).map_err(TrialFault::Call)
}
