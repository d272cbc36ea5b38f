//! The name of a field in a procedure.

use behaviour::{Fields, Value};
use std::cell::Cell;
use std::rc::Rc;

/// The number of bits for the place in what a name remembers.
const PLACE_BITS: u32 = 16;
/// Remembered at first: no shape has this number.
const NOTHING: u64 = u64::MAX;

/// A name that remembers where it was in the last object: objects of one shape have it at one place. Small, like all of
/// a procedure: the text is needed only where an object has another shape than the last.
pub(super) struct Name {
    text: Rc<String>,
    /// The shape of the last object, and the place there.
    seen: Cell<u64>,
}

impl Name {
    pub(super) fn of(text: &str) -> Self {
        Self { text: Rc::new(text.to_owned()), seen: Cell::new(NOTHING) }
    }

    /// The field of that name.
    #[inline]
    pub(super) fn of_value<'v>(&self, object: &'v Value) -> Option<&'v Value> {
        let Value::Map(fields) = object else { return None };
        let seen = self.seen.get();
        if seen >> PLACE_BITS == fields.shape() { fields.values().get(place(seen)) } else { self.look_up(fields) }
    }

    #[cold]
    fn look_up<'v>(&self, fields: &'v Fields) -> Option<&'v Value> {
        let at = fields.names().place(&self.text)?;
        let seen = (fields.shape() << PLACE_BITS) | at as u64;
        if seen >> PLACE_BITS == fields.shape() && place(seen) == at {
            self.seen.set(seen);
        }
        fields.values().get(at)
    }
}

fn place(seen: u64) -> usize {
    (seen & ((1 << PLACE_BITS) - 1)) as usize
}

#[cfg(test)]
mod tests {
    use super::Name;
    use behaviour::Value;

    #[test]
    fn a_name_finds_its_field_in_objects_of_all_shapes_in_turn() {
        let name = Name::of("b");
        let many: Vec<String> = (0..70_000).map(|at| format!("a{at:05}")).collect();
        let large = many.iter().map(|name| (name.as_str(), Value::Null)).chain([("b", Value::Int(5))]);
        let objects = [
            Value::object([("a", Value::Int(0)), ("b", Value::Int(1))]),
            Value::object([("b", Value::Int(2))]),
            Value::object([("a", Value::Int(3))]),
            Value::object(large),
            Value::Int(4),
        ];
        for _ in 0..3 {
            let found = objects.each_ref().map(|object| name.of_value(object).and_then(Value::as_number));
            assert_eq!(found, [Some(1.0), Some(2.0), None, Some(5.0), None]);
        }
    }
}
