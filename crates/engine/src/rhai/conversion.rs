//! Between the values of a run and the values of Rhai.

use crate::cost::limits::{TEXT_BYTES, VALUE_DEPTH};
use crate::faults::{ValueFault, ValueKind};
use behaviour::{Fields, Value};
use rhai::{Array, Dynamic, ImmutableString, Map};
use std::sync::Arc;

/// A value for Rhai. Whole and measured numbers stay apart.
pub(crate) fn to_rhai(value: &Value) -> Dynamic {
    match value {
        Value::Null => Dynamic::UNIT,
        Value::Bool(truth) => Dynamic::from_bool(*truth),
        Value::Int(whole) => Dynamic::from_int(*whole),
        Value::Float(number) => Dynamic::from_float(*number),
        Value::Text(text) => Dynamic::from(ImmutableString::from(text.as_ref())),
        Value::List(items) => Dynamic::from_array(items.iter().map(to_rhai).collect()),
        Value::Map(fields) => {
            let mut map = Map::new();
            map.extend(fields.iter().map(|(name, value)| (name.as_ref().into(), to_rhai(value))));
            Dynamic::from_map(map)
        }
    }
}

/// Puts a value for Rhai where another one was. An object goes over one with the same names: making a new one costs more
/// than most procedures.
pub(crate) fn put_rhai(place: &mut Dynamic, value: &Value) {
    if let Value::Map(fields) = value
        && !place.is_shared()
        && let Ok(mut older) = place.as_map_mut()
        && goes_over(&mut older, fields)
    {
        return;
    }
    *place = to_rhai(value);
}

fn goes_over(older: &mut Map, fields: &Fields) -> bool {
    let has_names = || older.keys().zip(fields.iter()).all(|(older, (name, _))| older.as_str() == name.as_ref());
    let fits = older.len() == fields.len() && has_names();
    if fits {
        older.values_mut().zip(fields.iter()).for_each(|(place, (_, value))| put_rhai(place, value));
    }
    fits
}

/// A value from Rhai.
///
/// # Errors
/// Returns the reason why it cannot flow: a number that is not finite, a closure, a range, nesting without end, names
/// of fields that are longer than a text may be.
pub(crate) fn from_rhai(made: Dynamic) -> Result<Value, ValueFault> {
    if names_bytes(&made, VALUE_DEPTH) > TEXT_BYTES {
        return Err(ValueFault::LongNames);
    }
    from_nested(made, VALUE_DEPTH)
}

/// Rhai counts the texts of a value, but not the names of its fields.
fn names_bytes(made: &Dynamic, depth: usize) -> usize {
    let Some(depth) = depth.checked_sub(1) else { return 0 };
    if let Ok(items) = made.as_array_ref() {
        return items.iter().map(|item| names_bytes(item, depth)).sum();
    }
    let Ok(fields) = made.as_map_ref() else { return 0 };
    fields.iter().map(|(name, value)| name.len() + names_bytes(value, depth)).sum()
}

fn from_nested(made: Dynamic, depth: usize) -> Result<Value, ValueFault> {
    let made = made.flatten();
    if let Ok(number) = made.as_float() {
        return finite(number);
    }
    if let Ok(whole) = made.as_int() {
        return Ok(Value::Int(whole));
    }
    if let Ok(truth) = made.as_bool() {
        return Ok(Value::Bool(truth));
    }
    if made.is_unit() {
        return Ok(Value::Null);
    }
    from_composite(made, depth)
}

fn finite(number: f64) -> Result<Value, ValueFault> {
    if number.is_nan() {
        Err(ValueFault::NotANumber)
    } else if number.is_infinite() {
        Err(ValueFault::Infinite)
    } else {
        Ok(Value::Float(number))
    }
}

fn from_composite(made: Dynamic, depth: usize) -> Result<Value, ValueFault> {
    let made = match made.try_cast_result::<ImmutableString>() {
        Ok(text) => return Ok(Value::text(text)),
        Err(made) => made,
    };
    let deeper = depth.checked_sub(1).ok_or(ValueFault::TooDeep);
    if made.is_array() {
        return made.try_cast::<Array>().map_or(Ok(Value::Null), |items| from_array(items, deeper?));
    }
    if made.is_map() {
        return made.try_cast::<Map>().map_or(Ok(Value::Null), |fields| from_map(fields, deeper?));
    }
    if let Ok(letter) = made.as_char() {
        return Ok(Value::text(letter.encode_utf8(&mut [0; 4])));
    }
    Err(ValueFault::Kind(ValueKind::of(made.type_name())))
}

fn from_array(items: Array, depth: usize) -> Result<Value, ValueFault> {
    let items = items.into_iter().map(|item| from_nested(item, depth));
    Ok(Value::List(Arc::new(items.collect::<Result<_, _>>()?)))
}

fn from_map(fields: Map, depth: usize) -> Result<Value, ValueFault> {
    let fields = fields.into_iter().map(|(name, value)| Ok((name, from_nested(value, depth)?)));
    Ok(Value::Map(Fields::of(fields.collect::<Result<Vec<_>, ValueFault>>()?)))
}

#[cfg(test)]
mod tests {
    use super::{from_rhai, put_rhai, to_rhai};
    use crate::faults::{ValueFault, ValueKind};
    use behaviour::Value;

    #[test]
    fn a_value_comes_back_as_it_went() {
        let list = Value::list([Value::Int(6), Value::Float(6.0), Value::Null, Value::Bool(true)]);
        let value = Value::object([("b", list), ("a", Value::text("赤い")), ("c", Value::object([]))]);
        assert_eq!(from_rhai(to_rhai(&value)), Ok(value));
    }

    #[test]
    fn a_value_over_another_one_is_the_same_as_a_new_one() {
        let object =
            |x: Value, inner: &[(&str, Value)]| Value::object([("x", x), ("in", Value::object(inner.iter().cloned()))]);
        let values = [
            object(Value::Int(1), &[("a", Value::Null)]),
            object(Value::text("two"), &[("a", Value::Float(2.0))]),
            object(Value::Int(3), &[("b", Value::Float(2.0))]),
            object(Value::Int(4), &[("a", Value::Int(1)), ("b", Value::list([Value::Int(5)]))]),
            Value::Int(6),
            Value::object([("x", Value::Int(7))]),
        ];
        for before in &values {
            for value in &values {
                let mut place = to_rhai(before);
                put_rhai(&mut place, value);
                assert_eq!(from_rhai(place).as_ref(), Ok(value), "over {before}");
            }
        }
    }

    #[test]
    fn what_cannot_flow_is_told() {
        assert_eq!(from_rhai(rhai::Dynamic::from_float(f64::NAN)), Err(ValueFault::NotANumber));
        assert_eq!(from_rhai(rhai::Dynamic::from(0_i64..3)), Err(ValueFault::Kind(ValueKind::Range)));
        let nested = (0..40).fold(Value::Null, |inner, _| Value::list([inner]));
        assert_eq!(from_rhai(to_rhai(&nested)), Err(ValueFault::TooDeep));
    }
}
