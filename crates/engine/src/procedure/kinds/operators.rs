//! The kinds of values that operators, functions and literals make.

use crate::rhai::maths;
use behaviour::{Unit, ValueType};
use rhai::{Expr, Token};

/// Functions that make a number of the same unit out of numbers of one unit.
const KEEPING: [&str; 8] = ["abs", "min", "max", "floor", "ceiling", "round", "to_float", "to_int"];
/// Functions that make an angle.
const TURNING: [&str; 4] = ["asin", "acos", "atan", "atan2"];

pub(super) fn constant(expression: &Expr) -> ValueType {
    match expression {
        Expr::Unit(_) => ValueType::Nothing,
        Expr::BoolConstant(..) => ValueType::Truth,
        Expr::IntegerConstant(..) | Expr::FloatConstant(..) => ValueType::NUMBER,
        Expr::StringConstant(..) => ValueType::Text,
        Expr::DynamicConstant(made, _) => {
            crate::rhai::conversion::from_rhai((**made).clone()).map_or(ValueType::Any, |value| ValueType::of(&value))
        }
        _ => ValueType::Any,
    }
}

pub(super) fn operator(token: &Token, of: &[ValueType]) -> ValueType {
    match (token, of) {
        (Token::Bang, [_]) => ValueType::Truth,
        (Token::UnaryMinus | Token::Minus | Token::UnaryPlus, [one]) => sum(one, one),
        (Token::Plus | Token::Minus, [one, other]) if is_number(one) && is_number(other) => sum(one, other),
        (Token::Plus, [ValueType::Text, ValueType::Any] | [ValueType::Any, ValueType::Text]) => ValueType::Any,
        (Token::Plus, [ValueType::Text, _] | [_, ValueType::Text]) => ValueType::Text,
        (Token::Multiply | Token::Divide | Token::Modulo | Token::PowerOf, [one, other])
            if is_number(one) && is_number(other) =>
        {
            ValueType::NUMBER
        }
        (token, [_, _]) if compares(token) => ValueType::Truth,
        _ => ValueType::Any,
    }
}

/// True if an operator makes sense of a number only with another number.
pub(super) fn wants_numbers(token: &Token) -> bool {
    let reckons =
        matches!(token, Token::Plus | Token::Minus | Token::Multiply | Token::Divide | Token::Modulo | Token::PowerOf);
    reckons || (compares(token) && !matches!(token, Token::In | Token::NotIn))
}

fn compares(token: &Token) -> bool {
    matches!(
        token,
        Token::EqualsTo
            | Token::NotEqualsTo
            | Token::LessThan
            | Token::LessThanEqualsTo
            | Token::GreaterThan
            | Token::GreaterThanEqualsTo
            | Token::In
            | Token::NotIn
    )
}

pub(super) fn function(name: &str, of: &[ValueType]) -> ValueType {
    let of_numbers = |name: &str| maths::UNARY.iter().any(|(known, _)| *known == name);
    match (name, of) {
        ("to_degrees", [_]) => ValueType::in_unit(Unit::Degrees),
        ("to_radians", [_]) => ValueType::in_unit(Unit::Radians),
        ("to_string", [_]) => ValueType::Text,
        (name, [one]) if KEEPING.contains(&name) && is_number(one) => sum(one, one),
        (name, [one, other]) if KEEPING.contains(&name) && is_number(one) && is_number(other) => sum(one, other),
        (name, [one]) if TURNING.contains(&name) && is_number(one) => ValueType::in_unit(Unit::Radians),
        (name, [one, other]) if TURNING.contains(&name) && is_number(one) && is_number(other) => {
            ValueType::in_unit(Unit::Radians)
        }
        (name, [one]) if of_numbers(name) && is_number(one) => ValueType::NUMBER,
        _ => ValueType::Any,
    }
}

/// A number of the unit that both have; what they lie between is no longer known.
fn sum(one: &ValueType, other: &ValueType) -> ValueType {
    match (one, other) {
        (ValueType::Number { unit, .. }, ValueType::Number { unit: same, .. }) => {
            ValueType::Number { unit: unit.filter(|_| unit == same), range: None }
        }
        _ => ValueType::Any,
    }
}

fn is_number(of: &ValueType) -> bool {
    matches!(of, ValueType::Number { .. })
}
