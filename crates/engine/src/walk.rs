//! What a procedure calls, and whether it may.

use crate::closures::check_closures;
use crate::library::is_refused;
use crate::words::placed;
use rhai::{AST, ASTNode, Expr, Position, Stmt};
use std::collections::BTreeSet;

/// The names of functions that are called in `ast`.
pub(crate) fn called(ast: &AST) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    each_call(ast, &mut |name, _| {
        names.insert(name.to_owned());
    });
    names
}

/// Refuses functions of its own and calls that are not allowed.
pub(crate) fn check_calls(ast: &AST) -> Result<(), String> {
    if ast.iter_functions().any(|function| !function.name.starts_with("anon$")) {
        return Err("a procedure cannot define functions; add a helper for it".to_owned());
    }
    let mut refused = None;
    each_call(ast, &mut |name, at| {
        if refused.is_none() && is_refused(name) {
            refused = Some(placed(at, &format!("“{name}” cannot be used in a procedure")));
        }
    });
    refused.map_or_else(|| check_closures(ast, &BTreeSet::new()), Err)
}

fn each_call(ast: &AST, seen: &mut dyn FnMut(&str, Position)) {
    ast.walk(&mut |path: &[ASTNode]| {
        match path.last() {
            Some(ASTNode::Stmt(Stmt::FnCall(call, at))) => seen(&call.name, *at),
            Some(ASTNode::Expr(Expr::FnCall(call, at) | Expr::MethodCall(call, at))) => seen(&call.name, *at),
            _ => {}
        }
        true
    });
}
