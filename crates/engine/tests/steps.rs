//! Steps by the size of values: what is large costs more, what therapists write costs next to nothing. No clock here: a
//! procedure takes the same number of steps everywhere.

use behaviour::Value;
use engine::{Limits, TrialFault, try_body};

/// More steps than any procedure here takes.
const MANY: u64 = 1 << 22;
/// A tenth of the steps that a procedure has.
const TENTH: u64 = 1_000;

fn run(body: &str, x: &Value, operations: u64) -> Result<Value, TrialFault> {
    let limits = Limits { operations, ..Limits::default() };
    try_body(&[], &["x".to_owned()], body, std::slice::from_ref(x), &limits)
}

/// The smallest limit under which a body ends by itself.
fn steps(body: &str, x: &Value) -> u64 {
    let (mut low, mut high) = (1, MANY);
    let made = run(body, x, high);
    assert!(made.is_ok(), "{body}: {made:?}");
    while low < high {
        let middle = low.midpoint(high);
        if run(body, x, middle).is_ok() { high = middle } else { low = middle + 1 }
    }
    low
}

/// Steps of one more time of a part, in a loop, with `x` of that size.
fn steps_of(part: &str, begin: &str, x: &Value) -> u64 {
    let repeated = |times: u64| format!("{begin} for i in 0..{times} {{ {part} }} 1");
    (steps(&repeated(12), x) - steps(&repeated(2), x)) / 10
}

fn numbers(many: i64) -> Value {
    Value::list((0..many).map(|at| Value::Int(at * 7919 % 1000)).collect::<Vec<_>>())
}

/// Asserts that a part costs more the larger `x` is, and nothing extra with a small one.
fn assert_grows(parts: &[&str], begin: &str, size: impl Fn(usize) -> Value) {
    for part in parts {
        let [none, small, large, larger] = [0, 4, 400, 900].map(|many| steps_of(part, begin, &size(many)));
        assert!(small <= none + 12, "{part}: {none}, {small}");
        assert!(large > small && larger > large, "{part}: {none}, {small}, {large}, {larger}");
    }
}

#[test]
fn what_copies_or_goes_through_a_list_costs_by_its_length() {
    let parts = [
        "let k = l;",
        "[l];",
        "#{a: l};",
        "l == l;",
        "l != l;",
        "l + [];",
        "for v in l { break; }",
        "switch l { 1 => 2, _ => 3 };",
        "let k = l; k.sort();",
        "l.sort();",
        "l.sort_desc();",
        "l.order();",
        "l.reverse();",
        "l.contains(-1);",
        "-1 in l;",
        "l.index_of(-1);",
        "l.dedup();",
        "l.extract(0);",
        "let k = l; k.split(3);",
        "try { throw l; } catch { }",
        "let f = || l; f.call();",
        "let m = #{a: l}; m.a;",
        "is_shared(l);",
        "l[0];",
        "l.len();",
        "l.push(1); l.pop();",
        "l.insert(0, 1); l.remove(0);",
        "l += [];",
        "try { l - 1; } catch { }",
    ];
    assert_grows(&parts, "let l = x; l.pad(2, 0); ", |many| numbers(many as i64));
}

#[test]
fn what_copies_or_goes_through_an_object_costs_by_its_fields() {
    let object = |many: usize| {
        let names: Vec<_> = (0..many / 4).map(|at| format!("k{at}")).collect();
        Value::object(names.iter().map(|name| (name.as_str(), Value::Int(1))))
    };
    let parts = [
        "let k = m;",
        "m == m;",
        "m + #{};",
        "m.keys();",
        "m.values();",
        "m.to_json();",
        "`${m}`;",
        "m.len();",
        "m[\"a\"];",
        "m.b = 1;",
        "switch m { 1 => 2, _ => 3 };",
        "m.contains(\"b\");",
    ];
    assert_grows(&parts, "let m = x; m.a = 1; ", object);
}

