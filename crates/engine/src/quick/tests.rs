//! The first tier against Rhai: random procedures on random values, with seeds.

use super::{Quick, Shelf};
use crate::helpers::Helpers;
use crate::limits::Limits;
use crate::procedure::{Procedure, compile};
use crate::sandbox::hardened_engine;
use behaviour::{FileHelper, Value};
use rhai::Engine;

/// Random procedures in one run of the tests.
const BODIES: u64 = 12_000;
/// On how many random inputs each runs.
const CALLS: u64 = 5;

const NAMES: [&str; 4] = ["a", "b", "c", "d"];
const HELPERS: [(&str, &str, &str); 4] = [
    ("half", "v", "v / 2"),
    ("clamp", "v low high", "if v < low { low } else { min(v, high) }"),
    ("pick", "o", "let x = o.x; if x == () { 0 } else { clamp(x, -1, half(9)) }"),
    ("looped", "v", "let n = v; for i in 0..3 { n += i; } n"),
];
const NUMBERS: [&str; 16] = [
    "0",
    "1",
    "2",
    "-3",
    "7",
    "9223372036854775807",
    "0.0",
    "0.1",
    "0.2",
    "0.3",
    "-1.5",
    "1e-300",
    "1e300",
    "4.0",
    "0.30000000000000004",
    "2.5e18",
];
const OPERATORS: [&str; 12] = ["+", "-", "*", "/", "%", "==", "!=", "<", "<=", ">", ">=", "-"];
const UNARY: [&str; 12] =
    ["abs", "sin", "sqrt", "floor", "round", "ceiling", "to_int", "to_float", "fraction", "half", "pick", "ln"];
const BINARY: [&str; 6] = ["min", "max", "hypot", "atan", "log", "max"];

/// Numbers from a seed (splitmix64).
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (mixed ^ (mixed >> 31)) % end
    }

    fn pick<T: Clone>(&mut self, of: &[T]) -> T {
        of[usize::try_from(self.below(of.len() as u64)).unwrap()].clone()
    }
}

fn procedure(chance: &mut Chance) -> String {
    match chance.below(8) {
        0 => format!("let e = {}; {}", part(chance, 3), part(chance, 3).replace('b', "e")),
        1 => format!("{}; {}", part(chance, 2), part(chance, 3)),
        2 => format!("let a = {}; let a = {}; {}", part(chance, 2), part(chance, 2), part(chance, 2)),
        _ => {
            let depth = 1 + chance.below(4);
            part(chance, depth)
        }
    }
}

fn part(chance: &mut Chance, depth: u64) -> String {
    if depth == 0 {
        return leaf(chance);
    }
    let deeper = |chance: &mut Chance| part(chance, depth - 1);
    match chance.below(24) {
        0..=5 => format!("({} {} {})", deeper(chance), chance.pick(&OPERATORS), deeper(chance)),
        6 => format!("({} && {})", truth(chance, depth - 1), truth(chance, depth - 1)),
        7 => format!("({} || {})", truth(chance, depth - 1), deeper(chance)),
        8..=9 => format!("(if {} {{ {} }} else {{ {} }})", truth(chance, depth - 1), deeper(chance), deeper(chance)),
        10 => format!("{}({})", chance.pick(&UNARY), deeper(chance)),
        11 => format!("{}({}, {})", chance.pick(&BINARY), deeper(chance), deeper(chance)),
        12 => format!("clamp({}, {}, {})", deeper(chance), deeper(chance), leaf(chance)),
        13 => format!("#{{x: {}, y: {}}}", deeper(chance), deeper(chance)),
        14 => format!("[{}, {}]", deeper(chance), deeper(chance)),
        15 => format!("{{ let b = {}; {} }}", deeper(chance), deeper(chance)),
        16 => format!("(-{})", deeper(chance)),
        17 => format!("!{}", truth(chance, depth - 1)),
        18 => format!("c.{}", chance.pick(&["x", "y", "z", "x.x", "z.y", "missing", "list[1]", "list[-1]", "x.abs()"])),
        19 => format!("{}[{}]", chance.pick(&["d", "c", "[1, 2.5, b]", "#{x: a}"]), chance.pick(&INDICES)),
        20 => format!("({}).x", deeper(chance)),
        21 => format!("#{{a: {}}}.a", deeper(chance)),
        22 => chance.pick(&ODD).to_owned(),
        _ => leaf(chance),
    }
}

