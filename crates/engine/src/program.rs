//! A program to run: a behaviour read once, as numbers, checked and with its procedures compiled.

mod model;
mod operation;
mod reserved;
mod validity;

use crate::connectors::RunConnector;
use crate::cost::Limits;
use crate::procedure::ConnectorProcedure;
use crate::values::{ConnectorIx, IndexVec};
use behaviour::Engine;

pub(crate) use model::RunGraph;
pub use model::{ConnectorInfo, StreamInfo};
pub use validity::validate;

/// A behaviour that can run.
pub struct Program {
    pub(crate) graph: RunGraph,
    /// The way in which time runs.
    pub(crate) mode: Engine,
    pub(crate) engine: rhai::Engine,
    pub(crate) procedures: IndexVec<ConnectorIx, Option<ConnectorProcedure>>,
    pub(crate) connectors: IndexVec<ConnectorIx, Box<dyn RunConnector>>,
    pub(crate) limits: Limits,
}
