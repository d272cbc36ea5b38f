//! The trigger of an emission: which connector gave a value, and for which of its inputs.

use crate::connectors::ConnectorTurn;
use crate::values::ConnectorIx;

/// The turn of a connector that gave a value. It is one address, which is at hand where the value is told.
#[derive(Clone, Copy, Debug)]
pub struct Trigger<'a>(pub(super) &'a ConnectorTurn);

impl Trigger<'_> {
    /// Returns the connector.
    #[must_use]
    pub fn connector(self) -> ConnectorIx {
        self.0.connector
    }

    /// Returns the place, among the inputs of the connector, of the stream whose value it took for that.
    #[must_use]
    pub fn slot(self) -> u32 {
        self.0.slot
    }
}

impl PartialEq for Trigger<'_> {
    fn eq(&self, other: &Self) -> bool {
        (self.connector(), self.slot()) == (other.connector(), other.slot())
    }
}
