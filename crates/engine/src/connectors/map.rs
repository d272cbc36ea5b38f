//! map: passes on what its procedure makes of each value.

use super::context::{Outcome, RunContext};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::procedure::compiled::Operator;
use crate::values::CarriedValue;
use crate::values::in_place::ComputedNumber;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "map", op: NextSteps::Map, make: |_| Box::new(MapConnector) };

/// Remembers nothing.
struct MapConnector;

impl RunConnector for MapConnector {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        take(cx, at, turn)
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        let CarriedValue { value, origin } = frame.newest;
        let value = cx.call(frame.at, frame.connector, &[value])?;
        Ok(Some(CarriedValue { value, origin: *origin }))
    }
}

/// Takes a value in event mode, numbers first.
#[inline(never)]
pub(super) fn take(cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
    let procedure = cx.procedure(turn.connector);
    match procedure.and_then(|procedure| procedure.number(&[cx.stats.value(turn.input)])) {
        Some(made) => cx.give_number(at, turn, made),
        None => cx.give_made(at, turn),
    }
}

/// Takes a value in event mode if the procedure is one operation with a number.
#[inline(always)]
pub(super) fn compute(cx: &mut RunContext, at: Millis, turn: &ConnectorTurn, operator: Operator) -> Outcome {
    let input = ComputedNumber::of(cx.stats.value(turn.input));
    match input.and_then(|input| operator.apply(input, turn.number)) {
        Ok(made) if made.is_finite() => cx.give_number(at, turn, made),
        _ => cx.give_made(at, turn),
    }
}
