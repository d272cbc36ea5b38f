//! The fit of a value to a type.

use super::Value;
use crate::signature::ValueSignature;

/// A value of just this type.
const EXACT: u32 = 30;
/// A number in another width, a list as a tuple.
const WIDTH: u32 = 21;
/// An integer as a float.
const KIND: u32 = 20;
/// A float without a fraction as an integer.
const WHOLE: u32 = 15;
/// Anything in a dynamic.
const ANY: u32 = 10;

/// Scores the fit of a value to a type: 30 exactly, 20 and 21 with a number widened, 15 for a whole float as an
/// integer, 10 for anything as a dynamic, none if it cannot be given. A list, map or tuple fits as well as the worst of
/// its entries; an empty one fits exactly.
pub fn fit(value: &Value, wanted: &ValueSignature) -> Option<u32> {
    match (wanted, value) {
        (ValueSignature::Dynamic, Value::Dynamic(_)) => Some(EXACT),
        (ValueSignature::Dynamic, _) => Some(ANY),
        (_, Value::Dynamic(inner)) => fit(inner, wanted),
        (ValueSignature::Optional(_), Value::Optional(None) | Value::Unit) => Some(EXACT),
        (ValueSignature::Optional(of), Value::Optional(Some(inner))) => fit(inner, of),
        (ValueSignature::Optional(of), inner) => fit(inner, of).map(|score| score.min(WIDTH)),
        (_, Value::Optional(Some(inner))) => fit(inner, wanted),
        (ValueSignature::Void, Value::Unit)
        | (ValueSignature::Bool, Value::Bool(_))
        | (ValueSignature::Str, Value::Str(_))
        | (ValueSignature::Raw, Value::Raw(_))
        | (ValueSignature::Object, Value::Object(_)) => Some(EXACT),
        (ValueSignature::List(of) | ValueSignature::VarArgs(of), Value::List(items)) => {
            worst(items.iter().map(|item| fit(item, of)))
        }
        (ValueSignature::Map(key, of), Value::Map(entries)) => {
            worst(entries.iter().flat_map(|(name, value)| [fit(name, key), fit(value, of)]))
        }
        (ValueSignature::Tuple(fields, _), Value::Tuple(items)) if fields.len() == items.len() => {
            worst(items.iter().zip(fields).map(|(item, field)| fit(item, field)))
        }
        (ValueSignature::Tuple(fields, _), Value::List(items)) if fields.len() == items.len() => {
            worst(items.iter().zip(fields).map(|(item, field)| fit(item, field))).map(|score| score.min(WIDTH))
        }
        (wanted, value) => number(value, wanted),
    }
}

fn number(value: &Value, wanted: &ValueSignature) -> Option<u32> {
    if value.signature_of_number().as_ref() == Some(wanted) {
        return Some(EXACT);
    }
    let is_float = matches!(value, Value::F32(_) | Value::F64(_));
    let bounds: (i128, i128) = match wanted {
        ValueSignature::F32 | ValueSignature::F64 => {
            return if is_float { Some(WIDTH) } else { value.whole().map(|_| KIND) };
        }
        ValueSignature::I8 => (i8::MIN.into(), i8::MAX.into()),
        ValueSignature::U8 => (0, u8::MAX.into()),
        ValueSignature::I16 => (i16::MIN.into(), i16::MAX.into()),
        ValueSignature::U16 => (0, u16::MAX.into()),
        ValueSignature::I32 => (i32::MIN.into(), i32::MAX.into()),
        ValueSignature::U32 => (0, u32::MAX.into()),
        ValueSignature::I64 => (i64::MIN.into(), i64::MAX.into()),
        ValueSignature::U64 => (0, u64::MAX.into()),
        _ => return None,
    };
    let number = value.integer()?;
    let score = if is_float { WHOLE } else { WIDTH };
    (bounds.0..=bounds.1).contains(&number).then_some(score)
}

impl Value {
    fn signature_of_number(&self) -> Option<ValueSignature> {
        let is_number = self.whole().is_some() || matches!(self, Self::F32(_) | Self::F64(_));
        is_number.then(|| self.signature())
    }
}

fn worst(scores: impl Iterator<Item = Option<u32>>) -> Option<u32> {
    scores.into_iter().try_fold(EXACT, |worst, score| Some(worst.min(score?)))
}
