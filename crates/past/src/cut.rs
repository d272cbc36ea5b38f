//! Values that are short enough to be sent.

use behaviour::Value;

/// The most signs of a text that are sent.
const TEXT_MAX_CHARS: usize = 200;
/// The most parts of a value that are sent, of all its lists and objects together.
const PARTS_MAX: usize = 40;

/// A value as it is sent: long texts end with an ellipsis, and of many parts the first are left.
pub(crate) fn cut(value: &Value) -> Value {
    let mut left = PARTS_MAX;
    some(value, &mut left)
}

fn some(value: &Value, left: &mut usize) -> Value {
    match value {
        Value::Text(text) => match text.char_indices().nth(TEXT_MAX_CHARS) {
            Some((end, _)) => Value::text(format!("{}…", &text[..end])),
            None => value.clone(),
        },
        Value::List(items) => Value::list(items.iter().map_while(|item| part(item, left))),
        Value::Map(fields) => Value::object(fields.iter().map_while(|(name, item)| Some((&**name, part(item, left)?)))),
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) => value.clone(),
    }
}

fn part(value: &Value, left: &mut usize) -> Option<Value> {
    *left = left.checked_sub(1)?;
    Some(some(value, left))
}

#[cfg(test)]
mod tests {
    use super::{PARTS_MAX, TEXT_MAX_CHARS, cut};
    use behaviour::Value;

    #[test]
    fn a_long_value_is_cut_and_a_short_one_is_as_it_was() {
        let short = Value::object([("size", Value::Float(0.5)), ("name", Value::text("赤"))]);
        assert_eq!(cut(&short), short);
        let text = cut(&Value::text("あ".repeat(1_000)));
        assert_eq!(text.as_text().map(|text| text.chars().count()), Some(TEXT_MAX_CHARS + 1));
        let nested = Value::list((0..100).map(|_| Value::list((0..100).map(Value::Int))));
        assert!(cut(&nested).bytes() < (PARTS_MAX + 1) * 100);
    }
}
