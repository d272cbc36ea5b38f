//! Going through all parts of a procedure.
//! It takes its closure by `dyn`, as it is not hot and would otherwise be compiled for each caller.

use rhai::{AST, ASTNode};

/// Shows every part with those around it, the outermost first, as long as `seen` says so.
pub(crate) fn each_node(ast: &AST, seen: &mut dyn FnMut(&[ASTNode]) -> bool) {
    ast.walk(seen);
}
