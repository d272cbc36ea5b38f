//! merge: passes on every value of all inputs.

use super::context::{Context, Outcome};
use super::op::{Op, Turn};
use super::{Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "merge", op: Op::Pass, make: |_| Box::new(Merge) };

/// Remembers nothing.
struct Merge;

impl Connector for Merge {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        cx.pass(at, turn)
    }

    fn frame(&mut self, _: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        Ok(Some(frame.newest.clone()))
    }
}
