//! subscribe: hands every value to an actuator.

use super::context::{Outcome, RunContext};
use super::turn::{ConnectorTurn, NextSteps};
use super::{ConnectorKind, FrameTurn, RunConnector};
use crate::faults::CallFault;
use crate::values::CarriedValue;
use robot::Millis;

pub(super) const KIND: ConnectorKind =
    ConnectorKind { word: "subscribe", op: NextSteps::Pass, make: |_| Box::new(Subscribe) };

/// Remembers nothing.
struct Subscribe;

impl RunConnector for Subscribe {
    fn take(&mut self, cx: &mut RunContext, at: Millis, turn: &ConnectorTurn) -> Outcome {
        cx.pass(at, turn)
    }

    fn frame(&mut self, _: &mut RunContext, frame: &FrameTurn) -> Result<Option<CarriedValue>, Box<CallFault>> {
        Ok(Some(frame.newest.clone()))
    }
}
