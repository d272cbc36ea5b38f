//! The cost of one step of a procedure, and the bounds of one call or one instant.

pub(crate) mod callers;
pub(crate) mod limits;
pub(crate) mod meter;
pub(crate) mod metered;
pub(crate) mod nodes;
pub(crate) mod variable_cost;

pub use limits::Limits;
