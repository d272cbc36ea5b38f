//! The engine: runs a behaviour in logical time, the same way every time, and lets procedures do nothing but compute.
//!
//! No clock, thread, randomness, hash order, input or output lives here: [`Run::feed`] and [`Run::until`] are all that
//! moves a run, so the same readings give the same outputs on every machine, live or replayed.
#![warn(missing_docs)]

mod budget;
mod calls;
mod cells;
mod charged;
mod check;
mod claim;
mod closures;
mod convert;
mod core;
mod end;
mod event;
mod fields;
mod frame;
mod graph;
mod helpers;
mod holds;
mod library;
mod limits;
mod lists;
mod maths;
mod memory;
mod meter;
mod plan;
mod precedence;
mod procedure;
mod quick;
mod run;
mod sandbox;
mod stamp;
mod stats;
mod texts;
mod toll;
mod validate;
mod walk;
mod words;

pub use check::{check_body, try_body};
pub use claim::Claim;
pub use end::End;
pub use graph::{ConnectorInfo, StreamInfo, Work};
pub use limits::Limits;
pub use precedence::{HeldBy, Precedence};
pub use run::{Emission, Kept, Legacy, Run};
pub use stats::{ConnectorStats, LastFault, Stats, StreamStats};
pub use validate::{Fault, validate};
