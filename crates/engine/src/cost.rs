//! What one step of a procedure costs, and how much one call or one instant may use.

pub(crate) mod callers;
pub(crate) mod limits;
pub(crate) mod meter;
pub(crate) mod metered;
pub(crate) mod nodes;
pub(crate) mod variable_cost;

pub use limits::Limits;
