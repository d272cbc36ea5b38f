//! The memory of a continued run as a line: it is written only up to a bound.

use crate::json::json;
use engine::Handover;
use serde::Deserialize;

/// The longest memory that is written, in bytes.
const MEMORY_MAX_BYTES: usize = 4 << 20;

/// A run's memory as JSON; none if it is too large to be kept.
pub(crate) fn written(memory: &Handover) -> Option<String> {
    Some(json(memory)).filter(|text| text.len() <= MEMORY_MAX_BYTES)
}

/// The memory of a line; none if it was too large, or is not one that this program knows.
pub(crate) fn read(line: &str) -> Option<Handover> {
    #[derive(Deserialize)]
    struct MemoryLine {
        memory: Option<Handover>,
    }
    serde_json::from_str::<MemoryLine>(line).ok()?.memory
}
