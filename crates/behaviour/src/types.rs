//! The kinds of values that streams carry: the shape, and the unit of the numbers. A type never stops anything; hints
//! and fixes are made of it, and an unknown one is [`ValueType::Any`].

mod declared;
mod device;
mod infer;
mod unit;

pub use declared::Declared;
pub use device::{Claims, DevicePace, DeviceType};
pub use infer::{Inference, SeenKinds, infer, infer_seeing};
pub use unit::{Quantity, Unit};

use crate::{FillFrom, Value};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The depth to which types are told: anything deeper is [`ValueType::Any`].
pub const TYPE_MAX_DEPTH: usize = 6;
/// The most parts of a type that are told, all in all: the rest is [`ValueType::Any`].
pub const TYPE_MAX_PARTS: usize = 128;
/// The most fields of an object that are told: an object with more of them is [`ValueType::Any`].
pub const TYPE_MAX_FIELDS: usize = 32;

/// The kind of a value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ValueType {
    /// Not known, or every value is welcome.
    #[default]
    Any,
    /// True or false.
    Truth,
    /// A number.
    Number {
        /// The unit of the number, if that is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<Unit>,
        /// Between which numbers it lies, both included, if that is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        range: Option<(f64, f64)>,
    },
    /// A text.
    Text,
    /// An object with these fields, and perhaps more.
    Record(BTreeMap<String, ValueType>),
    /// A list of such values.
    List(Box<ValueType>),
    /// Nothing.
    Nothing,
}

/// The answer to whether a value of one kind will do where another kind is wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum Fit {
    /// It will, or nothing speaks against it.
    Good,
    /// It is a number of another unit.
    Unit {
        /// The unit that is wanted.
        wants: Unit,
        /// The unit that comes.
        gets: Unit,
    },
    /// It is something else.
    Not,
}

impl ValueType {
    /// A number of which nothing else is known.
    pub const NUMBER: Self = Self::Number { unit: None, range: None };

    /// A number in a unit, within the range that all numbers of that unit have.
    #[must_use]
    pub fn in_unit(unit: Unit) -> Self {
        Self::Number { unit: Some(unit), range: unit.range() }
    }

    /// An object with these fields.
    pub fn record<'a>(fields: impl IntoIterator<Item = (&'a str, ValueType)>) -> Self {
        Self::Record(fields.into_iter().map(|(name, of)| (name.to_owned(), of)).filled()).bounded()
    }

    /// The kind of a value that is there. Its numbers have no unit.
    #[must_use]
    pub fn of(value: &Value) -> Self {
        Self::of_value(value, TYPE_MAX_DEPTH)
    }

    fn of_value(value: &Value, depth: usize) -> Self {
        let Some(depth) = depth.checked_sub(1) else { return Self::Any };
        match value {
            Value::Null => Self::Nothing,
            Value::Bool(_) => Self::Truth,
            Value::Int(_) | Value::Float(_) => Self::NUMBER,
            Value::Text(_) => Self::Text,
            Value::List(items) => {
                let kinds = items.iter().take(TYPE_MAX_FIELDS).map(|item| Self::of_value(item, depth));
                Self::List(Box::new(kinds.reduce(|one, other| one.or(&other)).unwrap_or_default()))
            }
            Value::Map(fields) if fields.len() > TYPE_MAX_FIELDS => Self::Any,
            Value::Map(fields) => {
                let kinds = fields.iter().map(|(name, value)| (name.to_string(), Self::of_value(value, depth)));
                Self::Record(kinds.filled())
            }
        }
    }

    /// The unit, if it is a number with one.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        if let Self::Number { unit, .. } = self { *unit } else { None }
    }

    /// The kind of a field: unknown if this is no object, nothing if it is one without that field.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<Self> {
        match self {
            Self::Record(fields) => fields.get(name).cloned(),
            _ => Some(Self::Any),
        }
    }

    /// Returns the kind of a value that is either of this kind or of another.
    #[must_use]
    pub fn or(&self, other: &Self) -> Self {
        match (self, other) {
            (one, other) if one == other => one.clone(),
            (Self::Number { unit: one, range: near }, Self::Number { unit: other, range: far }) => Self::Number {
                unit: one.filter(|_| one == other),
                range: near.zip(*far).map(|(near, far)| (near.0.min(far.0), near.1.max(far.1))),
            },
            (Self::Record(one), Self::Record(other)) => {
                let both = one.iter().filter_map(|(name, of)| Some((name.clone(), of.or(other.get(name)?))));
                Self::Record(both.filled())
            }
            (Self::List(one), Self::List(other)) => Self::List(Box::new(one.or(other))),
            _ => Self::Any,
        }
    }

    /// Tells if a value of kind `gets` will do where this kind is wanted. Doubt speaks for it.
    #[must_use]
    pub fn takes(&self, gets: &Self) -> Fit {
        match (self, gets) {
            (Self::Any, _) | (_, Self::Any | Self::Nothing) => Fit::Good,
            (Self::Number { unit: Some(wants), .. }, Self::Number { unit: Some(gets), .. }) if wants != gets => {
                Fit::Unit { wants: *wants, gets: *gets }
            }
            // What is spoken or shown may be a number or a truth: it is written out.
            (Self::Text, Self::Number { .. } | Self::Truth) => Fit::Good,
            (Self::Record(wants), Self::Record(gets)) => {
                let each = wants.iter().map(|(name, want)| gets.get(name).map_or(Fit::Not, |get| want.takes(get)));
                worst(each)
            }
            (Self::List(wants), Self::List(gets)) => wants.takes(gets),
            (one, other) if std::mem::discriminant(one) == std::mem::discriminant(other) => Fit::Good,
            _ => Fit::Not,
        }
    }

    /// This kind with [`ValueType::Any`] where it would be deeper, wider or larger than types are told.
    #[must_use]
    pub fn bounded(self) -> Self {
        let mut parts = TYPE_MAX_PARTS;
        self.within(TYPE_MAX_DEPTH, &mut parts)
    }

    fn within(self, depth: usize, parts: &mut usize) -> Self {
        let Some(left) = parts.checked_sub(1) else { return Self::Any };
        *parts = left;
        match (self, depth) {
            (Self::Record(_) | Self::List(_), 0) => Self::Any,
            (Self::Record(fields), _) if fields.len() > TYPE_MAX_FIELDS => Self::Any,
            (Self::Record(fields), _) => {
                Self::Record(fields.into_iter().map(|(name, of)| (name, of.within(depth - 1, parts))).filled())
            }
            (Self::List(of), _) => Self::List(Box::new(of.within(depth - 1, parts))),
            (plain, _) => plain,
        }
    }
}

