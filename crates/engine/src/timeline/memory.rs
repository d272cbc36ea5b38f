//! The memory of a run from one instant to the next, in a form that both modes give and take.

use crate::connectors::ConnectorMemory;
use crate::values::{CarriedValue, ConnectorIx, Ix, Pairs, StreamIx};
use behaviour::Value;
use serde::{Deserialize, Serialize};

/// The memory of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct RunMemory {
    /// The first instant that is not closed.
    pub(crate) open: u64,
    /// The number of readings so far.
    pub(crate) readings: u64,
    /// The memory of each connector.
    pub(crate) connectors: Vec<(ConnectorIx, ConnectorMemory)>,
    /// Readings of a frame that did not run yet, by stream.
    pub(crate) waiting: Vec<(StreamIx, CarriedValue)>,
}

impl RunMemory {
    /// All values in it.
    pub(crate) fn values(&self) -> impl Iterator<Item = &Value> {
        let connectors = self.connectors.iter().flat_map(|(_, memory)| {
            memory.known.iter().flatten().chain(memory.waiting.iter().map(|waiting| &waiting.carried.value))
        });
        connectors.chain(self.waiting.iter().map(|(_, waiting)| &waiting.value))
    }

    /// Renumbers it for the graph that follows; what has no place there is forgotten.
    pub(crate) fn moved(self, streams: &Pairs<StreamIx>, connectors: &Pairs<ConnectorIx>) -> Self {
        Self { connectors: moved(self.connectors, connectors), waiting: moved(self.waiting, streams), ..self }
    }
}

fn moved<I: Ix, T>(of: Vec<(I, T)>, to: &Pairs<I>) -> Vec<(I, T)> {
    of.into_iter().filter_map(|(at, thing)| Some((to.get(at)?, thing))).collect()
}
