//! The reasons why a run goes no further, and at which stream.

use crate::program::{ConnectorInfo, RunGraph};
use crate::values::StreamIx;
use behaviour::flow::{Flow, FlowConnector};
use robot::Millis;

/// The reasons why a run ended by itself: from then on it takes nothing and gives nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The caller stopped it while values were on their way; what the last call gave is not all it would have given.
    Stopped,
    /// One reading, or one tick, became more values than an instant may carry.
    Multiplied {
        /// The logical time.
        at: Millis,
        /// The stream at which values multiply.
        stream: StreamIx,
    },
}

/// The stream at which values that began on `start` become too many.
pub(crate) fn multiplying(graph: &RunGraph, start: StreamIx, handed_max: u64) -> StreamIx {
    let inputs: Vec<Vec<usize>> = graph.connectors.iter().map(ConnectorInfo::input_places).collect();
    let ends = inputs.iter().zip(&graph.connectors);
    let links: Vec<FlowConnector> =
        ends.map(|(inputs, info)| FlowConnector { inputs, output: info.output.index(), gives: info.gives }).collect();
    let at = Flow::of(graph.streams.len(), &links).multiplies_at(start.index(), false, handed_max);
    at.map_or(start, StreamIx::of)
}
