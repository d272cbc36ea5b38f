//! The steps of event mode: most connectors take the value themselves, the way of numbers is inlined.

use super::context::{Outcome, RunContext};
use super::turn::{ConnectorTurn, NextSteps};
use super::{RunConnector, filter, map};
use crate::procedure::ConnectorProcedure;
use crate::procedure::compiled::Short;
use crate::values::in_place::ComputedNumber;
use crate::values::{ConnectorIx, IndexVec};
use robot::Millis;

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
