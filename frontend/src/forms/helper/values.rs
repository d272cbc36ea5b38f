//! The values that a helper is tried on: as they are typed, and which ones are proposed.

use crate::forms::trials::SETS_MAX;
use behaviour::{Helper, Unit, Value, ValueType};

/// Values as they are typed, with commas between them; what is no number, object or the like is a text.
pub(super) fn typed(text: &str) -> Vec<Value> {
    let all = crate::json::read::<Vec<Value>>(&format!("[{text}]"));
    let plain = |part: &str| crate::json::read(part).unwrap_or_else(|_| Value::text(part));
    let parts = || text.split(',').map(str::trim).filter(|part| !part.is_empty()).map(plain).collect();
    let mut values: Vec<Value> = all.unwrap_or_else(|_| parts());
    values.truncate(SETS_MAX);
    values
}

/// The sets of values to try, from the values of each argument: where one has fewer, its last one stays.
pub(super) fn sets(columns: &[Vec<Value>]) -> Vec<Vec<Value>> {
    let longest = columns.iter().map(Vec::len).max().unwrap_or_default();
    let set = |at: usize| -> Option<Vec<Value>> {
        columns.iter().map(|column| column.get(at).or(column.last()).cloned()).collect()
    };
    (0..longest).filter_map(set).collect()
}

/// Values as somebody would type them; of a measured number four decimals are enough.
pub(super) fn written(values: &[Value]) -> String {
    let one = |value: &Value| serde_json::to_string(&short(value)).unwrap_or_default();
    values.iter().map(one).collect::<Vec<_>>().join(", ")
}

fn short(value: &Value) -> Value {
    match value {
        Value::Float(number) => Value::Float((number * 10_000.0).round() / 10_000.0),
        Value::Map(fields) => Value::object(fields.iter().map(|(name, value)| (&**name, short(value)))),
        other => other.clone(),
    }
}

/// The fields of an argument that a procedure asks for: of `ball` in `ball.x + ball.size` they are `x` and `size`.
pub(super) fn fields<'body>(argument: &str, body: &'body str) -> Vec<&'body str> {
    let is_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let after = |(at, _): (usize, &str)| {
        let is_whole = !body[..at].ends_with(|letter| is_name(letter) || letter == '.');
        let rest = body[at + argument.len()..].strip_prefix('.').filter(|_| is_whole)?;
        let end = rest.find(|letter| !is_name(letter)).unwrap_or(rest.len());
        (end > 0 && !rest[end..].starts_with('(')).then(|| &rest[..end])
    };
    if argument.is_empty() { Vec::new() } else { body.match_indices(argument).filter_map(after).collect() }
}

/// Whether a value can stand for an argument of which a procedure asks for these fields.
pub(super) fn fits(value: &Value, fields: &[&str]) -> bool {
    let is_object = matches!(value, Value::Map(_));
    is_object != fields.is_empty() && fields.iter().all(|field| value.field(field).is_some())
}

/// A value such as the argument could have: what a sense gives that has its fields, else a number in its unit.
pub(super) fn example(helper: &Helper, at: usize) -> Option<Value> {
    let argument = helper.params.get(at)?;
    let fields = fields(argument, &helper.body);
    if !fields.is_empty() {
        let examples = robot::sensors().filter_map(|device| crate::json::read::<Value>(device.example).ok());
        return examples.into_iter().find(|value| fits(value, &fields));
    }
    let of_before = || robot::shipped_signature(helper).and_then(|signature| signature.takes.get(at).cloned());
    Some(match helper.taken(at).value_type().or_else(of_before) {
        Some(ValueType::Number { unit: Some(Unit::Metres | Unit::Radians | Unit::Fraction), .. }) => Value::Float(0.5),
        Some(ValueType::Truth) => Value::Bool(true),
        Some(ValueType::Text) => Value::text("red"),
        _ => Value::Int(1),
    })
}

#[cfg(test)]
mod tests {
    use super::{example, fields, fits, sets, typed, written};
    use behaviour::{Helper, Value};

    #[test]
    fn what_is_typed_is_one_value_or_several() {
        assert_eq!(typed("0.5"), [Value::Float(0.5)]);
        assert_eq!(typed("1, 2 ,3"), [1, 2, 3].map(Value::Int));
        assert_eq!(typed("left, right"), [Value::text("left"), Value::text("right")]);
        assert_eq!(typed(r#"{"x":1,"y":2}"#).len(), 1);
        assert_eq!(typed("[1, 2]").len(), 1);
        assert_eq!(typed("1,2,3,4,5,6,7,8,9").len(), 5);
        assert!(typed(" ").is_empty());
    }

    #[test]
    fn an_argument_with_fewer_values_keeps_its_last_one() {
        let (far, near) = (Value::Int(9), Value::Int(1));
        let made = sets(&[vec![far.clone(), near.clone()], vec![Value::text("a")]]);
        assert_eq!(made, [vec![far.clone(), Value::text("a")], vec![near, Value::text("a")]]);
        assert!(sets(&[vec![far], Vec::new()]).is_empty());
        assert!(sets(&[]).is_empty());
    }

    #[test]
    fn values_are_written_as_they_are_typed() {
        let ball = Value::object([("x", Value::Float(0.123_456)), ("label", Value::text("red"))]);
        let text = written(&[ball, Value::Int(2)]);
        assert_eq!(typed(&text).len(), 2, "{text}");
        assert!(text.contains("0.1235"));
    }

    #[test]
    fn the_fields_that_are_asked_for_are_found() {
        assert_eq!(fields("ball", "football.y + ball.x + ball.size - ball.len()"), ["x", "size"]);
        assert!(fields("d", "min(1.0, d)").is_empty() && fields("", "x").is_empty());
        assert!(fits(&Value::Int(1), &[]) && !fits(&Value::Int(1), &["x"]));
        assert!(fits(&Value::object([("x", Value::Int(1))]), &["x"]));
    }

    #[test]
    fn every_shipped_helper_has_an_example() {
        for helper in robot::shipped_helpers() {
            assert!(example(&helper, 0).is_some(), "{}", helper.name);
        }
        let other =
            Helper { name: "f".into(), params: vec!["a".into()], body: "a.nothing_has_it".into(), ..Helper::default() };
        assert_eq!((example(&other, 0), example(&other, 1)), (None, None));
    }
}