fn worst(mut all: impl Iterator<Item = Fit>) -> Fit {
    let mut found = Fit::Good;
    all.try_for_each(|fit| {
        if fit != Fit::Good {
            found = fit;
        }
        (found != Fit::Not).then_some(())
    });
    found
}

/// The signature of a helper: the kinds of its parameters in order, and of its result.
#[derive(Clone, Debug, PartialEq)]
pub struct Signature {
    /// One for each parameter.
    pub takes: Vec<ValueType>,
    /// The kind of the result.
    pub gives: ValueType,
}

#[cfg(test)]
mod tests {
    use super::{Fit, TYPE_MAX_DEPTH, TYPE_MAX_PARTS, Unit, ValueType};
    use crate::Value;

    #[test]
    fn units_decide_whether_numbers_fit() {
        let [m, cm, s] = [Unit::Metres, Unit::Centimetres, Unit::Seconds].map(ValueType::in_unit);
        assert_eq!(m.takes(&m), Fit::Good);
        assert_eq!(m.takes(&ValueType::NUMBER), Fit::Good);
        assert_eq!(ValueType::NUMBER.takes(&m), Fit::Good);
        assert_eq!(m.takes(&cm), Fit::Unit { wants: Unit::Metres, gets: Unit::Centimetres });
        assert_eq!(m.takes(&s), Fit::Unit { wants: Unit::Metres, gets: Unit::Seconds });
        assert_eq!(m.takes(&ValueType::Text), Fit::Not);
        assert_eq!(ValueType::Text.takes(&m), Fit::Good);
    }

    #[test]
    fn an_object_fits_with_more_fields_and_not_with_fewer() {
        let wants = ValueType::record([("x", ValueType::in_unit(Unit::Radians))]);
        let more = ValueType::record([("x", ValueType::in_unit(Unit::Radians)), ("time", ValueType::NUMBER)]);
        assert_eq!((wants.takes(&more), more.takes(&wants)), (Fit::Good, Fit::Not));
        assert_eq!(wants.takes(&ValueType::record([("x", ValueType::Text)])), Fit::Not);
    }

    #[test]
    fn either_of_two_kinds_keeps_what_both_have() {
        let [m, cm] = [Unit::Metres, Unit::Centimetres].map(ValueType::in_unit);
        assert_eq!(m.or(&m), m);
        assert_eq!(m.or(&cm), ValueType::NUMBER);
        assert_eq!(m.or(&ValueType::Text), ValueType::Any);
        let (one, other) =
            (ValueType::record([("x", m.clone()), ("y", cm.clone())]), ValueType::record([("x", m.clone())]));
        assert_eq!(one.or(&other), other);
    }

    #[test]
    fn a_type_has_an_end() {
        let deep = (0..1_000).fold(ValueType::Truth, |inner, _| ValueType::List(Box::new(inner)));
        let bounded = deep.bounded();
        let mut depth = 0;
        let mut at = &bounded;
        while let ValueType::List(inner) = at {
            (depth, at) = (depth + 1, inner);
        }
        assert_eq!((depth, at), (TYPE_MAX_DEPTH, &ValueType::Any));
        let wide: Vec<String> = (0..100).map(|number| format!("f{number}")).collect();
        let wide = ValueType::record(wide.iter().map(|name| (name.as_str(), ValueType::Truth)));
        assert_eq!(wide, ValueType::Any);
        let double = |of: ValueType| ValueType::record([("a", of.clone()), ("b", of)]);
        let large = (0..30).fold(ValueType::Truth, |of, _| double(of));
        assert!(serde_json::to_string(&large).unwrap().len() < 100 * TYPE_MAX_PARTS, "it doubles thirty times");
    }

    #[test]
    fn a_value_says_its_kind() {
        let value = Value::object([("x", Value::Float(1.0)), ("name", Value::text("a"))]);
        let wanted = ValueType::record([("x", ValueType::NUMBER), ("name", ValueType::Text)]);
        assert_eq!(ValueType::of(&value), wanted);
        let text = serde_json::to_string(&ValueType::in_unit(Unit::Fraction)).unwrap();
        assert_eq!(text, r#"{"number":{"unit":"fraction","range":[0.0,1.0]}}"#);
        assert_eq!(serde_json::from_str::<ValueType>(&text).unwrap(), ValueType::in_unit(Unit::Fraction));
    }
}