const INDICES: [&str; 9] = ["0", "1", "-1", "-2", "3", "a", "\"x\"", "-9223372036854775808", "b"];
/// What is not compiled, or ends without a value.
const ODD: [&str; 9] =
    ["{ a; }", "if a == b { 1 }", "looped(a)", "a ?? b", "`${a}`", "a ** 2", "(a in d)", "'x'", "\"ab\" + 'c'"];

fn truth(chance: &mut Chance, depth: u64) -> String {
    match chance.below(8) {
        0 if depth > 0 => part(chance, depth - 1),
        1 => "b".to_owned(),
        _ => {
            let operator = chance.pick(&OPERATORS[5..11]);
            format!("({} {operator} {})", part(chance, depth / 2), part(chance, depth / 2))
        }
    }
}

fn leaf(chance: &mut Chance) -> String {
    match chance.below(12) {
        0..=5 => chance.pick(&NAMES).to_owned(),
        6..=9 => chance.pick(&NUMBERS).to_owned(),
        10 => chance.pick(&["\"red\"", "\"\"", "\"赤\"", "true", "false", "()"]).to_owned(),
        _ => chance.pick(&["c.x", "c.y", "d[0]"]).to_owned(),
    }
}

fn value(chance: &mut Chance, depth: u64) -> Value {
    let nested = if depth > 0 { 12 } else { 9 };
    match chance.below(nested) {
        0 => Value::Null,
        1 => Value::Bool(chance.below(2) == 0),
        2 => Value::text(chance.pick(&["", "red", "rec", "赤い"])),
        3 => chance.pick(&[i64::MAX, i64::MIN, 0, -1, 1 << 53]).into(),
        4 => chance.pick(&[-0.0, 5e-324, 1e308, -1e308, 0.1 + 0.2, 1.0 + f64::EPSILON, 1e-17]).into(),
        5 | 6 => Value::Int(i64::try_from(chance.below(12)).unwrap() - 4),
        7 | 8 => Value::Float(chance.below(4_000) as f64 / 1_000.0 - 2.0),
        9 => Value::list([value(chance, depth - 1), value(chance, depth - 1)]),
        _ => object(chance, depth),
    }
}

fn object(chance: &mut Chance, depth: u64) -> Value {
    let list = Value::list([value(chance, depth - 1), value(chance, depth - 1)]);
    let field = |name| (name, Value::Null);
    let mut fields = ["x", "y", "z"].map(field);
    fields.iter_mut().for_each(|field| field.1 = value(chance, depth - 1));
    Value::object(fields.into_iter().chain([("list", list)]))
}

/// The third is mostly an object, the fourth mostly a list.
fn inputs(chance: &mut Chance) -> [Value; 4] {
    if chance.below(5) < 3 {
        return numbers(chance);
    }
    let third = if chance.below(8) == 0 { value(chance, 1) } else { object(chance, 2) };
    let fourth = Value::list([value(chance, 1), value(chance, 0), value(chance, 0)]);
    [value(chance, 1), value(chance, 1), third, fourth]
}

/// The same with numbers alone, so that most calls come to an end.
fn numbers(chance: &mut Chance) -> [Value; 4] {
    let mut number = || {
        let kind = 3 + chance.below(6);
        match kind {
            3 => Value::Int(i64::try_from(chance.below(1_000_000)).unwrap()),
            4 => chance.pick(&[-0.0, 1e-300, 0.1 + 0.2, 1.0 + f64::EPSILON, 1e150]).into(),
            5 | 6 => Value::Int(i64::try_from(chance.below(12)).unwrap() - 4),
            _ => Value::Float(chance.below(4_000) as f64 / 1_000.0 - 2.0),
        }
    };
    let nested = Value::object([("x", number()), ("y", number())]);
    let list = Value::list([number(), number(), number()]);
    let third = Value::object([("x", number()), ("y", number()), ("z", nested), ("list", list)]);
    [number(), number(), third, Value::list([number(), number(), number()])]
}

