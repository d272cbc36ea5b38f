//! Random values: every kind, and the numbers at the edges.

use super::procedures::Chance;
use behaviour::Value;

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
pub(super) fn inputs(chance: &mut Chance) -> [Value; 4] {
    if chance.below(5) < 3 {
        return numbers(chance);
    }
    let third = if chance.below(8) == 0 { value(chance, 1) } else { object(chance, 2) };
    let fourth = Value::list([value(chance, 1), value(chance, 0), value(chance, 0)]);
    [value(chance, 1), value(chance, 1), third, fourth]
}

/// Values with numbers alone, so that most calls come to an end.
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
