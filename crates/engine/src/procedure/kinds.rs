//! The kind of value that a procedure makes, told from the kinds of its arguments; and names in it that mean nothing.

mod known;
mod misuse;
mod operators;

use crate::cost::nodes::each_node;
use crate::faults::BodyFault;
use crate::procedure::walk;
use behaviour::{HelperCall, TYPE_MAX_FIELDS, ValueType, is_identifier};
use known::{function_names, parsed};
pub use misuse::misused;
use rhai::{AST, ASTFlags, ASTNode, BinaryExpr, Expr, FnCallExpr, Stmt};

/// The depth to which a procedure is followed.
const DEPTH_MAX: usize = 48;
/// The most parts of a procedure that are followed.
const PARTS_MAX: usize = 1_024;

/// The kind of value that a body makes of arguments of these kinds: [`ValueType::Any`] at every doubt. `helper` says what
/// a helper makes, if there is one of that name with so many parameters.
#[must_use]
pub fn result_type(arguments: &[(String, ValueType)], body: &str, helper: HelperCall) -> ValueType {
    let names: Vec<String> = arguments.iter().map(|(name, _)| name.clone()).collect();
    let Ok(ast) = parsed(&names, body) else { return ValueType::Any };
    if ast.has_functions() {
        return ValueType::Any;
    }
    let mut reader = KindReader { names: arguments.to_vec(), helper, depth: 0, parts: 0 };
    reader.sequence(ast.statements()).unwrap_or_default()
}

/// The first name in a body that means nothing with arguments of these kinds and these helpers, with those that would in
/// its place: a value, a function, or a field of an argument.
#[must_use]
pub fn unknown_name(arguments: &[(String, ValueType)], body: &str, helpers: &[&str]) -> Option<(String, Vec<String>)> {
    let names: Vec<String> = arguments.iter().map(|(name, _)| name.clone()).collect();
    match parsed(&names, body) {
        Ok(ast) => unknown_function(&ast, helpers).or_else(|| unknown_field(&ast, arguments)),
        Err(BodyFault::Syntax(syntax)) => Some((syntax.unknown_value()?.to_owned(), names)),
        Err(_) => None,
    }
}

fn unknown_function(ast: &AST, helpers: &[&str]) -> Option<(String, Vec<String>)> {
    let called = walk::called(ast);
    let unknown = called.into_iter().filter(|name| is_identifier(name) && !helpers.contains(&name.as_str()));
    let name = function_names(|known| unknown.into_iter().find(|name| known.binary_search(name).is_err()))?;
    let own = helpers.iter().map(|helper| (*helper).to_owned());
    let known = function_names(|known| own.chain(known.iter().cloned()).collect());
    Some((name, known))
}

fn unknown_field(ast: &AST, arguments: &[(String, ValueType)]) -> Option<(String, Vec<String>)> {
    let mut found = None;
    each_node(ast, &mut |path: &[ASTNode]| {
        if let Some(ASTNode::Expr(Expr::Dot(pair, ..))) = path.last()
            && let Some((name, field)) = argument_and_field(pair)
            && let Some((_, ValueType::Record(fields))) = arguments.iter().find(|(argument, _)| argument == name)
            && !fields.contains_key(field)
        {
            found = found.take().or_else(|| Some((field.to_owned(), fields.keys().cloned().collect())));
        }
        found.is_none()
    });
    // A variable of its own may have the name of an argument.
    let mut declares = false;
    each_node(ast, &mut |path: &[ASTNode]| {
        declares |= matches!(path.last(), Some(ASTNode::Stmt(Stmt::Var(..) | Stmt::Assignment(..) | Stmt::For(..))));
        !declares
    });
    found.filter(|_| !declares && !ast.has_functions())
}

fn argument_and_field(pair: &BinaryExpr) -> Option<(&str, &str)> {
    let first = match &pair.rhs {
        Expr::Dot(next, ..) | Expr::Index(next, ..) => &next.lhs,
        only => only,
    };
    match (&pair.lhs, first) {
        (Expr::Variable(variable, ..), Expr::Property(property, _)) => Some((variable.1.as_str(), property.2.as_str())),
        _ => None,
    }
}

/// Follows a procedure. Nothing stands for what it does not know: then nobody knows what the whole makes.
struct KindReader<'c> {
    /// The names in sight with their kinds, newest last.
    names: Vec<(String, ValueType)>,
    helper: HelperCall<'c>,
    depth: usize,
    parts: usize,
}

