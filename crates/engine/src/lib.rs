//! The engine: runs a behaviour in logical time, the same way every time, and lets procedures do nothing but compute.
//!
//! No clock, thread, randomness, hash order, input or output lives here: [`Run::feed`] and [`Run::until`] are all that
//! moves a run, so the same readings give the same outputs on every machine, live or replayed.
#![warn(missing_docs)]

mod arbitration;
mod connectors;
mod cost;
mod faults;
mod procedure;
mod program;
mod rhai;
mod run;
mod timeline;
mod values;

pub use arbitration::{Claim, HeldBy, Precedence};
pub use cost::Limits;
pub use faults::{
    BodyFault, CallFault, GraphFault, Misuse, Reason, RunFault, Syntax, TextPlace, TrialFault, ValueFault, ValueKind,
};
pub use procedure::{check_body, misused, result_type, try_body, unknown_name};
pub use program::{ConnectorInfo, Program, StreamInfo, validate};
pub use run::{Handover, Matching, Run};
pub use timeline::{Emission, End, Trigger};
pub use values::{ConnectorIx, ConnectorStats, IndexVec, Ix, LastFault, Pairs, Stats, StreamIx, StreamStats};
