//! The values of a stream one by one, as long as they are few: so that those of a long time can be drawn at once.

use crate::cut::cut;
use behaviour::Value;
use protocol::LANE_VALUES_MAX;

/// The most bytes of the values that are kept of all streams.
const BYTES_MAX: usize = 4 << 20;

/// A value with its time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SparseValue {
    pub(crate) at_ms: u64,
    pub(crate) value: Value,
    pub(crate) pretended: bool,
}

impl SparseValue {
    fn bytes(&self) -> usize {
        size_of::<Self>() - size_of::<Value>() + self.value.bytes()
    }
}

/// Few values, or too many.
#[derive(Debug)]
pub(crate) struct Sparse(Option<Vec<SparseValue>>);

impl Default for Sparse {
    fn default() -> Self {
        Self(Some(Vec::new()))
    }
}

impl Sparse {
    /// Adds a value. `bytes` counts those of all that are kept.
    pub(crate) fn add(&mut self, at_ms: u64, value: &Value, pretended: bool, bytes: &mut usize) {
        let Some(all) = &mut self.0 else { return };
        if all.len() == LANE_VALUES_MAX || *bytes > BYTES_MAX {
            *bytes = bytes.saturating_sub(all.iter().map(SparseValue::bytes).sum());
            self.0 = None;
            return;
        }
        let kept = SparseValue { at_ms, value: cut(value), pretended };
        *bytes += kept.bytes();
        all.push(kept);
    }

    /// All values; none if they are many.
    pub(crate) fn all(&self) -> Option<&[SparseValue]> {
        self.0.as_deref()
    }
}
