//! The first of two tiers: the common part of procedures as a small tree over our own values, many times faster than
//! Rhai. Rhai stays the only authority. It has read the text before; what the tree does not know is not compiled, and
//! where a compiled procedure meets anything it is not sure of (a fault, two kinds of values that do not mix, a size
//! near its bound) it gives up, and Rhai computes the same call again. So every fault has Rhai's words, and the tree
//! only has to be right where it answers. It has no loops and no recursion, so it always ends.

mod bounds;
mod build;
mod chain;
mod compare;
mod functions;
mod literals;
mod name;
mod node;
mod numbers;
#[cfg(test)]
mod tests;

use crate::values::in_place::ComputedNumber;
use behaviour::Value;
use bounds::ProcedureBounds;
use node::{Env, ProcedureNode};
use rhai::AST;
use std::rc::Rc;

pub(crate) use build::helpers::CompiledHelpers;
pub(crate) use compare::CompiledComparison;
pub(crate) use numbers::Operator;

/// The tree is not sure what Rhai would say.
#[derive(Debug)]
pub(crate) struct Unsure;

/// A compiled procedure.
pub(crate) struct Compiled {
    root: ProcedureNode,
    bounds: Rc<ProcedureBounds>,
    says: MadeKind,
}

/// A procedure that is one operation of its first input and a number: `x + 1`, `distance > 2.0`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Short {
    Compute(Operator, ComputedNumber),
    Compare(CompiledComparison, ComputedNumber),
}

/// The kind of value that it makes, as far as its form tells.
#[derive(PartialEq)]
enum MadeKind {
    Number,
    Truth,
    Object,
    Anything,
}

impl Compiled {
    /// Compiles a body, if all of it is known here.
    pub(crate) fn of(ast: &AST, names: &[String], helpers: &CompiledHelpers) -> Option<Self> {
        let root = build::body(ast, names, helpers)?;
        let says = match &root {
            root if root.is_numeric() => MadeKind::Number,
            ProcedureNode::Compare(..) | ProcedureNode::Not(_) | ProcedureNode::All(_) | ProcedureNode::Any(_) => {
                MadeKind::Truth
            }
            ProcedureNode::Object(object) if object.1.iter().all(ProcedureNode::is_numeric) => MadeKind::Object,
            _ => MadeKind::Anything,
        };
        Some(Self { root, bounds: helpers.bounds(), says })
    }

    /// Returns the one operation of the procedure, if it is no more than that.
    pub(crate) fn short(&self) -> Option<Short> {
        let number = |pair: &(ProcedureNode, ProcedureNode)| match pair {
            (ProcedureNode::Input(0), ProcedureNode::Constant(value)) => ComputedNumber::of(value).ok(),
            _ => None,
        };
        match &self.root {
            ProcedureNode::Arithmetic(operator, pair) => Some(Short::Compute(*operator, number(pair)?)),
            ProcedureNode::Compare(comparison, pair) => Some(Short::Compare(*comparison, number(pair)?)),
            _ => None,
        }
    }

    /// The number it makes of the inputs; nothing if it makes another value or Rhai must decide.
    #[inline]
    pub(crate) fn number(&self, inputs: &[&Value]) -> Option<ComputedNumber> {
        let made = if self.says == MadeKind::Number { self.root.short_number(&self.env(inputs)).ok() } else { None };
        made.filter(|number| number.is_finite())
    }

    /// Tells if it finds the inputs true; none if it makes another value or Rhai must decide.
    #[inline]
    pub(crate) fn truth(&self, inputs: &[&Value]) -> Option<bool> {
        if self.says == MadeKind::Truth { self.root.short_truth(&self.env(inputs)).ok() } else { None }
    }

    /// Makes an object of numbers over an older one that it made. False leaves `spare` with no meaning.
    #[inline]
    pub(crate) fn object(&self, inputs: &[&Value], spare: &mut Value) -> bool {
        self.says == MadeKind::Object && self.root.over(&self.env(inputs), spare).is_some()
    }

    #[inline]
    fn env<'a>(&'a self, inputs: &'a [&'a Value]) -> Env<'a> {
        Env { inputs, locals: None, bounds: &self.bounds }
    }

    /// Returns the value that the procedure makes of the inputs; none if Rhai must decide.
    pub(crate) fn call(&self, inputs: &[&Value]) -> Option<Value> {
        let made = self.root.value(&self.env(inputs)).ok()?;
        bounds::may_flow(&made).then(|| made.into_owned())
    }
}
