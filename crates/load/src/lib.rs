//! Many people at once, over real sockets: what they wait for, and whether all of them see the same in the end.
//!
//! [`run`] lets so many clients edit so fast, some of which never read or whose links end without a word, and compares
//! byte by byte what each of them has with what the server gives to who comes anew. [`chaos::Proxy`] stands between and
//! does to links what networks do.
#![warn(missing_docs)]

mod behaviours;
pub mod chaos;
mod compare;
mod dice;
mod editor;
mod patience;
mod plan;
mod report;
mod run;
mod stalled;
mod times;
mod watch;

pub use compare::{ExpectedBehaviours, Wrong, compare};
pub use dice::Dice;
pub use patience::patiently;
pub use plan::LoadPlan;
pub use report::Report;
pub use run::{Load, run, tidy};
pub use times::Durations;
pub use watch::Watch;
