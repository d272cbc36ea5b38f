//! From what Rhai has read to our tree; nothing for a procedure with any part that is not known here.

pub(super) mod helpers;

use super::functions::Function;
use super::literals::{constant, operation};
use super::node::ProcedureNode;
use behaviour::{FieldNames, Value};
use helpers::{CompiledHelper, CompiledHelpers};
use rhai::{AST, ASTFlags, Expr, FnCallExpr, Stmt};
use std::rc::Rc;

/// More than the steps that Rhai counts for one part.
const STEPS_PER_PART: u64 = 8;
/// The deepest nesting of the tree and the helpers in it, so that it fits every stack.
const DEPTH_MAX: usize = 96;

/// Builds the tree of one body.
pub(super) struct TreeBuilder<'h> {
    pub(super) helpers: &'h CompiledHelpers,
    /// The names in sight, newest last.
    names: Vec<String>,
    /// The number of those names, at the front, that are inputs.
    inputs: usize,
    steps: u64,
    depth: usize,
    deepest: usize,
    levels: usize,
}

/// The tree of a body with inputs of these names.
pub(super) fn body(ast: &AST, names: &[String], helpers: &CompiledHelpers) -> Option<ProcedureNode> {
    let mut builder = TreeBuilder::of(names, names.len(), helpers);
    let root = builder.sequence(ast.statements())?;
    builder.is_bounded().then_some(root)
}

/// The tree of a helper with these parameters.
pub(super) fn helper(ast: &AST, params: &[String], helpers: &CompiledHelpers) -> Option<CompiledHelper> {
    let mut builder = TreeBuilder::of(params, 0, helpers);
    let root = builder.sequence(ast.statements())?;
    let TreeBuilder { steps, deepest, levels, .. } = builder;
    let piece = || CompiledHelper { root: Rc::new(root), steps, depth: deepest + params.len() + 1, levels: levels + 1 };
    builder.is_bounded().then(piece)
}

impl<'h> TreeBuilder<'h> {
    fn of(names: &[String], inputs: usize, helpers: &'h CompiledHelpers) -> Self {
        Self { helpers, names: names.to_vec(), inputs, steps: 0, depth: 0, deepest: 0, levels: 0 }
    }

    /// True if Rhai would not meet a limit either.
    fn is_bounded(&self) -> bool {
        self.steps <= self.helpers.limits().operations && self.levels < self.helpers.limits().levels
    }

    fn block(&mut self, statements: &[Stmt]) -> Option<ProcedureNode> {
        let seen = self.names.len();
        let node = self.sequence(statements);
        self.names.truncate(seen);
        node
    }

    fn sequence(&mut self, statements: &[Stmt]) -> Option<ProcedureNode> {
        match statements {
            [] => Some(ProcedureNode::Constant(Value::Null)),
            [Stmt::Var(variable, options, _), rest @ ..] => {
                if options.intersects(ASTFlags::EXPORTED) || self.names.len() >= self.helpers.limits().variables {
                    return None;
                }
                let value = self.part(&variable.1)?;
                self.names.push(variable.0.name.to_string());
                let rest = self.deeper(|deeper| deeper.sequence(rest))?;
                Some(ProcedureNode::Let(Box::new((value, rest))))
            }
            [only] => self.statement(only),
            [first, rest @ ..] => {
                let first = self.statement(first)?;
                let rest = self.deeper(|deeper| deeper.sequence(rest))?;
                Some(ProcedureNode::Then(Box::new((first, rest))))
            }
        }
    }

    fn statement(&mut self, statement: &Stmt) -> Option<ProcedureNode> {
        match statement {
            Stmt::Noop(_) => Some(ProcedureNode::Constant(Value::Null)),
            Stmt::Expr(expression) => self.part(expression),
            Stmt::FnCall(call, _) => self.deeper(|deeper| deeper.call(call)),
            Stmt::Block(block) => self.deeper(|deeper| deeper.block(block.statements())),
            Stmt::If(flow, _) => self.deeper(|deeper| {
                let condition = deeper.part(&flow.expr)?;
                let then = deeper.block(flow.body.statements())?;
                let other = deeper.block(flow.branch.statements())?;
                Some(ProcedureNode::If(Box::new([condition, then, other])))
            }),
            _ => None,
        }
    }

