//! One connector's turn to take a value, and what can follow it.

use crate::procedure::compiled::{CompiledComparison, Operator};
use crate::values::in_place::ComputedNumber;
use crate::values::{ConnectorIx, StreamIx};

/// The steps that can follow the last value of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NextSteps {
    /// Lets the connector take it.
    Take,
    /// Passes it on.
    Pass,
    /// Hands it to a map.
    Map,
    /// Hands it to a map that is one operation with the number of the turn.
    Compute(Operator),
    /// Hands it to a filter.
    Filter,
    /// Hands it to a filter that is one comparison with the number of the turn.
    Compare(CompiledComparison),
    /// Nothing: no connector is left in this row.
    End,
}

/// One connector's turn to take a value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConnectorTurn {
    pub(crate) connector: ConnectorIx,
    /// The place of its input among the inputs of the connector.
    pub(crate) slot: u32,
    pub(crate) input: StreamIx,
    pub(crate) output: StreamIx,
    /// The number that a procedure of one operation has.
    pub(crate) number: ComputedNumber,
}
