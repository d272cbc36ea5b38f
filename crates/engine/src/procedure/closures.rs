//! Closures that use a variable around them: only where they are called, so that no value can hold itself.
//!
//! Rhai keeps such a variable in a shared cell. A closure that could be put into a cell makes circles, which are never
//! freed, and chains, which overflow the stack when they are. Its `curry` copies without a bound.

use crate::cost::callers::is_caller;
use crate::cost::nodes::each_node;
use crate::faults::{BodyFault, Misuse};
use behaviour::LookupSet;
use rhai::{AST, ASTNode, BinaryExpr, Expr, FnCallExpr, Position, Stmt, StmtBlock};

/// Refuses closures that could outlive the place where they are written, also by a helper with the name of a caller.
pub(crate) fn check_closures(ast: &AST, helpers: &LookupSet<String>) -> Result<(), BodyFault> {
    let mut found = FoundClosures { helpers, kept: LookupSet::new(), refused: None };
    each_node(ast, &mut |path: &[ASTNode]| {
        found.look(path);
        true
    });
    let kept = std::mem::take(&mut found.kept);
    each_node(ast, &mut |path: &[ASTNode]| {
        found.look_at_use(path, &kept);
        true
    });
    found.refused.map_or(Ok(()), Err)
}

struct FoundClosures<'h> {
    /// Helpers with the name of a caller.
    helpers: &'h LookupSet<String>,
    /// Variables that begin as such a closure.
    kept: LookupSet<String>,
    /// The first reason.
    refused: Option<BodyFault>,
}

impl FoundClosures<'_> {
    fn refuse(&mut self, at: Position, what: Misuse) {
        self.refused.get_or_insert_with(|| BodyFault::misuse(at, what));
    }

    fn look(&mut self, path: &[ASTNode]) {
        match path {
            [.., parent, ASTNode::Expr(Expr::Stmt(block)), ASTNode::Stmt(Stmt::Share(_))] => {
                self.place(parent, block.position());
            }
            [.., ASTNode::Stmt(Stmt::Share(shared))] => {
                self.refuse(shared.first().map_or(Position::NONE, |(variable, _)| variable.pos), Misuse::KeptClosure);
            }
            [.., ASTNode::Expr(Expr::FnCall(call, at) | Expr::MethodCall(call, at))]
            | [.., ASTNode::Stmt(Stmt::FnCall(call, at))]
                if call.name == "curry" && !captures(path) =>
            {
                self.refuse(*at, Misuse::Refused("curry".to_owned()));
            }
            _ => {}
        }
    }

    /// A closure with its cells stands there.
    fn place(&mut self, parent: &ASTNode, at: Position) {
        match parent {
            ASTNode::Stmt(Stmt::Var(variable, ..)) => drop(self.kept.insert(variable.0.name.to_string())),
            parent if self.calls_only(parent) => {}
            _ => self.refuse(at, Misuse::KeptClosure),
        }
    }

    /// True for a function that calls what it is handed.
    fn calls_only(&self, node: &ASTNode) -> bool {
        called_by(node).is_some_and(|call| is_caller(&call.name) && !self.helpers.contains(call.name.as_str()))
    }

    /// A variable that begins as a closure may be called or handed to a list.
    fn look_at_use(&mut self, path: &[ASTNode], kept: &LookupSet<String>) {
        let [.., parent, ASTNode::Expr(used @ Expr::Variable(variable, _, at))] = path else { return };
        if kept.contains(variable.1.as_str()) && !is_called(parent, used) && !self.calls_only(parent) {
            self.refuse(*at, Misuse::KeptClosure);
        }
    }
}

/// True inside the block that Rhai puts around a closure to share its cells.
fn captures(path: &[ASTNode]) -> bool {
    let block = path.iter().rev().find_map(|node| match node {
        ASTNode::Expr(Expr::Stmt(block)) => Some(block.as_ref()),
        _ => None,
    });
    block.and_then(|block: &StmtBlock| block.statements().first()).is_some_and(|first| matches!(first, Stmt::Share(_)))
}

fn called_by<'a>(node: &ASTNode<'a>) -> Option<&'a FnCallExpr> {
    match node {
        ASTNode::Stmt(Stmt::FnCall(call, _)) | ASTNode::Expr(Expr::FnCall(call, _) | Expr::MethodCall(call, _)) => {
            Some(call)
        }
        _ => None,
    }
}

/// True for `used.call(…)`, also with more behind it.
fn is_called(parent: &ASTNode, used: &Expr) -> bool {
    let ASTNode::Expr(Expr::Dot(pair, ..)) = parent else { return false };
    let BinaryExpr { lhs, rhs } = pair.as_ref();
    let first = match rhs {
        Expr::Dot(pair, ..) | Expr::Index(pair, ..) => &pair.lhs,
        rhs => rhs,
    };
    std::ptr::eq(lhs, used) && matches!(first, Expr::MethodCall(call, _) if call.name == "call")
}
