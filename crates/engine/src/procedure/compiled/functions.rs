//! The functions of numbers that are known here; each answers only for the kinds of numbers that Rhai has it for.

use super::Unsure;
use super::numbers::Number;
use crate::rhai::maths::{self, Unary};

/// A function of one or two numbers.
#[derive(Clone, Copy)]
pub(super) enum Function {
    /// A function of one measured number.
    Measured(fn(f64) -> f64),
    /// A function of two measured numbers.
    Measured2(fn(f64, f64) -> f64),
    /// A function of one number.
    One(fn(Number) -> Result<Number, Unsure>),
    /// A function of two numbers.
    Two(fn(Number, Number) -> Number),
}

/// Rhai's own, the same on every machine.
const EXACT: [Unary; 7] = [
    ("floor", f64::floor),
    ("ceiling", f64::ceil),
    ("round", f64::round),
    ("int", f64::trunc),
    ("fraction", f64::fract),
    ("to_radians", f64::to_radians),
    ("to_degrees", f64::to_degrees),
];

impl Function {
    /// The function of that name with that many parameters.
    pub(super) fn of(name: &str, parameters: usize) -> Option<Self> {
        match parameters {
            1 => one(name),
            2 => two(name),
            _ => None,
        }
    }
}

fn one(name: &str) -> Option<Function> {
    match name {
        "abs" => return Some(Function::One(abs)),
        "to_float" => return Some(Function::One(to_float)),
        "to_int" => return Some(Function::One(to_int)),
        _ => {}
    }
    let known = maths::UNARY.iter().chain(&EXACT).find(|(known, _)| *known == name);
    known.map(|(_, function)| Function::Measured(*function))
}

fn two(name: &str) -> Option<Function> {
    match name {
        "min" => return Some(Function::Two(min)),
        "max" => return Some(Function::Two(max)),
        _ => {}
    }
    let known = maths::BINARY.iter().find(|(known, _)| *known == name);
    known.map(|(_, function)| Function::Measured2(*function))
}

fn abs(x: Number) -> Result<Number, Unsure> {
    match x {
        Number::Int(whole) => whole.checked_abs().map(Number::Int).ok_or(Unsure),
        Number::Float(number) => Ok(Number::Float(number.abs())),
    }
}

fn to_float(x: Number) -> Result<Number, Unsure> {
    if let Number::Int(whole) = x { Ok(Number::Float(whole as f64)) } else { Err(Unsure) }
}

fn to_int(x: Number) -> Result<Number, Unsure> {
    match x {
        Number::Float(number) if number.abs() < 9.0e18 => Ok(Number::Int(number.trunc() as i64)),
        Number::Float(_) | Number::Int(_) => Err(Unsure),
    }
}

fn min(x: Number, y: Number) -> Number {
    match (x, y) {
        (Number::Int(x), Number::Int(y)) => Number::Int(x.min(y)),
        (x, y) => {
            let (x, y) = (x.float(), y.float());
            Number::Float(if x <= y { x } else { y })
        }
    }
}

fn max(x: Number, y: Number) -> Number {
    match (x, y) {
        (Number::Int(x), Number::Int(y)) => Number::Int(x.max(y)),
        (x, y) => {
            let (x, y) = (x.float(), y.float());
            Number::Float(if x >= y { x } else { y })
        }
    }
}
