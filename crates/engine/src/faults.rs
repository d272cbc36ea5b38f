//! The reasons why a behaviour is refused, and the faults while it runs: as data, and in words for people.

mod body;
mod call;
mod graph;
mod kind;
mod place;
mod plain;
mod syntax;
mod trial;
mod words;

pub use body::{BodyFault, Misuse};
pub use call::{CallFault, ValueFault};
pub use graph::{GraphFault, Reason, RunFault};
pub use kind::ValueKind;
pub use place::TextPlace;
pub use syntax::Syntax;
pub use trial::TrialFault;
