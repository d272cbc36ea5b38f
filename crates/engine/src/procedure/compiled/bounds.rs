//! The bounds of the size of values, counted as Rhai counts.

use super::Unsure;
use crate::cost::limits::{Limits, TEXT_BYTES, VALUE_DEPTH};
use behaviour::Value;

/// The bounds that hold while a procedure runs.
#[derive(Clone, Copy)]
pub(super) struct ProcedureBounds {
    pub(super) text_bytes: usize,
    list_items: usize,
    map_fields: usize,
}

/// Items, fields and bytes in a value.
#[derive(Default)]
struct ValueSize {
    items: usize,
    fields: usize,
    bytes: usize,
}

impl ProcedureBounds {
    pub(super) fn of(limits: &Limits) -> Self {
        Self { text_bytes: limits.text_bytes, list_items: limits.list_items, map_fields: limits.map_fields }
    }

    /// Gives a new list or object back if it is within the bounds.
    pub(super) fn check(&self, value: Value) -> Result<Value, Unsure> {
        let mut size = ValueSize::default();
        size.add(&value);
        let fits = size.items <= self.list_items && size.fields <= self.map_fields && size.bytes <= self.text_bytes;
        if fits { Ok(value) } else { Err(Unsure) }
    }
}

impl ValueSize {
    fn add(&mut self, value: &Value) {
        match value {
            Value::Text(text) => self.bytes += text.len(),
            Value::List(items) => {
                self.items += items.len();
                items.iter().for_each(|item| self.add(item));
            }
            Value::Map(fields) => {
                self.fields += fields.len();
                fields.values().iter().for_each(|value| self.add(value));
            }
            Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) => {}
        }
    }
}

/// True for what may leave a procedure: finite numbers, nested within bounds, with names that are not endless.
pub(super) fn may_flow(value: &Value) -> bool {
    may_flow_nested(value, VALUE_DEPTH) && names_bytes(value) <= TEXT_BYTES
}

fn names_bytes(value: &Value) -> usize {
    match value {
        Value::List(items) => items.iter().map(names_bytes).sum(),
        Value::Map(fields) => fields.iter().map(|(name, value)| name.len() + names_bytes(value)).sum(),
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) | Value::Text(_) => 0,
    }
}

fn may_flow_nested(value: &Value, depth: usize) -> bool {
    match value {
        Value::Float(number) => number.is_finite(),
        Value::List(items) => depth > 0 && items.iter().all(|item| may_flow_nested(item, depth - 1)),
        Value::Map(fields) => depth > 0 && fields.values().iter().all(|value| may_flow_nested(value, depth - 1)),
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Text(_) => true,
    }
}
