//! The functions a procedure can call: Rhai's own without time and bytes, ours over them.

use crate::cost::metered;
use crate::rhai::lists;
use crate::rhai::maths;
use crate::rhai::texts;
use rhai::packages::{
    BasicArrayPackage, BasicMapPackage, BasicMathPackage, BitFieldPackage, CorePackage, LogicPackage,
    MoreStringPackage, Package,
};
use rhai::{EvalAltResult, FuncRegistration, Module, Position, Shared};

/// Functions of Rhai's core that wait, read text as program or tell about the program.
const REFUSED: [&str; 5] = ["sleep", "timestamp", "parse_json", "get_fn_metadata_list", "is_def_fn"];

thread_local! {
    /// Made once per thread: building it takes longer than building a behaviour.
    static LIBRARY: Vec<Shared<Module>> = build();
}

/// The modules of the library; the later ones win.
pub(crate) fn library() -> Vec<Shared<Module>> {
    LIBRARY.with(Clone::clone)
}

/// True for a function that procedures may not call.
pub(crate) fn is_refused(name: &str) -> bool {
    REFUSED.contains(&name)
}

fn build() -> Vec<Shared<Module>> {
    let mut all = vec![
        CorePackage::new().as_shared_module(),
        BitFieldPackage::new().as_shared_module(),
        LogicPackage::new().as_shared_module(),
        BasicMathPackage::new().as_shared_module(),
        BasicArrayPackage::new().as_shared_module(),
        BasicMapPackage::new().as_shared_module(),
        MoreStringPackage::new().as_shared_module(),
        ours(),
    ];
    all.push(counted(&all));
    all
}

/// Returns the module that counts the cost of the others.
fn counted(others: &[Shared<Module>]) -> Shared<Module> {
    let mut module = Module::new();
    metered::register(&mut module, others);
    module.build_index();
    module.into()
}

fn ours() -> Shared<Module> {
    let mut module = Module::new();
    maths::register(&mut module);
    texts::register(&mut module);
    lists::register(&mut module);
    refuse_waiting(&mut module);
    module.build_index();
    module.into()
}

/// `disable_symbol("sleep")` has no effect in Rhai, and a function pointer would reach it anyway: put others in place.
fn refuse_waiting(module: &mut Module) {
    FuncRegistration::new("sleep").set_into_module(module, |_seconds: i64| refused("sleep"));
    FuncRegistration::new("sleep").set_into_module(module, |_seconds: f64| refused("sleep"));
    FuncRegistration::new("parse_json").set_into_module(module, |_text: &str| refused("parse_json"));
}

fn refused(name: &str) -> Result<(), Box<EvalAltResult>> {
    Err(EvalAltResult::ErrorFunctionNotFound(name.to_owned(), Position::NONE).into())
}

#[cfg(test)]
mod tests {
    use crate::cost::Limits;
    use crate::cost::metered::{is_counted, known};
    use crate::rhai::sandbox::hardened_engine;

    /// A later version of Rhai may add functions that are counted without a word; this test misses them, so that they
    /// are tried in the corpus too.
    #[test]
    fn every_function_of_large_values_is_tried_without_end() {
        let corpus =
            concat!(include_str!("../../tests/hostile/builtins.rs"), include_str!("../../tests/hostile/scripts.rs"));
        let all = hardened_engine(&Limits::default()).collect_fn_metadata(None, known, true);
        let counted = all.into_iter().filter(|(name, types)| is_counted(name, types)).map(|(name, _)| name);
        let missed: Vec<_> = counted.filter(|name| !corpus.contains(tried(name))).collect();
        assert!(missed.is_empty(), "{missed:?}");
    }

    /// Returns the form in which a function is written in a procedure.
    fn tried(name: &str) -> &str {
        match name.strip_prefix("get$").unwrap_or(name) {
            // These are refused, or blobs, which cannot be made.
            "parse_json" | "print" | "debug" | "get_fn_metadata_list" => "",
            name => name,
        }
    }
}
