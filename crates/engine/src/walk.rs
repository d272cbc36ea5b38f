//! What a procedure calls, and whether it may.

use crate::closures::{check_closures, is_caller};
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

/// How many parts a call of `ast` computes at most, those of helpers included; nothing if a loop or a closure has no
/// such bound. `helper` knows the helpers by name.
pub(crate) fn length(ast: &AST, helper: &dyn Fn(&str) -> Option<Option<u64>>) -> Option<u64> {
    let mut parts = (!ast.has_functions()).then_some(0_u64);
    ast.walk(&mut |path: &[ASTNode]| {
        let of_helper = match path.last() {
            Some(ASTNode::Stmt(Stmt::While(..) | Stmt::Do(..) | Stmt::For(..))) => None,
            Some(
                ASTNode::Stmt(Stmt::FnCall(call, _)) | ASTNode::Expr(Expr::FnCall(call, _) | Expr::MethodCall(call, _)),
            ) => match call.name.as_str() {
                "Fn" | "call" => None,
                name => helper(name).unwrap_or_else(|| (!is_caller(name)).then_some(0)),
            },
            _ => Some(0),
        };
        parts = parts.zip(of_helper).map(|(parts, more)| parts.saturating_add(more).saturating_add(1));
        true
    });
    parts
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
