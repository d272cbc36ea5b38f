//! The bounds of one call of a procedure, and of one instant of a run.

use behaviour::flow::HANDED_MAX;
use std::rc::Rc;

/// The longest text a procedure may make, in bytes.
pub(crate) const TEXT_BYTES: usize = 4 * 1024;
/// The deepest nesting of lists and objects that may flow.
pub(crate) const VALUE_DEPTH: usize = 32;

/// The bounds of one call of a procedure, and of one instant.
#[derive(Clone)]
pub struct Limits {
    /// Steps of computation, each about a tenth of a microsecond of work; work on large values takes more of them.
    /// 10,000 steps end a runaway procedure within 2 ms, the same way everywhere, since only sizes count.
    pub operations: u64,
    /// Helpers and closures calling each other.
    pub levels: usize,
    /// Nesting of an expression, and of one inside a helper or closure.
    pub depths: (usize, usize),
    /// Bytes in all texts of one value.
    pub text_bytes: usize,
    /// Items in all lists of one value.
    pub list_items: usize,
    /// Fields in all objects of one value.
    pub map_fields: usize,
    /// Variables at one moment.
    pub variables: usize,
    /// Closures in one procedure.
    pub functions: usize,
    /// True if procedures are compiled where that is possible; otherwise Rhai runs them all, with the same results.
    pub compiled: bool,
    /// The most times that the values that one reading becomes, or one tick, may be handed to a connector. Beyond it
    /// the run ends, at the same value everywhere. A graph with more connectors than that may have each of them take
    /// one.
    pub handed: u64,
    /// Asked now and then while a procedure runs; true ends it. The caller's wall deadline and Stop.
    pub interrupt: Option<Rc<dyn Fn() -> bool>>,
    /// Asked now and then while values are on their way; true ends the run. The caller's Stop.
    pub stop: Option<Rc<dyn Fn() -> bool>>,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            operations: 10_000,
            levels: 16,
            depths: (32, 32),
            text_bytes: TEXT_BYTES,
            list_items: 1024,
            map_fields: 256,
            variables: 128,
            functions: 32,
            compiled: true,
            handed: HANDED_MAX,
            interrupt: None,
            stop: None,
        }
    }
}

impl Limits {
    /// Adds a hook that is asked now and then; true ends the procedure that runs.
    #[must_use]
    pub fn interrupted_by(mut self, hook: impl Fn() -> bool + 'static) -> Self {
        self.interrupt = Some(Rc::new(hook));
        self
    }

    /// Adds a hook that is asked now and then while values are on their way; true ends the run.
    #[must_use]
    pub fn stopped_by(mut self, hook: impl Fn() -> bool + 'static) -> Self {
        self.stop = Some(Rc::new(hook));
        self
    }
}
