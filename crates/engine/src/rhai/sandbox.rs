//! The one Rhai engine that procedures run in: it can compute, and nothing else.

use crate::cost::Limits;
use crate::cost::meter;
use crate::cost::variable_cost;
use crate::rhai::fields;
use crate::rhai::library::library;
use rhai::{Dynamic, Engine};
use std::cell::Cell;

/// The quarters of a step that pass between two questions to the interrupt.
const QUARTERS_PER_QUESTION: u64 = 64;
/// Tells in Rhai's words that the caller ended a call.
const INTERRUPTED: bool = true;

/// Words of Rhai that a procedure may not use, refused while reading it.
const REFUSED_WORDS: [&str; 5] = ["eval", "import", "export", "print", "debug"];

/// A Rhai engine with all limits on and no way out: no files, time, sleep, printing, `eval` or `import`.
pub(crate) fn hardened_engine(limits: &Limits) -> Engine {
    let mut engine = Engine::new_raw();
    for module in library() {
        engine.register_global_module(module);
    }
    engine.set_strict_variables(true).set_fail_on_invalid_map_property(true);
    for word in REFUSED_WORDS {
        engine.disable_symbol(word);
    }
    fields::allow_reserved_names(&mut engine);
    set_limits(&mut engine, limits);
    count_steps(&mut engine, limits);
    watch_variables(&mut engine);
    engine
}

fn set_limits(engine: &mut Engine, limits: &Limits) {
    engine
        .set_max_call_levels(limits.levels)
        .set_max_expr_depths(limits.depths.0, limits.depths.1)
        .set_max_string_size(limits.text_bytes)
        .set_max_array_size(limits.list_items)
        .set_max_map_size(limits.map_fields)
        .set_max_variables(limits.variables)
        .set_max_functions(limits.functions);
}

/// Counts the steps of a call and ends it at the limit, or when the interrupt says so.
///
/// Rhai's own count forgets what closures do that its functions call: one that sorts or maps could run for hours. And it
/// counts one for a part of a procedure, however large the values are: the others are owed ([`meter`], [`variable_cost`]).
/// Once a call is over, every further step of it is refused, so no `catch` can hold it.
fn count_steps(engine: &mut Engine, limits: &Limits) {
    let (quarters_max, interrupt) =
        (limits.operations.saturating_mul(variable_cost::PLAIN_QUARTERS), limits.interrupt.clone());
    let (done, over) = (Cell::new(0_u64), Cell::new(None::<bool>));
    engine.on_progress(move |rhai_count| {
        if rhai_count == 1 {
            done.set(0);
            over.set(None);
            meter::forget();
        }
        let before = done.get();
        let quarters = before
            .saturating_add(variable_cost::quarters())
            .saturating_add(meter::owed_steps().saturating_mul(variable_cost::PLAIN_QUARTERS));
        done.set(quarters);
        if quarters > quarters_max {
            over.set(over.get().or(Some(!INTERRUPTED)));
        } else if over.get().is_none()
            && quarters / QUARTERS_PER_QUESTION > before / QUARTERS_PER_QUESTION
            && interrupt.as_ref().is_some_and(|ended| ended())
        {
            over.set(Some(INTERRUPTED));
        }
        over.get().map(Dynamic::from_bool)
    });
}

/// Lets the variables pay that a procedure reads.
fn watch_variables(engine: &mut Engine) {
    #[expect(deprecated, reason = "not deprecated: Rhai marks the call as one that may change; its version is pinned")]
    engine.on_var(|name, _, context| {
        variable_cost::read(name, context.scope());
        Ok(None)
    });
}

/// True if the caller ended the call, by the token that Rhai tells.
pub(crate) fn is_interrupted(token: &Dynamic) -> bool {
    token.as_bool() == Ok(INTERRUPTED)
}
