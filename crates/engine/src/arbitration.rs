//! The precedence of streams over parts of the robot: what a stream claims, and who keeps it.

mod claim;
mod holds;
mod precedence;

pub use claim::Claim;
pub use precedence::{HeldBy, Precedence};
