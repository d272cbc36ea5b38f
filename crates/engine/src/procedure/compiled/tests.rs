//! The first tier against Rhai: random procedures on random values, with seeds.

mod procedures;
mod values;

use self::procedures::{BINARY, Chance, HELPERS, NAMES, OPERATORS, UNARY, procedure};
use self::values::inputs;
use super::{Compiled, CompiledHelpers, Short};
use crate::cost::Limits;
use crate::faults::{CallFault, TrialFault};
use crate::procedure::ConnectorProcedure;
use crate::procedure::helpers::HelperPrograms;
use crate::procedure::parse::compile;
use crate::rhai::sandbox::hardened_engine;
use crate::values::in_place::ComputedNumber;
use behaviour::{FileHelper, Value};
use rhai::Engine;

/// Random procedures in one run of the tests.
const BODIES: u64 = 12_000;
/// The number of random inputs on which each runs.
const CALLS: u64 = 5;

struct Bench {
    engine: Engine,
    helpers: HelperPrograms,
    names: Vec<String>,
}

impl Bench {
    fn of(limits: &Limits) -> Self {
        let helper = |(name, params, body): (&str, &str, &str)| FileHelper {
            name: name.to_owned(),
            params: params.split(' ').map(str::to_owned).collect(),
            body: body.to_owned(),
            ..FileHelper::default()
        };
        let engine = hardened_engine(limits);
        let helpers = HelperPrograms::compile(&engine, &HELPERS.map(helper), limits).ok().unwrap();
        Self { engine, helpers, names: NAMES.map(str::to_owned).to_vec() }
    }

    fn compiles(&self, body: &str) -> bool {
        self.compiled(body).is_some()
    }

    fn compiled(&self, body: &str) -> Option<Compiled> {
        Compiled::of(&compile(&self.engine, &self.names, body).ok()?, &self.names, self.helpers())
    }

    /// True if its variables cost nothing in Rhai.
    fn is_free(&self, body: &str) -> bool {
        self.helpers.cost(&compile(&self.engine, &self.names, body).unwrap()).is_none()
    }

    fn helpers(&self) -> &CompiledHelpers {
        self.helpers.compiled().unwrap()
    }
}

/// The number of times that each outcome happened.
#[derive(Debug, Default)]
struct Counts {
    refused: u64,
    compiled: u64,
    answered: u64,
    left_to_rhai: u64,
    faults: u64,
    /// Numbers, truths and objects in the place of older ones.
    short: u64,
    /// Of these, what is one operation with a number.
    one_operation: u64,
    spare: Value,
}

/// Returns the result of a procedure of one operation, where the plan of a run would take its word.
fn one_operation(short: Short, input: &Value) -> Option<Value> {
    match short {
        Short::Compute(operator, number) => {
            let made = operator.apply(ComputedNumber::of(input).ok()?, number).ok();
            made.filter(|made| made.is_finite()).map(ComputedNumber::value)
        }
        Short::Compare(comparison, number) => Some(Value::Bool(comparison.holds_number(input, number))),
    }
}

impl Counts {
    fn short_ways(&mut self, compiled: &Compiled, inputs: &[&Value]) -> Vec<Value> {
        let over = compiled.object(inputs, &mut self.spare).then(|| std::mem::take(&mut self.spare));
        self.spare = compiled.call(inputs).unwrap_or_default();
        let number = compiled.number(inputs).map(|number| number.value());
        let one = compiled.short().and_then(|short| one_operation(short, inputs[0]));
        self.one_operation += u64::from(one.is_some());
        number.into_iter().chain(compiled.truth(inputs).map(Value::Bool)).chain(one).chain(over).collect()
    }

    fn call(
        &mut self,
        bench: &Bench,
        compiled: &Compiled,
        interpreted: &mut ConnectorProcedure,
        inputs: &[&Value],
        about: &str,
    ) {
        let wanted = interpreted.interpret(&bench.engine, inputs);
        for made in self.short_ways(compiled, inputs) {
            self.short += 1;
            let wanted = wanted.as_ref().map(|wanted| format!("{wanted:?}"));
            assert_eq!(Ok(format!("{made:?}")), wanted, "the short way: {about} {inputs:?}");
        }
        match (compiled.call(inputs), wanted) {
            // Printed, since -0.0 is not 0.0 here.
            (Some(made), wanted) => {
                self.answered += 1;
                assert_eq!(Ok(format!("{made:?}")), wanted.map(|wanted| format!("{wanted:?}")), "{about} {inputs:?}");
            }
            (None, Ok(_)) => self.left_to_rhai += 1,
            (None, Err(_)) => self.faults += 1,
        }
    }
}

#[test]
fn the_first_tier_is_right_wherever_it_answers() {
    let bench = Bench::of(&Limits::default());
    let mut counts = Counts::default();
    for seed in 0..BODIES {
        let mut chance = Chance(seed.wrapping_mul(0x5DEE_CE66_D1CE_4E5B));
        let body = procedure(&mut chance);
        let Ok(mut interpreted) = ConnectorProcedure::compile(&bench.engine, &bench.helpers, &bench.names, &body)
        else {
            counts.refused += 1;
            continue;
        };
        let Some(compiled) = bench.compiled(&body) else { continue };
        assert!(bench.is_free(&body), "Rhai would count more steps than the first tier expects: {body}");
        counts.compiled += 1;
        for _ in 0..CALLS {
            let inputs = inputs(&mut chance);
            counts.call(&bench, &compiled, &mut interpreted, &inputs.each_ref(), &format!("seed {seed}: {body}"));
        }
    }
    let Counts { refused, compiled, answered, left_to_rhai, .. } = counts;
    assert!(compiled * 10 > (BODIES - refused) * 6, "most are compiled: {counts:?}");
    assert!(counts.short > 5_000, "most go the short way: {counts:?}");
    assert!(answered > 10_000 && left_to_rhai * 20 < answered, "most are answered: {counts:?}");
}