    /// Builds what is nested one deeper, and counts it.
    fn deeper<T>(&mut self, build: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        self.depth += 1;
        self.steps = self.steps.saturating_add(STEPS_PER_PART);
        self.deepest = self.deepest.max(self.depth);
        let built = if self.depth > DEPTH_MAX { None } else { build(self) };
        self.depth -= 1;
        built
    }

    /// Counts a link of a chain: each nests the ones before it.
    pub(super) fn count_link(&mut self, links: usize) -> Option<()> {
        self.steps = self.steps.saturating_add(STEPS_PER_PART);
        self.deepest = self.deepest.max(self.depth + links);
        (self.deepest <= DEPTH_MAX).then_some(())
    }

    pub(super) fn part(&mut self, expression: &Expr) -> Option<ProcedureNode> {
        self.deeper(|deeper| match expression {
            Expr::Variable(variable, ..) => deeper.variable(&variable.1),
            Expr::FnCall(call, _) => deeper.call(call),
            Expr::Dot(..) | Expr::Index(..) => deeper.chain(expression),
            Expr::And(parts, _) => deeper.parts(parts).map(|parts| ProcedureNode::All(parts.into())),
            Expr::Or(parts, _) => deeper.parts(parts).map(|parts| ProcedureNode::Any(parts.into())),
            Expr::Array(items, _) => deeper.parts(items).map(|items| ProcedureNode::List(items.into())),
            Expr::Map(fields, _) if fields.0.len() == fields.1.len() => {
                let mut made = Vec::new();
                for (name, field) in &fields.0 {
                    made.push((name.name.as_str(), deeper.part(field)?));
                }
                made.sort_unstable_by_key(|(name, _)| *name);
                let names = FieldNames::of(&made.iter().map(|(name, _)| *name).collect::<Vec<_>>());
                let fields: Box<[ProcedureNode]> = made.into_iter().map(|(_, field)| field).collect();
                (names.len() == fields.len()).then(|| ProcedureNode::Object(Box::new((names, fields))))
            }
            Expr::Stmt(block) => deeper.block(block.statements()),
            other => constant(other).map(ProcedureNode::Constant),
        })
    }

    pub(super) fn parts(&mut self, expressions: &[Expr]) -> Option<Vec<ProcedureNode>> {
        expressions.iter().map(|expression| self.part(expression)).collect()
    }

    fn variable(&self, name: &str) -> Option<ProcedureNode> {
        let at = self.names.iter().rposition(|known| known == name)?;
        Some(if at < self.inputs {
            ProcedureNode::Input(u32::try_from(at).ok()?)
        } else {
            ProcedureNode::Local(self.names.len() - 1 - at)
        })
    }

    fn call(&mut self, call: &FnCallExpr) -> Option<ProcedureNode> {
        if call.capture_parent_scope {
            return None;
        }
        let arguments = self.parts(&call.args)?;
        if let Some(token) = &call.op_token {
            return operation(token, arguments);
        }
        if !self.helpers.has(&call.name, arguments.len()) {
            let function = Function::of(&call.name, arguments.len())?;
            return Some(ProcedureNode::Function(Box::new((function, arguments.into()))));
        }
        let piece = self.helpers.piece(&call.name, arguments.len())?;
        self.steps = self.steps.saturating_add(piece.steps);
        self.levels = self.levels.max(piece.levels);
        self.deepest = self.deepest.max(self.depth + piece.depth);
        (self.deepest <= DEPTH_MAX).then(|| ProcedureNode::Helper(Box::new((piece.root.clone(), arguments.into()))))
    }
}
