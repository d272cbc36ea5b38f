//! The translation of Rhai's literals and operators into our tree.

use super::compare::CompiledComparison;
use super::node::ProcedureNode;
use super::numbers::Operator;
use behaviour::{Fields, Value};
use rhai::{Dynamic, Expr, Token};

pub(super) fn operation(token: &Token, arguments: Vec<ProcedureNode>) -> Option<ProcedureNode> {
    let mut arguments = arguments.into_iter();
    match (token, arguments.next(), arguments.next(), arguments.next()) {
        (Token::Bang, Some(of), None, None) => Some(ProcedureNode::Not(Box::new(of))),
        (Token::UnaryMinus | Token::Minus, Some(of), None, None) => Some(ProcedureNode::Negative(Box::new(of))),
        (token, Some(left), Some(right), None) => {
            let pair = Box::new((left, right));
            match operator(token) {
                Some(operator) => Some(ProcedureNode::Arithmetic(operator, pair)),
                None => comparison(token).map(|comparison| ProcedureNode::Compare(comparison, pair)),
            }
        }
        _ => None,
    }
}

fn operator(token: &Token) -> Option<Operator> {
    Some(match token {
        Token::Plus => Operator::Plus,
        Token::Minus => Operator::Minus,
        Token::Multiply => Operator::Times,
        Token::Divide => Operator::Over,
        Token::Modulo => Operator::Rest,
        _ => return None,
    })
}

fn comparison(token: &Token) -> Option<CompiledComparison> {
    Some(match token {
        Token::EqualsTo => CompiledComparison::Equal,
        Token::NotEqualsTo => CompiledComparison::NotEqual,
        Token::LessThan => CompiledComparison::Less,
        Token::LessThanEqualsTo => CompiledComparison::LessEqual,
        Token::GreaterThan => CompiledComparison::Greater,
        Token::GreaterThanEqualsTo => CompiledComparison::GreaterEqual,
        _ => return None,
    })
}

pub(super) fn constant(expression: &Expr) -> Option<Value> {
    match expression {
        Expr::Unit(_) => Some(Value::Null),
        Expr::BoolConstant(truth, _) => Some(Value::Bool(*truth)),
        Expr::IntegerConstant(whole, _) => Some(Value::Int(*whole)),
        Expr::FloatConstant(number, _) => Some(Value::Float(**number)),
        Expr::StringConstant(text, _) => Some(Value::text(text)),
        Expr::DynamicConstant(made, _) => ready_made(made),
        _ => None,
    }
}

/// A list or object that Rhai has made while reading. Letters are a kind of their own there, and not here.
fn ready_made(made: &Dynamic) -> Option<Value> {
    if let Ok(items) = made.as_array_ref() {
        return items.iter().map(ready_made).collect::<Option<Vec<_>>>().map(Value::list);
    }
    if let Ok(fields) = made.as_map_ref() {
        let fields = fields.iter().map(|(name, made)| Some((name.clone(), ready_made(made)?)));
        return fields.collect::<Option<Vec<_>>>().map(|fields| Value::Map(Fields::of(fields)));
    }
    if let Ok(text) = made.as_immutable_string_ref() {
        return Some(Value::text(&*text));
    }
    let number = || made.as_float().ok().map(Value::Float).or_else(|| made.as_int().ok().map(Value::Int));
    let null = || made.is_unit().then_some(Value::Null);
    number().or_else(|| made.as_bool().ok().map(Value::Bool)).or_else(null)
}
