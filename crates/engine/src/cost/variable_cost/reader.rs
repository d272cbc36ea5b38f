//! Reading a procedure for how it uses its variables.

use super::{
    CATCH_QUARTERS, CLOSURE_QUARTERS, NAMED_QUARTERS, PLAIN_QUARTERS, SMALL_CLOSURE_QUARTERS, VariableCost, VariableUse,
};
use crate::cost::callers::is_caller;
use crate::cost::meter;
use crate::cost::nodes::each_node;
use behaviour::LookupSet;
use rhai::{AST, ASTFlags, ASTNode, Dynamic, Expr, FnCallExpr, FnPtr, ImmutableString, Stmt, Token};

/// Statements in closures with fewer parts are hardly anything.
const SMALL_PARTS: usize = 2;
/// Ready-made lists in a loop that cost less than this cost nothing.
const CONSTANT_NANOS: usize = 1_000;
/// The most copies outside of loops that are made once; more of them pay.
const ONCE_MAX: usize = 16;

impl VariableCost {
    /// Reads a body with its closures; a helper can be called again and again.
    pub(crate) fn of(ast: &AST, is_helper: bool) -> Self {
        let cost = Self { quarters: PLAIN_QUARTERS, texts_go_through: false, uses: Vec::new() };
        let (body, owned) = (ast.statements(), copied_when_handed_over(ast));
        let mut reader = CostReader { body, is_helper, owned, cost, constant: 0, once: Vec::new(), parts: Vec::new() };
        each_node(ast, &mut |path: &[ASTNode]| {
            reader.look(path);
            true
        });
        reader.done()
    }
}

struct CostReader<'a> {
    body: &'a [Stmt],
    is_helper: bool,
    owned: LookupSet<String>,
    cost: VariableCost,
    /// The cost of the largest ready-made list or object in a loop.
    constant: usize,
    /// Variables that are copied outside of loops.
    once: Vec<ImmutableString>,
    /// The number of parts of each statement in a closure.
    parts: Vec<usize>,
}

impl CostReader<'_> {
    fn done(mut self) -> VariableCost {
        let kind = if self.once.len() > ONCE_MAX { VariableUse::Copy } else { VariableUse::Once };
        for name in std::mem::take(&mut self.once) {
            self.cost.used(&name, kind);
        }
        if !self.parts.is_empty() {
            let is_small = self.parts.iter().any(|parts| *parts < SMALL_PARTS);
            self.cost.quarters =
                self.cost.quarters.max(if is_small { SMALL_CLOSURE_QUARTERS } else { CLOSURE_QUARTERS });
        }
        let constant = self.constant.saturating_sub(CONSTANT_NANOS) / meter::STEP_NANOS;
        self.cost.quarters += PLAIN_QUARTERS * constant as u64;
        self.cost
    }

    fn look(&mut self, path: &[ASTNode]) {
        if !self.is_of_body(path) {
            match self.parts.last_mut().filter(|_| path.len() > 1) {
                Some(parts) => *parts += 1,
                None => self.parts.push(0),
            }
        }
        match path {
            [.., ASTNode::Stmt(Stmt::TryCatch(..))] => self.cost.quarters = self.cost.quarters.max(CATCH_QUARTERS),
            [
                ..,
                ASTNode::Stmt(Stmt::FnCall(call, _)) | ASTNode::Expr(Expr::FnCall(call, _) | Expr::MethodCall(call, _)),
            ] if names_function(call) => {
                self.cost.quarters = self.cost.quarters.max(NAMED_QUARTERS);
            }
            [.., ASTNode::Expr(Expr::DynamicConstant(made, _))] if is_named(made) => {
                self.cost.quarters = self.cost.quarters.max(NAMED_QUARTERS);
            }
            [.., ASTNode::Stmt(Stmt::For(flow, _))] if calls(&flow.2.expr) => self.cost.texts_go_through = true,
            [.., ASTNode::Expr(Expr::DynamicConstant(made, _))] if self.repeats(path) => {
                self.constant = self.constant.max(meter::copying(made));
            }
            [.., ASTNode::Expr(Expr::StringConstant(text, _))] if self.repeats(path) => {
                self.constant = self.constant.max(text.len());
            }
            [.., ASTNode::Expr(used @ Expr::Variable(variable, ..))] => {
                let Some(mut kind) = kind_of_use(path, used) else { return };
                if kind == VariableUse::Touch && self.owned.contains(variable.1.as_str()) {
                    kind = VariableUse::Copy;
                }
                if kind >= VariableUse::Copy && !self.repeats(path) {
                    self.once.push(variable.1.clone());
                } else {
                    self.cost.used(&variable.1, kind);
                }
            }
            _ => {}
        }
    }

    /// True for what is not in a closure.
    fn is_of_body(&self, path: &[ASTNode]) -> bool {
        let Some(ASTNode::Stmt(first)) = path.first() else { return false };
        self.body.as_ptr_range().contains(&std::ptr::from_ref(*first))
    }

    /// True for what is computed more than once in a call: in a loop, a closure or a helper.
    fn repeats(&self, path: &[ASTNode]) -> bool {
        if self.is_helper || !self.is_of_body(path) {
            return true;
        }
        path.windows(2).any(|pair| match pair {
            [ASTNode::Stmt(Stmt::While(..) | Stmt::Do(..)), _] => true,
            [ASTNode::Stmt(Stmt::For(flow, _)), ASTNode::Expr(inner)] => !std::ptr::eq(&flow.2.expr, *inner),
            [ASTNode::Stmt(Stmt::For(..)), _] => true,
            _ => false,
        })
    }
}

