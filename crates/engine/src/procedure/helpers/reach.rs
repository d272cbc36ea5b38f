//! The bounds of one call of each helper, and the helpers that a body may reach.

use crate::cost::callers::is_caller;
use crate::cost::variable_cost::VariableCost;
use crate::procedure::walk::{self, Search};
use behaviour::Lookup;
use rhai::AST;

/// The helpers by name, those that are called before those that call them.
#[derive(Default)]
pub(super) struct HelperReach {
    names: Lookup<String, usize>,
    lengths: Vec<Length>,
}

/// The bounds of a helper's run.
pub(super) struct Length {
    /// The parts that one call computes at most; nothing without such a bound.
    pub(super) parts: Option<u64>,
    /// The cost of the helper's variables.
    pub(super) cost: VariableCost,
    /// The cost of looking for functions.
    pub(super) search: Search,
    /// The number of the helper's parameters.
    pub(super) params: usize,
    /// Helpers that it calls.
    calls: Vec<usize>,
    /// True if it may call any other helper, by a text.
    names_others: bool,
}

impl HelperReach {
    /// Adds a helper. The ones that it calls must be here before it.
    pub(super) fn add(&mut self, name: &str, params: usize, body: &AST, called: &[String], search: Search) {
        let length = Length {
            parts: walk::length(body, &|helper| self.get(helper).map(|length| length.parts)),
            cost: VariableCost::of(body, true),
            search,
            params,
            calls: called.iter().filter_map(|name| self.names.get(name).copied()).collect(),
            names_others: names_others(called),
        };
        self.names.insert(name.to_owned(), self.lengths.len());
        self.lengths.push(length);
    }

    /// One helper.
    pub(super) fn get(&self, name: &str) -> Option<&Length> {
        self.names.get(name).map(|at| &self.lengths[*at])
    }

    /// The helpers that may be called, also through others; all where a text may name one.
    pub(super) fn reached(&self, called: &[String]) -> impl Iterator<Item = &Length> {
        let mut all = names_others(called);
        let mut seen = vec![false; self.lengths.len()];
        let mut open: Vec<usize> = called.iter().filter_map(|name| self.names.get(name).copied()).collect();
        while let Some(at) = open.pop() {
            if !std::mem::replace(&mut seen[at], true) {
                let length = &self.lengths[at];
                all |= length.names_others;
                open.extend(&length.calls);
            }
        }
        self.lengths.iter().zip(seen).filter(move |(_, seen)| all || *seen).map(|(length, _)| length)
    }
}

/// True for what calls functions by their name in a text, or may.
fn names_others(called: &[String]) -> bool {
    called.iter().any(|name| name == "Fn" || is_caller(name))
}
