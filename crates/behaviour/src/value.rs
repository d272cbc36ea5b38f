//! The values that flow through a behaviour: what a sensor reads, a procedure makes and an actuator takes.

pub(crate) mod fields;

use fields::Fields;
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::sync::Arc;

/// One value. Whole numbers and measured numbers are kept apart (`6` is not `6.0`), maps are ordered by key, and
/// a clone is cheap: texts, lists and maps are shared.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Value {
    /// Nothing (JSON `null`, Rhai `()`).
    #[default]
    Null,
    /// True or false.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A measured number. Never NaN or infinite inside a running behaviour.
    Float(f64),
    /// A text.
    Text(Arc<str>),
    /// A list.
    List(Arc<Vec<Value>>),
    /// An object: named fields.
    Map(Fields),
}

impl Value {
    /// A text value.
    #[must_use]
    pub fn text(text: impl AsRef<str>) -> Self {
        Self::Text(Arc::from(text.as_ref()))
    }

    /// An object from its fields.
    pub fn object<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Self {
        Self::Map(fields.into_iter().collect())
    }

    /// A list from its items.
    pub fn list(items: impl IntoIterator<Item = Value>) -> Self {
        Self::List(Arc::new(items.into_iter().collect()))
    }

    /// The field `name` of an object.
    #[must_use]
    #[inline]
    pub fn field(&self, name: &str) -> Option<&Value> {
        match self {
            Self::Map(fields) => fields.get(name),
            Self::Null | Self::Bool(_) | Self::Int(_) | Self::Float(_) | Self::Text(_) | Self::List(_) => None,
        }
    }

    /// The text, if it is one.
    #[must_use]
    #[inline]
    pub fn as_text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// The number, whole or measured.
    #[must_use]
    #[inline]
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Int(whole) => Some(*whole as f64),
            Self::Float(number) => Some(*number),
            Self::Null | Self::Bool(_) | Self::Text(_) | Self::List(_) | Self::Map(_) => None,
        }
    }

    /// Roughly the bytes that it takes in memory, itself included. What it shares with others counts for each of them.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let inside = match self {
            Self::Null | Self::Bool(_) | Self::Int(_) | Self::Float(_) => 0,
            Self::Text(text) => 16 + text.len(),
            Self::List(items) => 40 + items.iter().map(Value::bytes).sum::<usize>(),
            Self::Map(fields) => 64 + fields.values().iter().map(Value::bytes).sum::<usize>(),
        };
        size_of::<Self>() + inside
    }

    /// True when no number in it is NaN or infinite.
    #[must_use]
    #[inline]
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Float(number) => number.is_finite(),
            Self::List(items) => items.iter().all(Value::is_finite),
            Self::Map(fields) => fields.values().iter().all(Value::is_finite),
            Self::Null | Self::Bool(_) | Self::Int(_) | Self::Text(_) => true,
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Float(number)
    }
}

impl From<i64> for Value {
    fn from(whole: i64) -> Self {
        Self::Int(whole)
    }
}

impl From<bool> for Value {
    fn from(truth: bool) -> Self {
        Self::Bool(truth)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::text(text)
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Null => to.serialize_unit(),
            Self::Bool(truth) => to.serialize_bool(*truth),
            Self::Int(whole) => to.serialize_i64(*whole),
            Self::Float(number) => to.serialize_f64(*number),
            Self::Text(text) => to.serialize_str(text),
            Self::List(items) => serialize_list(items, to),
            Self::Map(fields) => serialize_map(fields, to),
        }
    }
}

fn serialize_list<S: Serializer>(items: &[Value], to: S) -> Result<S::Ok, S::Error> {
    let mut list = to.serialize_seq(Some(items.len()))?;
    for item in items {
        list.serialize_element(item)?;
    }
    list.end()
}

fn serialize_map<S: Serializer>(fields: &Fields, to: S) -> Result<S::Ok, S::Error> {
    let mut map = to.serialize_map(Some(fields.len()))?;
    for (name, value) in fields.iter() {
        map.serialize_entry(name, value)?;
    }
    map.end()
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(AnyValue)
    }
}

struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Value;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("a value: null, true, false, a number, a text, a list or an object")
    }
    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }
    fn visit_none<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }
    fn visit_some<D: Deserializer<'de>>(self, from: D) -> Result<Value, D::Error> {
        Value::deserialize(from)
    }
    fn visit_bool<E>(self, truth: bool) -> Result<Value, E> {
        Ok(Value::Bool(truth))
    }
    fn visit_i64<E>(self, whole: i64) -> Result<Value, E> {
        Ok(Value::Int(whole))
    }
    fn visit_u64<E: serde::de::Error>(self, whole: u64) -> Result<Value, E> {
        i64::try_from(whole).map(Value::Int).map_err(|_| E::custom(format!("{whole} is too large for a whole number")))
    }
    fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<Value, E> {
        if number.is_finite() { Ok(Value::Float(number)) } else { Err(E::custom("a number must be finite")) }
    }
    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::text(text))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            list.push(item);
        }
        Ok(Value::List(Arc::new(list)))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut fields = Vec::new();
        while let Some(field) = entries.next_entry::<String, Value>()? {
            fields.push(field);
        }
        Ok(Value::Map(Fields::of(fields)))
    }
}

/// Writes a value for a person or for Rhai: `0.5`, `"red"`, `#{x: 0.1, y: 0.0}`.
impl fmt::Display for Value {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Null => to.write_str("()"),
            Self::Bool(truth) => write!(to, "{truth}"),
            Self::Int(whole) => write!(to, "{whole}"),
            Self::Float(number) => write!(to, "{number:?}"),
            Self::Text(text) => write!(to, "{text:?}"),
            Self::List(items) => fmt_items(to, items),
            Self::Map(fields) => fmt_fields(to, fields),
        }
    }
}

fn fmt_items(to: &mut fmt::Formatter, items: &[Value]) -> fmt::Result {
    to.write_str("[")?;
    for (at, item) in items.iter().enumerate() {
        write!(to, "{}{item}", if at > 0 { ", " } else { "" })?;
    }
    to.write_str("]")
}

fn fmt_fields(to: &mut fmt::Formatter, fields: &Fields) -> fmt::Result {
    to.write_str("#{")?;
    for (at, (name, value)) in fields.iter().enumerate() {
        write!(to, "{}{name}: {value}", if at > 0 { ", " } else { "" })?;
    }
    to.write_str("}")
}

#[cfg(test)]
mod tests {
    use super::Value;

    #[test]
    fn whole_and_measured_numbers_stay_apart_in_json() {
        let read: Value = serde_json::from_str(r#"{"a":6,"b":6.0,"c":[null,true,"x"]}"#).unwrap();
        assert_eq!(read.field("a"), Some(&Value::Int(6)));
        assert_eq!(read.field("b"), Some(&Value::Float(6.0)));
        assert_eq!(serde_json::to_string(&read).unwrap(), r#"{"a":6,"b":6.0,"c":[null,true,"x"]}"#);
        assert_eq!(read.to_string(), r#"#{a: 6, b: 6.0, c: [(), true, "x"]}"#);
    }

    #[test]
    fn a_float_survives_a_round_trip_bit_for_bit() {
        let read: Value = serde_json::from_str("42.699999999999996").unwrap();
        assert_eq!(read, Value::Float(42.699_999_999_999_996));
    }

    #[test]
    fn a_number_that_does_not_fit_is_refused() {
        assert!(serde_json::from_str::<Value>("18446744073709551615").is_err());
        assert!(serde_json::from_str::<Value>("1e999").is_err());
    }
}
