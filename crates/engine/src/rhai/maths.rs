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
    register_powers(module);
}

/// `**` of measured numbers. Only an engine without Rhai's short way for operators asks for it.
fn register_powers(module: &mut Module) {
    FuncRegistration::new("**").set_into_module(module, |x: f64, y: f64| libm::pow(x, y));
    FuncRegistration::new("**").set_into_module(module, |x: f64, y: i64| libm::pow(x, y as f64));
    FuncRegistration::new("**").set_into_module(module, |x: i64, y: f64| libm::pow(x as f64, y));
    FuncRegistration::new("**=").set_into_module(module, |x: &mut f64, y: f64| *x = libm::pow(*x, y));
    FuncRegistration::new("**=").set_into_module(module, |x: &mut f64, y: i64| *x = libm::pow(*x, y as f64));
}

/// True for a procedure in which [`register_powers`] matters: there operators take Rhai's long way.
pub(crate) fn has_power(body: &str) -> bool {
    body.contains("**")
}

fn log_to_base(x: f64, base: f64) -> f64 {
    libm::log(x) / libm::log(base)
}

#[cfg(test)]
mod tests {
    use super::{BINARY, UNARY};
    use crate::{Limits, TrialFault, try_body};
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

    #[test]
    fn powers_are_ours_to_the_last_bit() {
        for &x in &[0.1, 0.7, 1.3, 2.0, 10.0, 1234.5] {
            for y in (0..200).map(|step| 0.0173 * f64::from(step) - 1.5) {
                let power = libm::pow(x, y);
                assert_eq!(call("x ** y", &[x, y]), Some(power.to_bits()), "{x} ** {y}");
                assert_eq!(call("let z = x; z **= y; z", &[x, y]), Some(power.to_bits()), "{x} **= {y}");
                assert_eq!(call(&format!("{x:?} ** ({y:?})"), &[x, y]), Some(power.to_bits()), "constants");
            }
            assert_eq!(call("x ** 3", &[x]), Some(libm::pow(x, 3.0).to_bits()));
            assert_eq!(call("3 ** (x / 10)", &[x]), Some(libm::pow(3.0, x / 10.0).to_bits()));
        }
    }

    /// A procedure with a power takes another way to every operator: it must lead to the same results and reasons.
    #[test]
    fn a_power_changes_nothing_else() {
        let values = ["7", "-2", "0", "2.5", "-0.0", "0.30000000000000004", "0.3", "1e300", "\"a\"", "'b'", "true"];
        let values = values.iter().chain(&["()", "[1]", "#{a: 1}", "9223372036854775807"]);
        let operators = ["+", "-", "*", "/", "%", "==", "!=", "<", "<=", ">", ">=", "&&", "||", "<<", "&", "^", "??"];
        for (a, b) in values.clone().flat_map(|a| values.clone().map(move |b| (a, b))) {
            for operator in operators {
                let body = format!("let a = {a}; let b = {b}; a {operator} b");
                assert_eq!(run(&format!("1 ** 1; {body}")), run(&body), "{body}");
                let body = format!("let a = {a}; let b = {b}; a {operator}= b; a");
                let assigns = !matches!(operator, "==" | "!=" | "<" | "<=" | ">" | ">=" | "&&" | "||" | "??");
                assert!(!assigns || run(&format!("1 ** 1; {body}")) == run(&body), "{body}");
            }
            assert_eq!(run(&format!("1 ** 1; -({a})")), run(&format!("-({a})")), "-{a}");
            assert_eq!(run(&format!("1 ** 1; !({a})")), run(&format!("!({a})")), "!{a}");
        }
    }

    fn run(body: &str) -> Result<Value, TrialFault> {
        try_body(&[], &[], body, &[], &Limits::default())
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
