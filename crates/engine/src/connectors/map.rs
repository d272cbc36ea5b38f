//! map: passes on what its procedure makes of each value.

use super::context::{Context, Outcome};
use super::op::{Op, Turn};
use super::{Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::procedure::compiled::Operator;
use crate::values::Carried;
use crate::values::in_place::Number;
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "map", op: Op::Map, make: |_| Box::new(Map) };

/// Remembers nothing.
struct Map;

impl Connector for Map {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        take(cx, at, turn)
    }

    fn frame(&mut self, cx: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        let Carried { value, origin } = frame.newest;
        let value = cx.call(frame.at, frame.connector, &[value])?;
        Ok(Some(Carried { value, origin: *origin }))
    }
}

/// Takes a value in event mode, numbers first.
#[inline(never)]
pub(super) fn take(cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
    let procedure = cx.procedure(turn.connector);
    match procedure.and_then(|procedure| procedure.number(&[cx.stats.value(turn.input)])) {
        Some(made) => cx.give_number(at, turn, made),
        None => cx.give_made(at, turn),
    }
}

/// Takes a value in event mode if the procedure is one operation with a number.
#[inline(always)]
pub(super) fn compute(cx: &mut Context, at: Millis, turn: &Turn, operator: Operator) -> Outcome {
    let input = Number::of(cx.stats.value(turn.input));
    match input.and_then(|input| operator.apply(input, turn.number)) {
        Ok(made) if made.is_finite() => cx.give_number(at, turn, made),
        _ => cx.give_made(at, turn),
    }
}
