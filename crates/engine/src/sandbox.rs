//! The one Rhai engine that procedures run in: it can compute, and nothing else.

use crate::fields;
use crate::library::library;
use crate::limits::Limits;
use rhai::{Dynamic, Engine};

/// How many steps pass between two questions to the interrupt.
const STEPS_PER_QUESTION: u64 = 64;

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
    ask_now_and_then(&mut engine, limits);
    engine
}

fn set_limits(engine: &mut Engine, limits: &Limits) {
    engine
        .set_max_operations(limits.operations)
        .set_max_call_levels(limits.levels)
        .set_max_expr_depths(limits.depths.0, limits.depths.1)
        .set_max_string_size(limits.text_bytes)
        .set_max_array_size(limits.list_items)
        .set_max_map_size(limits.map_fields)
        .set_max_variables(limits.variables)
        .set_max_functions(limits.functions)
        .set_max_modules(0);
}

fn ask_now_and_then(engine: &mut Engine, limits: &Limits) {
    if let Some(interrupt) = limits.interrupt.clone() {
        let ended = move |steps: u64| steps.is_multiple_of(STEPS_PER_QUESTION) && interrupt();
        engine.on_progress(move |steps| ended(steps).then_some(Dynamic::UNIT));
    }
}
