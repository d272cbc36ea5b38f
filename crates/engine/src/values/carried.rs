//! A value on its way, with when it was sensed.

use behaviour::Value;
use serde::{Deserialize, Serialize};

/// When and as which reading of the run something was sensed.
pub(crate) type Origin = (u64, u64);

/// A value with its origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Carried {
    pub(crate) value: Value,
    pub(crate) origin: Origin,
}
