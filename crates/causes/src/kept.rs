//! A value that a test kept back.

use crate::cause::SeenValue;
use behaviour::Value;
use engine::{ConnectorIx, StreamIx};
use robot::Millis;

/// A value that a test kept back.
#[derive(Clone, Debug)]
pub struct KeptValue {
    pub(crate) connector: ConnectorIx,
    pub(crate) seen: SeenValue,
}

impl KeptValue {
    /// Returns the connector that kept it back, by its place in the program that ran then.
    #[must_use]
    pub fn connector(&self) -> ConnectorIx {
        self.connector
    }

    /// Returns the stream on which it came, by its place in that program.
    #[must_use]
    pub fn stream(&self) -> StreamIx {
        self.seen.stream
    }

    /// Returns the logical time at which it came.
    #[must_use]
    pub fn at(&self) -> Millis {
        self.seen.at
    }

    /// Returns the value.
    #[must_use]
    pub fn value(&self) -> &Value {
        &self.seen.value
    }
}
