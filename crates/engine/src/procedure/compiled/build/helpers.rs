//! The compiled helpers, each once, for every body that calls them.

use crate::cost::Limits;
use crate::procedure::compiled::bounds::ProcedureBounds;
use crate::procedure::compiled::node::ProcedureNode;
use behaviour::Lookup;
use rhai::AST;
use std::rc::Rc;

/// A compiled helper.
pub(in crate::procedure::compiled) struct CompiledHelper {
    pub(in crate::procedure::compiled) root: Rc<ProcedureNode>,
    /// At least the steps that Rhai counts for one call.
    pub(in crate::procedure::compiled) steps: u64,
    /// The depth to which one call nests.
    pub(in crate::procedure::compiled) depth: usize,
    /// The number of helpers that call each other in it, itself included.
    pub(in crate::procedure::compiled) levels: usize,
}

/// All helpers by name and number of parameters; nothing for one that only Rhai can run.
pub(crate) struct CompiledHelpers {
    pieces: Lookup<(String, usize), Option<CompiledHelper>>,
    limits: Limits,
    bounds: Rc<ProcedureBounds>,
}

impl CompiledHelpers {
    /// None yet.
    pub(crate) fn of(limits: &Limits) -> Self {
        Self { pieces: Lookup::new(), limits: limits.clone(), bounds: Rc::new(ProcedureBounds::of(limits)) }
    }

    /// Adds a helper. The ones it calls must be here before it.
    pub(crate) fn add(&mut self, name: &str, params: &[String], ast: &AST) {
        let piece = super::helper(ast, params, self);
        self.pieces.insert((name.to_owned(), params.len()), piece);
    }

    pub(in crate::procedure::compiled) fn has(&self, name: &str, parameters: usize) -> bool {
        self.pieces.contains_key(&(name.to_owned(), parameters))
    }

    pub(in crate::procedure::compiled) fn piece(&self, name: &str, parameters: usize) -> Option<&CompiledHelper> {
        self.pieces.get(&(name.to_owned(), parameters))?.as_ref()
    }

    pub(in crate::procedure::compiled) fn limits(&self) -> &Limits {
        &self.limits
    }

    pub(in crate::procedure::compiled) fn bounds(&self) -> Rc<ProcedureBounds> {
        self.bounds.clone()
    }
}
