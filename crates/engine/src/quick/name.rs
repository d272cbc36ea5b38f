//! The name of a field in a procedure.

use behaviour::{Fields, Value};
use std::cell::Cell;
use std::sync::Arc;

/// A name that remembers where it was in the last object: objects of one shape have it at one place.
pub(super) struct Name {
    name: Arc<str>,
    /// The shape of the last object, and the place there.
    seen: Cell<(u64, usize)>,
}

impl Name {
    pub(super) fn of(name: &str) -> Self {
        Self { name: Arc::from(name), seen: Cell::new((u64::MAX, 0)) }
    }

    /// The field of that name.
    #[inline]
    pub(super) fn of_value<'v>(&self, object: &'v Value) -> Option<&'v Value> {
        let Value::Map(fields) = object else { return None };
        let (shape, at) = self.seen.get();
        if shape == fields.shape() { fields.values().get(at) } else { self.look_up(fields) }
    }

    #[cold]
    fn look_up<'v>(&self, fields: &'v Fields) -> Option<&'v Value> {
        let at = fields.names().place(&self.name)?;
        self.seen.set((fields.shape(), at));
        fields.values().get(at)
    }
}
