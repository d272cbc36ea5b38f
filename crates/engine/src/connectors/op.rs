//! The steps of event mode: most connectors take the value themselves, the way of numbers is inlined.

use super::context::{Outcome, RunContext};
use super::{RunConnector, filter, map};
use crate::procedure::ConnectorProcedure;
use crate::procedure::compiled::{CompiledComparison, Operator, Short};
use crate::values::in_place::ComputedNumber;
use crate::values::{ConnectorIx, IndexVec, StreamIx};
use robot::Millis;

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

impl NextSteps {
    /// The shorter way, if the procedure is one operation with a number.
    pub(crate) fn shortened(self, procedure: &ConnectorProcedure) -> Option<(Self, ComputedNumber)> {
        match (self, procedure.short()?) {
            (Self::Map, Short::Compute(operator, number)) => Some((Self::Compute(operator), number)),
            (Self::Filter, Short::Compare(comparison, number)) => Some((Self::Compare(comparison), number)),
            _ => None,
        }
    }

    /// Lets a connector take the last value of one of its inputs.
    #[inline(always)]
    pub(crate) fn perform(
        self,
        connectors: &mut IndexVec<ConnectorIx, Box<dyn RunConnector>>,
        cx: &mut RunContext,
        at: Millis,
        turn: &ConnectorTurn,
    ) -> Outcome {
        match self {
            Self::Compute(operator) => map::compute(cx, at, turn, operator),
            Self::Map => map::take(cx, at, turn),
            Self::Compare(comparison) => filter::compare(cx, at, turn, comparison),
            Self::Filter => filter::take(cx, at, turn),
            Self::Pass => cx.pass(at, turn),
            Self::Take => connectors[turn.connector].take(cx, at, turn),
            Self::End => Outcome::Kept,
        }
    }
}
