//! filter: passes on the values for which its procedure says exactly true.

use super::context::{Outcome, RunContext};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::procedure::compiled::CompiledComparison;
use crate::values::{CarriedValue, ConnectorIx};
use behaviour::Value;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "filter", op: NextSteps::Filter, make: |_| Box::new(Filter) };

/// Remembers nothing.
struct Filter;

impl RunConnector for Filter {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        take(cx, at, turn)
    }

    fn frame(&mut self, cx: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        let value = &frame.newest.value;
        let passes = test(cx, frame.connector, value);
        let passes = cx.counted(frame.at, frame.connector, passes, &[value])?;
        Ok(passes.then(|| frame.newest.clone()))
    }
}

/// Takes a value in event mode, compiled tests first.
#[inline(never)]
pub(super) fn take(cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
    let procedure = cx.procedure(turn.connector);
    match procedure.and_then(|procedure| procedure.truth(&[cx.stats.value(turn.input)])) {
        Some(passes) => tested(cx, at, turn, passes),
        None => take_any(cx, at, turn),
    }
}

/// Takes a value in event mode if the procedure is one comparison with a number.
#[inline(always)]
pub(super) fn compare(
    cx: &mut RunContext,
    at: Millis,
    turn: &ConnectorTurn,
    comparison: CompiledComparison,
) -> Outcome {
    let passes = comparison.holds_number(cx.stats.value(turn.input), turn.number);
    tested(cx, at, turn, passes)
}

#[inline(never)]
fn take_any(cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
    let input = cx.stats.value(turn.input).clone();
    match test(cx, turn.connector, &input) {
        Ok(passes) => tested(cx, at, turn, passes),
        Err(failed) => cx.failed(at, turn.connector, failed, &[&input]),
    }
}

#[inline(always)]
fn tested(cx: &mut RunContext, at: Millis, turn: &ConnectorTurn, passes: bool) -> Outcome {
    if passes {
        return cx.pass(at, turn);
    }
    cx.stats.connectors[turn.connector].deadlines_in_a_row = 0;
    Outcome::Kept
}

fn test(cx: &mut RunContext, connector: ConnectorIx, value: &Value) -> Result<bool, Box<CallFault>> {
    match cx.made(connector, &[value])? {
        Value::Bool(passes) => Ok(passes),
        other => Err(Box::new(CallFault::NoTruth(other))),
    }
}
