//! subscribe: hands every value to an actuator.

use super::context::{Context, Outcome};
use super::op::{Op, Turn};
use super::{Connector, Frame, Kind};
use crate::faults::CallFault;
use crate::values::Carried;
use robot::Millis;

pub(super) const KIND: Kind = Kind { word: "subscribe", op: Op::Pass, make: |_| Box::new(Subscribe) };

/// Remembers nothing.
struct Subscribe;

impl Connector for Subscribe {
    fn take(&mut self, cx: &mut Context, at: Millis, turn: &Turn) -> Outcome {
        cx.pass(at, turn)
    }

    fn frame(&mut self, _: &mut Context, frame: &Frame) -> Result<Option<Carried>, Box<CallFault>> {
        Ok(Some(frame.newest.clone()))
    }
}
