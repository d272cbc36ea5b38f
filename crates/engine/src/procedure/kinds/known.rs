//! The cache while kinds are told: procedures that were read, and the names of functions.

use crate::cost::Limits;
use crate::cost::metered::known;
use crate::faults::BodyFault;
use crate::procedure::helpers::check_distinct;
use crate::procedure::parse::compile;
use crate::rhai::sandbox::hardened_engine;
use behaviour::{FillFrom, Lookup};
use rhai::AST;
use std::cell::RefCell;
use std::rc::Rc;

/// The texts of all procedures that are kept, in bytes; then it is begun anew.
const KEPT_MAX_BYTES: usize = 512 << 10;
/// The most procedures that are kept.
const KEPT_MAX: usize = 8_192;

/// A procedure that was read, or why it is none.
type ReadKinds = Result<Rc<AST>, BodyFault>;

#[derive(Default)]
struct KindCache {
    read: Lookup<(Vec<String>, String), ReadKinds>,
    bytes: usize,
}

thread_local! {
    static READING: rhai::Engine = hardened_engine(&Limits::default());
    static KEPT: RefCell<KindCache> = RefCell::default();
    /// Making an engine's list takes longer than reading a body.
    static FUNCTIONS: Vec<String> = names_of_functions();
}

/// A body as Rhai reads it, kept for the next time.
pub(super) fn parsed(names: &[String], body: &str) -> ReadKinds {
    let question = (names.to_vec(), body.to_owned());
    KEPT.with(|kept| {
        if let Some(read) = kept.borrow().read.get(&question) {
            return read.clone();
        }
        let compiled = || READING.with(|engine| compile(engine, names, body).map(Rc::new));
        let read: ReadKinds = check_distinct(names).and_then(|()| compiled());
        let mut kept = kept.borrow_mut();
        if kept.bytes + body.len() > KEPT_MAX_BYTES || kept.read.len() >= KEPT_MAX {
            *kept = KindCache::default();
        }
        kept.bytes += body.len();
        kept.read.insert(question, read.clone());
        read
    })
}

/// Looks at the names of all functions that procedures can call, each once, in order.
pub(super) fn function_names<T>(look: impl FnOnce(&[String]) -> T) -> T {
    FUNCTIONS.with(|names| look(names))
}

fn names_of_functions() -> Vec<String> {
    let all = READING.with(|engine| engine.collect_fn_metadata(None, known, true));
    let names = all.into_iter().map(|(name, _)| name);
    names.filter(|name| behaviour::is_identifier(name)).distinct()
}