/// Returns the use of the variable at the end of a path; none if it only gets another value.
fn kind_of_use(path: &[ASTNode], used: &Expr) -> Option<VariableUse> {
    if path.iter().any(takes_out) || path.windows(2).any(|pair| is_gone_through(pair[0], pair[1])) {
        return Some(VariableUse::Through);
    }
    let [.., parent, _] = path else { return Some(VariableUse::Copy) };
    match parent {
        ASTNode::Expr(root @ (Expr::Dot(pair, ..) | Expr::Index(pair, ..))) if std::ptr::eq(&pair.lhs, used) => {
            let is_put = path.iter().any(|node| is_target(node, root));
            Some(match is_put {
                true if takes_item(&pair.rhs) => VariableUse::Letter,
                true => VariableUse::Put,
                false => kind_of_part(&pair.rhs),
            })
        }
        ASTNode::Expr(Expr::FnCall(call, _)) | ASTNode::Stmt(Stmt::FnCall(call, _)) if is_first(call, used) => {
            Some(VariableUse::Touch)
        }
        ASTNode::Stmt(Stmt::Assignment(parts)) if std::ptr::eq(&parts.1.lhs, used) => {
            parts.0.get_op_assignment_info().map(|_| VariableUse::Grow)
        }
        _ => Some(VariableUse::Copy),
    }
}

fn kind_of_part(rest: &Expr) -> VariableUse {
    if is_range(rest) {
        VariableUse::Through
    } else if calls_method(rest) {
        VariableUse::Touch
    } else {
        VariableUse::Part
    }
}

/// True for `… - …`: of texts, it looks for one in the other.
fn takes_out(node: &ASTNode) -> bool {
    match node {
        ASTNode::Expr(Expr::FnCall(call, _)) | ASTNode::Stmt(Stmt::FnCall(call, _)) => {
            matches!(call.op_token, Some(Token::Minus))
        }
        ASTNode::Stmt(Stmt::Assignment(parts)) => {
            parts.0.get_op_assignment_info().is_some_and(|(.., sign)| sign == "-")
        }
        _ => false,
    }
}

/// True for what a `for` goes through: of a text, it takes all letters first. Also for what is thrown, which is
/// copied twice, and for the name of a function.
fn is_gone_through(outer: ASTNode, inner: ASTNode) -> bool {
    match (outer, inner) {
        (ASTNode::Stmt(Stmt::Return(_, options, _)), _) => options.intersects(ASTFlags::BREAK),
        (ASTNode::Stmt(Stmt::For(flow, _)), ASTNode::Expr(inner)) => std::ptr::eq(&flow.2.expr, inner),
        (ASTNode::Expr(Expr::FnCall(call, _)) | ASTNode::Stmt(Stmt::FnCall(call, _)), _) => call.name == "Fn",
        _ => false,
    }
}

fn is_target(node: &ASTNode, root: &Expr) -> bool {
    matches!(node, ASTNode::Stmt(Stmt::Assignment(parts)) if std::ptr::eq(&parts.1.lhs, root))
}

/// True for the first argument of a function: it is handed over where it is, except to these of the language itself.
fn is_first(call: &FnCallExpr, used: &Expr) -> bool {
    !matches!(call.name.as_str(), "Fn" | "is_shared" | "is_def_var" | "curry" | "call")
        && call.args.first().is_some_and(|first| std::ptr::eq(first, used))
}

/// True for `from..to` between brackets.
fn is_range(index: &Expr) -> bool {
    match index {
        Expr::FnCall(call, _) => matches!(call.op_token, Some(Token::ExclusiveRange | Token::InclusiveRange)),
        Expr::DynamicConstant(made, _) => !made.is_array() && !made.is_map(),
        _ => false,
    }
}

/// True for brackets anywhere in a chain.
fn takes_item(link: &Expr) -> bool {
    match link {
        Expr::Index(..) => true,
        Expr::Dot(pair, ..) => takes_item(&pair.rhs),
        _ => false,
    }
}

/// Constants, and what a closure uses of the variables around it: functions get a copy of them.
fn copied_when_handed_over(ast: &AST) -> LookupSet<String> {
    let mut names = LookupSet::new();
    each_node(ast, &mut |path: &[ASTNode]| {
        match path.last() {
            Some(ASTNode::Stmt(Stmt::Var(variable, options, _))) if options.intersects(ASTFlags::CONSTANT) => {
                names.insert(variable.0.name.to_string());
            }
            Some(ASTNode::Stmt(Stmt::Share(shared))) => {
                names.extend(shared.iter().map(|(name, _)| name.name.to_string()));
            }
            _ => {}
        }
        true
    });
    names
}

/// True for `Fn("abs")`, and for a list function that is handed a function by its name, or may be.
fn names_function(call: &FnCallExpr) -> bool {
    let is_name = |given: &Expr| matches!(given, Expr::StringConstant(..) | Expr::Variable(..) | Expr::FnCall(..));
    call.name == "Fn" || is_caller(&call.name) && call.args.iter().any(is_name)
}

/// True for a function of the library, made of its name while reading.
fn is_named(made: &Dynamic) -> bool {
    made.read_lock::<FnPtr>().is_some_and(|function| !function.is_anonymous())
}

/// True if a `for` goes through what something else makes, a text of a closure perhaps.
fn calls(gone_through: &Expr) -> bool {
    match gone_through {
        Expr::FnCall(call, _) => call.op_token.is_none() || call.args.iter().any(calls),
        other => calls_method(other),
    }
}

/// True if a method is called anywhere in a chain.
fn calls_method(link: &Expr) -> bool {
    match link {
        Expr::MethodCall(..) => true,
        Expr::Dot(pair, ..) | Expr::Index(pair, ..) => calls_method(&pair.lhs) || calls_method(&pair.rhs),
        _ => false,
    }
}
