//! The calls in a procedure, and whether it may make them.

use crate::cost::callers::is_caller;
use crate::cost::nodes::each_node;
use crate::faults::{BodyFault, Misuse};
use crate::procedure::closures::check_closures;
use crate::rhai::library::is_refused;
use behaviour::{FillFrom, LookupSet};
use rhai::{AST, ASTNode, Expr, Position, Stmt};

/// The most values that a function of the library takes, and some more.
pub(crate) const VALUES_MAX: usize = 8;
/// The most values around it that a closure may use.
const CAPTURES_MAX: usize = 8;
/// The most values that the library hands to a closure.
const HANDED_MAX: usize = 3;

/// The cost of looking for functions: Rhai looks for one that is not there twice as often for each further value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Search {
    /// True if errors are caught, so that it may happen again and again.
    catches: bool,
    /// The most values that something is called with.
    values: usize,
}

impl Search {
    /// The most values for which looking takes no longer than a step has time for.
    const FREE_VALUES: usize = 4;

    /// Adds what a helper that is called may take.
    pub(crate) fn add(&mut self, helper: Self) {
        *self = Self { catches: self.catches | helper.catches, values: self.values.max(helper.values) };
    }

    /// True if it takes longer than steps have time for.
    pub(crate) fn is_wide(self) -> bool {
        self.catches && self.values > Self::FREE_VALUES
    }

    /// Returns the number of steps that each step counts more.
    pub(crate) fn more_steps(self) -> u64 {
        if self.is_wide() { 1 << (self.values - 2).min(40) } else { 0 }
    }
}

/// Returns the cost of looking for the functions that `ast` calls.
pub(crate) fn search(ast: &AST) -> Search {
    let mut search = Search::default();
    each_node(ast, &mut |path: &[ASTNode]| {
        match path.last() {
            Some(ASTNode::Stmt(Stmt::TryCatch(..))) => search.catches = true,
            Some(ASTNode::Stmt(Stmt::Share(captures))) => {
                search.values = search.values.max(captures.len() + HANDED_MAX)
            }
            _ => {}
        }
        true
    });
    each_call(ast, &mut |call| search.values = search.values.max(call.values + usize::from(call.is_method)));
    search
}

/// Refuses calls with more values than the library takes, unless a helper does, and closures that use too many values
/// around them.
pub(crate) fn check_widths(ast: &AST, takes: &dyn Fn(&str, usize) -> bool) -> Result<(), BodyFault> {
    let mut refused = None;
    each_call(ast, &mut |ProcedureCall { name, values, at, .. }| {
        if refused.is_none() && values > VALUES_MAX && !takes(name, values) {
            let why = match name {
                "call" => Misuse::ClosureValues(VALUES_MAX),
                name => Misuse::HelperValues(name.to_owned(), values),
            };
            refused = Some(BodyFault::misuse(at, why));
        }
    });
    refused.map_or(Ok(()), Err)
}

fn check_captures(ast: &AST) -> Result<(), BodyFault> {
    let mut refused = None;
    each_node(ast, &mut |path: &[ASTNode]| {
        if let Some(ASTNode::Stmt(Stmt::Share(captures))) = path.last()
            && captures.len() > CAPTURES_MAX
        {
            let at = captures.first().map_or(Position::NONE, |(variable, _)| variable.pos);
            refused = Some(BodyFault::misuse(at, Misuse::Captures(CAPTURES_MAX)));
        }
        refused.is_none()
    });
    refused.map_or(Ok(()), Err)
}

/// The names of functions that are called in `ast`, each once, in order.
pub(crate) fn called(ast: &AST) -> Vec<String> {
    let mut names = Vec::new();
    each_call(ast, &mut |call| names.push(call.name.to_owned()));
    names.into_iter().distinct()
}

/// Returns the most parts that a call of `ast` computes, those of helpers included; none if a loop or a closure has no
/// such bound. `helper` knows the helpers by name.
pub(crate) fn length(ast: &AST, helper: &dyn Fn(&str) -> Option<Option<u64>>) -> Option<u64> {
    let mut parts = (!ast.has_functions()).then_some(0_u64);
    each_node(ast, &mut |path: &[ASTNode]| {
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
pub(crate) fn check_calls(ast: &AST) -> Result<(), BodyFault> {
    if ast.iter_functions().any(|function| !function.name.starts_with("anon$")) {
        return Err(BodyFault::Functions);
    }
    let mut refused = None;
    each_call(ast, &mut |ProcedureCall { name, at, .. }| {
        if refused.is_none() && is_refused(name) {
            refused = Some(BodyFault::misuse(at, Misuse::Refused(name.to_owned())));
        }
    });
    refused.map_or_else(|| check_captures(ast), Err)?;
    check_closures(ast, &LookupSet::new())
}

/// A call.
struct ProcedureCall<'a> {
    name: &'a str,
    /// The number of values that it hands over, without the one before the dot of a method.
    values: usize,
    is_method: bool,
    at: Position,
}

fn each_call(ast: &AST, seen: &mut dyn FnMut(ProcedureCall)) {
    each_node(ast, &mut |path: &[ASTNode]| {
        let (call, at, is_method) = match path.last() {
            Some(ASTNode::Stmt(Stmt::FnCall(call, at)) | ASTNode::Expr(Expr::FnCall(call, at))) => (call, at, false),
            Some(ASTNode::Expr(Expr::MethodCall(call, at))) => (call, at, true),
            _ => return true,
        };
        seen(ProcedureCall { name: &call.name, values: call.args.len(), is_method, at: *at });
        true
    });
}

#[cfg(test)]
mod tests {
    use super::VALUES_MAX;
    use crate::cost::Limits;
    use crate::cost::metered::known;
    use crate::rhai::sandbox::hardened_engine;

    #[test]
    fn no_function_takes_more_values_than_a_call_may_hand_over() {
        let all = hardened_engine(&Limits::default()).collect_fn_metadata(None, known, true);
        assert!(all.iter().all(|(_, types)| types.len() <= VALUES_MAX));
    }
}
