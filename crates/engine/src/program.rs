//! What runs: a behaviour as numbers, checked and with its procedures compiled.

pub(crate) mod model;
pub(crate) mod validity;

pub use model::{ConnectorInfo, StreamInfo, Work};
pub use validity::validate;