impl KindReader<'_> {
    fn block(&mut self, statements: &[Stmt]) -> Option<ValueType> {
        let seen = self.names.len();
        let made = self.sequence(statements);
        self.names.truncate(seen);
        made
    }

    fn sequence(&mut self, statements: &[Stmt]) -> Option<ValueType> {
        let mut made = ValueType::Nothing;
        for statement in statements {
            made = self.deeper(|deeper| deeper.statement(statement))?;
        }
        Some(made)
    }

    fn statement(&mut self, statement: &Stmt) -> Option<ValueType> {
        match statement {
            Stmt::Noop(_) => Some(ValueType::Nothing),
            Stmt::Expr(expression) => self.part(expression),
            Stmt::FnCall(call, _) => self.call(call),
            Stmt::Block(block) => self.block(block.statements()),
            Stmt::Var(variable, options, _) if !options.intersects(ASTFlags::EXPORTED) => {
                let kind = self.part(&variable.1)?;
                self.names.push((variable.0.name.to_string(), kind));
                Some(ValueType::Nothing)
            }
            Stmt::If(flow, _) => {
                self.part(&flow.expr)?;
                let then = self.block(flow.body.statements())?;
                Some(then.or(&self.block(flow.branch.statements())?))
            }
            _ => None,
        }
    }

    /// Follows what is nested one deeper, and counts it.
    fn deeper<T>(&mut self, follow: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        self.depth += 1;
        self.parts += 1;
        let made = if self.depth > DEPTH_MAX || self.parts > PARTS_MAX { None } else { follow(self) };
        self.depth -= 1;
        made
    }

    fn part(&mut self, expression: &Expr) -> Option<ValueType> {
        self.deeper(|deeper| match expression {
            Expr::Variable(variable, ..) => {
                let known = deeper.names.iter().rev().find(|(name, _)| *name == variable.1.as_str());
                Some(known.map(|(_, kind)| kind.clone()).unwrap_or_default())
            }
            Expr::FnCall(call, _) => deeper.call(call),
            Expr::Dot(pair, options, _) => deeper.chain(pair, *options, true),
            Expr::Index(pair, options, _) => deeper.chain(pair, *options, false),
            Expr::And(parts, _) | Expr::Or(parts, _) => deeper.parts(parts).map(|_| ValueType::Truth),
            Expr::Array(items, _) if items.len() > TYPE_MAX_FIELDS => None,
            Expr::Map(fields, _) if fields.0.len() > TYPE_MAX_FIELDS => None,
            Expr::Array(items, _) => {
                let kinds = deeper.parts(items)?;
                let all = kinds.into_iter().reduce(|one, other| one.or(&other));
                Some(ValueType::List(Box::new(all.unwrap_or_default())))
            }
            Expr::Map(fields, _) => {
                let mut made = Vec::new();
                for (name, field) in &fields.0 {
                    made.push((name.name.as_str(), deeper.part(field)?));
                }
                Some(ValueType::record(made))
            }
            Expr::Stmt(block) => deeper.block(block.statements()),
            Expr::InterpolatedString(parts, _) => deeper.parts(parts).map(|_| ValueType::Text),
            other => Some(operators::constant(other)),
        })
    }

    fn parts(&mut self, expressions: &[Expr]) -> Option<Vec<ValueType>> {
        expressions.iter().map(|expression| self.part(expression)).collect()
    }

    /// `ball.speed.x`, `faces[0].label`: what stands to the left, then one link after the other.
    fn chain(&mut self, pair: &BinaryExpr, options: ASTFlags, dot: bool) -> Option<ValueType> {
        let (mut pair, mut options, mut dot) = (pair, options, dot);
        let mut kind = self.part(&pair.lhs)?;
        loop {
            if options.intersects(ASTFlags::NEGATED) {
                return None;
            }
            let next = match &pair.rhs {
                Expr::Dot(next, more, _) => Some((next, *more, true)),
                Expr::Index(next, more, _) => Some((next, *more, false)),
                _ => None,
            };
            let next = next.filter(|_| !options.intersects(ASTFlags::BREAK));
            let says = next.map_or(&pair.rhs, |(next, ..)| &next.lhs);
            kind = self.deeper(|deeper| deeper.linked(kind, says, dot))?;
            match next {
                Some(link) => (pair, options, dot) = (link.0, link.1, link.2),
                None => return Some(kind),
            }
        }
    }

    /// Returns the kind behind a dot or index. A method's result is unknown here, and it may change its object.
    fn linked(&mut self, of: ValueType, says: &Expr, dot: bool) -> Option<ValueType> {
        match (says, of) {
            (Expr::Property(property, _), of) if dot => Some(of.field(property.2.as_str()).unwrap_or_default()),
            (Expr::StringConstant(name, _), of) if !dot => Some(of.field(name.as_str()).unwrap_or_default()),
            (at, ValueType::List(of)) if !dot => self.part(at).map(|_| *of),
            (at, _) if !dot => self.part(at).map(|_| ValueType::Any),
            _ => None,
        }
    }

    fn call(&mut self, call: &FnCallExpr) -> Option<ValueType> {
        if call.capture_parent_scope {
            return None;
        }
        let arguments = self.parts(&call.args)?;
        if let Some(token) = &call.op_token {
            return Some(operators::operator(token, &arguments));
        }
        let of_helper = (self.helper)(&call.name, &arguments);
        Some(of_helper.unwrap_or_else(|| operators::function(&call.name, &arguments)))
    }
}

#[cfg(test)]
mod tests;