#[test]
fn what_goes_through_a_text_costs_by_its_bytes() {
    let parts = [
        "t.to_upper();",
        "t.to_lower();",
        "t.trim();",
        "t.contains(\"b\");",
        "t.index_of(\"b\");",
        "t.replace(\"b\", \"c\");",
        "t.remove(\"b\");",
        "t.split(\"b\");",
        "t.sub_string(1);",
        "t.chars();",
        "t.crop(0);",
        "t.starts_with(t);",
        "t - \"b\";",
        "for c in t { break; }",
        "t[0];",
        "t[0] = 'a';",
        "t.len();",
        "t.to_debug();",
        "try { parse_int(t); } catch { }",
        "try { parse_float(t); } catch { }",
    ];
    assert_grows(&parts, "let t = x; t.pad(2, 'a'); ", |many| Value::text("9".repeat(many * 4)));
}

#[test]
fn nested_lists_and_long_names_cost_as_a_whole() {
    let nested = |many: usize| Value::list([numbers(many as i64), numbers(3)]);
    assert_grows(&["let k = l;", "l[0];", "l[0].len();", "l == l;"], "let l = x; ", nested);
    let named = |many: usize| Value::object([("n".repeat(many * 4).as_str(), Value::Int(1))]);
    assert_grows(&["let k = m;", "m + #{};"], "let m = x; ", named);
}

#[test]
fn a_ready_made_list_in_a_loop_costs_by_its_length() {
    let literal =
        |many: usize| steps_of(&format!("n += [{}].len();", vec!["1"; many].join(", ")), "let n = 0;", &Value::Int(1));
    assert_eq!(literal(3), literal(60));
    let costs = [3, 300, 700].map(literal);
    assert!(costs.is_sorted_by(|less, more| less < more), "{costs:?}");
}

/// A part that runs once is not charged, whatever its size: most procedures have no loop at all.
#[test]
fn a_procedure_that_certainly_ends_pays_for_functions_only() {
    for body in
        ["let k = x; k == x || true; x", "let a = x[0]; let b = x; [a, b.len()]", "if x.len() > 3 { x } else { [] }"]
    {
        assert!(steps(body, &numbers(3)) < TENTH, "{body}");
        assert!(run(body, &numbers(900), 10_000).is_ok(), "{body}");
    }
}

#[test]
fn what_therapists_write_has_ten_times_the_room() {
    let text = Value::text("The ball is red. ".repeat(12));
    let faces = Value::list(
        (0..10).map(|at| Value::object([("x", Value::Int(at)), ("label", Value::text("Anna"))])).collect::<Vec<_>>(),
    );
    let list = numbers(100);
    for (body, x) in [
        ("let l = x; l.sort(); l", &list),
        ("let l = x; l.sort(); (l[49] + l[50]) / 2", &list),
        ("let s = 0; for v in x { s += v; } s / x.len()", &list),
        ("x.filter(|v| v > 500).len()", &list),
        ("x.map(|v| v * 2)", &list),
        ("x.reduce(|s, v| s + v, 0)", &list),
        ("let most = x[0]; for v in x { if v > most { most = v; } } most", &list),
        ("let l = x; l.push(7); l.shift(); l", &list),
        ("x.index_of(7) >= 0 || 7 in x", &list),
        ("x == x", &list),
        ("x.to_upper().contains(\"RED\")", &text),
        ("x.split(\" \").len()", &text),
        ("let n = 0; for word in x.split(\" \") { if word == \"red.\" { n += 1; } } n", &text),
        ("let t = \"\"; for i in 0..40 { t += \"a word \"; } t.len()", &text),
        ("let near = x.filter(|face| face.x < 5); near.map(|face| face.label)", &faces),
        ("let nearest = x[0]; for face in x { if face.x < nearest.x { nearest = face; } } nearest.label", &faces),
        ("let seen = #{}; for face in x { seen[face.label] = face.x; } seen.keys()", &faces),
    ] {
        let made = run(body, x, TENTH);
        assert!(made.is_ok(), "{body}: {made:?}, {} steps", steps(body, x));
    }
}
