//! Gestures on a graph as pure functions: what is added, led elsewhere, grouped, lined up, copied and walked through. Each
//! makes one change of the behaviour as it is.

mod connecting;
mod ghost;
#[cfg(test)]
mod graph_tests;
pub mod grouping;
mod insert;
mod part;
mod plan;
pub mod rewire;
mod several;
mod walk;

pub use connecting::{connected, connected_twice, sensor};
pub use ghost::{Ghost, GhostConnector, GhostStream};
pub use part::ProgramPart;
pub use plan::{ConnectPlan, Gap, NewSpot, Output};
pub use rewire::{Joining, WireEnd, wire_ends};
pub use several::{LineUp, lined_up, without};
pub use walk::{StepDirection, walk};
