//! Functions of numbers, computed by `libm`: the same bits natively and in the browser.

use rhai::{FuncRegistration, Module};

/// A name and a function of one number.
pub(crate) type Unary = (&'static str, fn(f64) -> f64);
/// A name and a function of two numbers.
pub(crate) type Binary = (&'static str, fn(f64, f64) -> f64);

pub(crate) const UNARY: [Unary; 16] = [
    ("sin", libm::sin),
    ("cos", libm::cos),
    ("tan", libm::tan),
    ("asin", libm::asin),
    ("acos", libm::acos),
    ("atan", libm::atan),
    ("sinh", libm::sinh),
    ("cosh", libm::cosh),
    ("tanh", libm::tanh),
    ("asinh", libm::asinh),
    ("acosh", libm::acosh),
    ("atanh", libm::atanh),
    ("sqrt", libm::sqrt),
    ("exp", libm::exp),
    ("ln", libm::log),
    ("log", libm::log10),
];

pub(crate) const BINARY: [Binary; 4] =
    [("atan", libm::atan2), ("atan2", libm::atan2), ("hypot", libm::hypot), ("log", log_to_base)];

/// Puts them over Rhai's own.
pub(crate) fn register(module: &mut Module) {
    for (name, function) in UNARY {
        FuncRegistration::new(name).set_into_module(module, move |x: f64| function(x));
    }
    for (name, function) in BINARY {
        FuncRegistration::new(name).set_into_module(module, move |x: f64, y: f64| function(x, y));
    }
}

fn log_to_base(x: f64, base: f64) -> f64 {
    libm::log(x) / libm::log(base)
}

#[cfg(test)]
mod tests {
    use super::{BINARY, UNARY};
    use crate::{Limits, try_body};
    use behaviour::Value;

    /// Rhai's and ours agree on most numbers; over enough of them a difference shows whose function runs.
    #[test]
    fn every_function_is_ours_to_the_last_bit() {
        let xs: Vec<f64> = (1..400).map(|step| 0.0123 * f64::from(step) + 0.001).collect();
        for (name, function) in UNARY {
            for &x in xs.iter().filter(|x| function(**x).is_finite()) {
                let made = call(&format!("{name}(x)"), &[x]);
                assert_eq!(made, Some(function(x).to_bits()), "{name}({x})");
            }
        }
        for (name, function) in BINARY {
            for &x in xs.iter().filter(|x| function(**x, 3.7).is_finite()) {
                assert_eq!(call(&format!("{name}(x, y)"), &[x, 3.7]), Some(function(x, 3.7).to_bits()), "{name}({x})");
            }
        }
    }

    fn call(body: &str, inputs: &[f64]) -> Option<u64> {
        let arguments = ["x".to_owned(), "y".to_owned()];
        let inputs: Vec<_> = inputs.iter().copied().map(Value::Float).collect();
        match try_body(&[], &arguments[..inputs.len()], body, &inputs, &Limits::default()) {
            Ok(Value::Float(number)) => Some(number.to_bits()),
            _ => None,
        }
    }
}