#[test]
fn what_has_no_certain_end_or_size_is_left_to_rhai() {
    let bench = Bench::of(&Limits::default());
    assert!(bench.compiles("half(a) + pick(c)") && bench.compiles("let x = 1; { let x = 2; }; -x"));
    for body in [
        "a = 1; a",
        "while b { }",
        "looped(a)",
        "[1].map(|x| x)",
        "a ** b",
        "if b { return a } 1",
        "switch a { _ => 1 }",
    ] {
        assert!(!bench.compiles(body), "{body}");
    }
    let links = ".x".repeat(200);
    assert!(!bench.compiles(&format!("c{links}")), "too deep for the stack");
    let few = Bench::of(&Limits { operations: 30, ..Limits::default() });
    assert!(few.compiles("a + b") && !few.compiles("a + b + a + b"), "Rhai counts the steps");
    let flat = Bench::of(&Limits { levels: 2, ..Limits::default() });
    assert!(flat.compiles("half(a)") && !flat.compiles("pick(c)"), "Rhai counts the levels");
}

#[test]
fn what_grows_too_large_is_left_to_rhai() {
    let bench = Bench::of(&Limits::default());
    let (long, many) = (Value::text("a".repeat(3_000)), Value::list(vec![Value::Null; 600]));
    let deep = (0..31).fold(Value::Null, |inner, _| Value::list([inner]));
    let inputs = [&long, &many, &deep, &Value::Float(f64::MAX)];
    for (body, fits) in [
        ("a", true),
        ("a + a", false),
        ("[a]", true),
        ("[a, a]", false),
        ("[b]", true),
        ("#{b: b, c: b}", false),
        ("c", true),
        ("[c]", true),
        ("[[c]]", false),
        ("d", true),
        ("[d * 2]", false),
    ] {
        let mut interpreted = ConnectorProcedure::compile(&bench.engine, &bench.helpers, &bench.names, body).unwrap();
        assert_eq!(bench.compiled(body).unwrap().call(&inputs).is_some(), fits, "{body}");
        assert_eq!(interpreted.interpret(&bench.engine, &inputs).is_ok(), fits, "{body}");
    }
}

#[test]
fn helpers_that_call_many_helpers_stay_bounded() {
    let call = |at: usize| if at == 0 { "v".to_owned() } else { vec![format!("h{}(v)", at - 1); 8].join(" + ") };
    let helper =
        |at| FileHelper { name: format!("h{at}"), params: vec!["v".into()], body: call(at), ..FileHelper::default() };
    let helpers: Vec<_> = (0..12).map(helper).collect();
    let made = crate::try_body(&helpers, &["a".to_owned()], "h11(a)", &[Value::Int(1)], &Limits::default());
    assert_eq!(made, Err(TrialFault::Call(Box::new(CallFault::Steps))));
}

/// Values at the edges: zeros, neighbours within and beyond the tolerance, the largest, every other kind.
fn edges() -> Vec<Value> {
    let near = [1.0 - f64::EPSILON, 1.0 - f64::EPSILON / 2.0, 1.0, 1.0 + f64::EPSILON, 1.0 + 2.0 * f64::EPSILON];
    let floats =
        [0.0, -0.0, 0.3, 0.1 + 0.2, 5e-324, -5e-324, 1e-17, f64::MAX, f64::MIN, 9_007_199_254_740_992.0, 9.3e18];
    let whole = [0, 1, -1, 2, 7, -64, 9_007_199_254_740_993, i64::MAX, i64::MIN];
    let texts = ["", "1", "red", "Red", "赤"].map(Value::text);
    let others = [Value::Null, Value::Bool(true), Value::Bool(false), Value::list([]), Value::object([])];
    let numbers = near.into_iter().chain(floats).map(Value::Float).chain(whole.into_iter().map(Value::Int));
    numbers.chain(texts).chain(others).collect()
}

#[test]
fn every_operator_and_function_is_right_on_every_pair_of_edges() {
    let bench = Bench::of(&Limits::default());
    let operators = OPERATORS.iter().map(|operator| format!("a {operator} b"));
    let endless = OPERATORS.iter().map(|operator| format!("[a / 0.0 {operator} b, (a - a) / 0.0 {operator} b]"));
    let functions = BINARY.iter().map(|name| format!("{name}(a, b)"));
    let beyond = BINARY.iter().map(|name| format!("{name}(a / 0.0, b) > {name}(b, (a - a) / 0.0)"));
    let single = UNARY.iter().map(|name| format!("{name}(a)"));
    let numbers = ["0", "7", "0.0", "0.3", "1e300"];
    let one = OPERATORS.iter().flat_map(|operator| numbers.map(|number| format!("a {operator} {number}")));
    let mut counts = Counts::default();
    for body in operators.chain(endless).chain(functions).chain(beyond).chain(single).chain(one) {
        let compiled = bench.compiled(&body).unwrap();
        let mut interpreted = ConnectorProcedure::compile(&bench.engine, &bench.helpers, &bench.names, &body).unwrap();
        for (one, other) in edges().iter().flat_map(|one| edges().into_iter().map(move |other| (one.clone(), other))) {
            counts.call(&bench, &compiled, &mut interpreted, &[&one, &other, &Value::Null, &Value::Null], &body);
        }
    }
    assert!(counts.answered > 15_000 && counts.left_to_rhai < 3_000, "{counts:?}");
    assert!(counts.one_operation > 15_000, "{counts:?}");
}
