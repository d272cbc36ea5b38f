//! What timestamp makes: the value and when it was sensed.

use crate::cells::{Made, Number, copy, own_fields, put_number};
use behaviour::Value;
use robot::Millis;
use std::collections::BTreeMap;
use std::sync::Arc;

pub(crate) fn stamped([t, v]: &[Arc<str>; 2], at: Millis, value: &Value) -> Value {
    let time = i64::try_from(at.0).unwrap_or(i64::MAX);
    let mut fields = BTreeMap::new();
    fields.insert(t.clone(), Value::Int(time));
    fields.insert(v.clone(), value.clone());
    Value::Map(Arc::new(fields))
}

/// Two fields.
fn two<'v, T>(mut fields: impl Iterator<Item = T> + 'v) -> Option<[T; 2]> {
    Some([fields.next()?, fields.next()?])
}

/// The same in the place of an older one, where possible.
pub(crate) fn stamp(names: &[Arc<str>; 2], at: Millis, value: &Value, spare: &mut Value) -> Made {
    let time = i64::try_from(at.0).unwrap_or(i64::MAX);
    match own_fields(spare).and_then(two) {
        Some([(_, t), (_, v)]) => {
            put_number(t, Number::Int(time));
            copy(v, value);
            Made::Spare
        }
        _ => Made::Value(stamped(names, at, value)),
    }
}