struct Bench {
    engine: Engine,
    helpers: Helpers,
    names: Vec<String>,
}

impl Bench {
    fn of(limits: &Limits) -> Self {
        let helper = |(name, params, body): (&str, &str, &str)| FileHelper {
            name: name.to_owned(),
            params: params.split(' ').map(str::to_owned).collect(),
            body: body.to_owned(),
            says: String::new(),
        };
        let engine = hardened_engine(limits);
        let helpers = Helpers::compile(&engine, &HELPERS.map(helper), limits).ok().unwrap();
        Self { engine, helpers, names: NAMES.map(str::to_owned).to_vec() }
    }

    fn compiles(&self, body: &str) -> bool {
        self.quick(body).is_some()
    }

    fn quick(&self, body: &str) -> Option<Quick> {
        Quick::of(&compile(&self.engine, &self.names, body).ok()?, &self.names, self.shelf())
    }

    fn shelf(&self) -> &Shelf {
        self.helpers.shelf().unwrap()
    }
}

/// How often what happened.
#[derive(Debug, Default)]
struct Counts {
    refused: u64,
    compiled: u64,
    answered: u64,
    left_to_rhai: u64,
    faults: u64,
}

impl Counts {
    fn call(&mut self, bench: &Bench, quick: &Quick, slow: &mut Procedure, inputs: &[&Value], about: &str) {
        let wanted = slow.interpret(&bench.engine, inputs);
        match (quick.call(inputs), wanted) {
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
        let Ok(mut slow) = Procedure::compile(&bench.engine, &bench.helpers, &bench.names, &body) else {
            counts.refused += 1;
            continue;
        };
        let Some(quick) = bench.quick(&body) else { continue };
        counts.compiled += 1;
        for _ in 0..CALLS {
            let inputs = inputs(&mut chance);
            counts.call(&bench, &quick, &mut slow, &inputs.each_ref(), &format!("seed {seed}: {body}"));
        }
    }
    let Counts { refused, compiled, answered, left_to_rhai, .. } = counts;
    assert!(compiled * 10 > (BODIES - refused) * 6, "most are compiled: {counts:?}");
    assert!(answered > 6_000 && left_to_rhai * 20 < answered, "most are answered: {counts:?}");
}

#[test]
fn what_the_thesis_writes_is_compiled() {
    let gold = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/gold");
    let mut compiled = 0;
    for case in std::fs::read_dir(gold).unwrap() {
        let Ok(text) = std::fs::read_to_string(case.unwrap().path().join("behaviour.json")) else { continue };
        let file: behaviour::BehaviourFile = serde_json::from_str(&text).unwrap();
        let prepared = crate::validate::prepare(&file, &Limits::default()).ok().unwrap();
        for (procedure, connector) in prepared.procedures.iter().zip(&file.connectors) {
            let Some(procedure) = procedure else { continue };
            assert!(procedure.is_quick(), "{:?} {:?}", connector.body, connector.helper);
            compiled += 1;
        }
    }
    assert!(compiled > 30, "{compiled}");
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
        let mut slow = Procedure::compile(&bench.engine, &bench.helpers, &bench.names, body).unwrap();
        assert_eq!(bench.quick(body).unwrap().call(&inputs).is_some(), fits, "{body}");
        assert_eq!(slow.interpret(&bench.engine, &inputs).is_ok(), fits, "{body}");
    }
}

#[test]
fn helpers_that_call_many_helpers_stay_bounded() {
    let call = |at: usize| if at == 0 { "v".to_owned() } else { vec![format!("h{}(v)", at - 1); 8].join(" + ") };
    let helper =
        |at| FileHelper { name: format!("h{at}"), params: vec!["v".into()], body: call(at), says: String::new() };
    let helpers: Vec<_> = (0..12).map(helper).collect();
    let made = crate::try_body(&helpers, &["a".to_owned()], "h11(a)", &[Value::Int(1)], &Limits::default());
    assert_eq!(made.err().as_deref().map(|reason| reason.contains("too many steps")), Some(true));
}
