//! Why a value of a run came, and why another one did not.
//!
//! A [`Tracer`] hears the emissions of a run and keeps the way of each value that can still cause one. It stands outside the
//! engine: a run that nobody asks about pays nothing. [`Traced`] is a run with its tracer.
#![warn(missing_docs)]

mod cause;
mod cell;
mod core;
mod event;
mod frame;
mod kept;
mod traced;
mod tracer;
mod why_not;
mod wiring;

pub use cause::{Cause, STEPS_MAX};
pub use kept::KeptValue;
pub use traced::{Snapshot, Stretch, Traced};
pub use tracer::Tracer;
