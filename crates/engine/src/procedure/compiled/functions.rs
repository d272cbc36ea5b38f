//! The functions of numbers that are known here; each answers only for the kinds of numbers that Rhai has it for.

use super::Unsure;
use super::numbers::ComputedNumber;
use crate::rhai::maths::{self, Unary};

/// A function of one or two numbers.
#[derive(Clone, Copy)]
pub(super) enum Function {
    /// A function of one measured number.
    Measured(fn(f64) -> f64),
    /// A function of two measured numbers.
    Measured2(fn(f64, f64) -> f64),
    /// A function of one number.
    One(fn(ComputedNumber) -> Result<ComputedNumber, Unsure>),
    /// A function of two numbers.
    Two(fn(ComputedNumber, ComputedNumber) -> ComputedNumber),
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

fn abs(x: ComputedNumber) -> Result<ComputedNumber, Unsure> {
    match x {
        ComputedNumber::Int(whole) => whole.checked_abs().map(ComputedNumber::Int).ok_or(Unsure),
        ComputedNumber::Float(number) => Ok(ComputedNumber::Float(number.abs())),
    }
}

fn to_float(x: ComputedNumber) -> Result<ComputedNumber, Unsure> {
    if let ComputedNumber::Int(whole) = x { Ok(ComputedNumber::Float(whole as f64)) } else { Err(Unsure) }
}

fn to_int(x: ComputedNumber) -> Result<ComputedNumber, Unsure> {
    match x {
        ComputedNumber::Float(number) if number.abs() < 9.0e18 => Ok(ComputedNumber::Int(number.trunc() as i64)),
        ComputedNumber::Float(_) | ComputedNumber::Int(_) => Err(Unsure),
    }
}

fn min(x: ComputedNumber, y: ComputedNumber) -> ComputedNumber {
    match (x, y) {
        (ComputedNumber::Int(x), ComputedNumber::Int(y)) => ComputedNumber::Int(x.min(y)),
        (x, y) => {
            let (x, y) = (x.float(), y.float());
            ComputedNumber::Float(if x <= y { x } else { y })
        }
    }
}

fn max(x: ComputedNumber, y: ComputedNumber) -> ComputedNumber {
    match (x, y) {
        (ComputedNumber::Int(x), ComputedNumber::Int(y)) => ComputedNumber::Int(x.max(y)),
        (x, y) => {
            let (x, y) = (x.float(), y.float());
            ComputedNumber::Float(if x >= y { x } else { y })
        }
    }
}
