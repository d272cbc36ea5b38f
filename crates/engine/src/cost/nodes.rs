//! Going through all parts of a procedure.

use rhai::{AST, ASTNode};

/// Shows every part with those around it, the outermost first, as long as `seen` says so.
pub(crate) fn each_node(ast: &AST, seen: &mut dyn FnMut(&[ASTNode]) -> bool) {
    ast.walk(seen);
}
