//! Logical time: instants and frames, and how values are carried through them.

pub(crate) mod budget;
pub(crate) mod core;
pub(crate) mod end;
pub(crate) mod event;
pub(crate) mod frame;
pub(crate) mod memory;
pub(crate) mod plan;
pub(crate) mod stamp;

use behaviour::Value;
use robot::Millis;

pub use end::End;

/// What a run tells its caller, in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emission<'a> {
    /// A value on a stream.
    Value {
        /// When, in logical time.
        at: Millis,
        /// The index of the stream.
        stream: usize,
        /// The value.
        value: &'a Value,
    },
    /// A procedure dropped a value.
    Fault {
        /// When, in logical time.
        at: Millis,
        /// The index of the connector.
        connector: usize,
        /// In plain words.
        error: &'a str,
        /// True if the caller's interrupt ended the procedure.
        deadline: bool,
    },
}
