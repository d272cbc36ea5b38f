//! The functions a procedure can call: Rhai's own without time and bytes, ours over them.

use crate::{charged, lists, maths, texts};
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

/// What counts the cost of the others.
fn counted(others: &[Shared<Module>]) -> Shared<Module> {
    let mut module = Module::new();
    charged::register(&mut module, others);
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
