//! A value on its way, with when it was sensed.

use behaviour::Value;
use serde::{Deserialize, Serialize};

/// The time when something was sensed, and the number of its reading in the run.
pub(crate) type ValueOrigin = (u64, u64);

/// A value with its origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CarriedValue {
    pub(crate) value: Value,
    pub(crate) origin: ValueOrigin,
}
