//! Logical time: instants and frames, and how values are carried through them.

mod budget;
mod core;
mod end;
mod event;
mod frame;
mod memory;
mod plan;
mod schedule;
mod trigger;

use crate::faults::CallFault;
use crate::values::{ConnectorIx, StreamIx};
use behaviour::Value;
use robot::Millis;

pub(crate) use self::core::Core;
pub use end::End;
pub(crate) use event::EventTime;
pub(crate) use frame::FrameTime;
pub(crate) use memory::RunMemory;
pub use trigger::Trigger;

/// The events that a run tells its caller, in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emission<'a> {
    /// A value on a stream.
    Value {
        /// The logical time.
        at: Millis,
        /// The stream.
        stream: StreamIx,
        /// The value.
        value: &'a Value,
        /// The turn that gave it; none of a reading. What a connector gives by itself is by the input whose value waited.
        by: Option<Trigger<'a>>,
    },
    /// A procedure dropped a value.
    Fault {
        /// The logical time.
        at: Millis,
        /// The connector.
        connector: ConnectorIx,
        /// The place among its inputs of the stream whose value it took for that.
        slot: u32,
        /// The fault of the call.
        error: &'a CallFault,
        /// True if the caller's interrupt ended the procedure.
        deadline: bool,
    },
}
