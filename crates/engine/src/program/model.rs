//! A valid behaviour as numbers: streams and connectors by index, who hands values to whom, and in which order.

use crate::connectors::NextSteps;
use crate::values::{ConnectorIx, IndexVec, StreamIx};
use behaviour::flow::Gives;
use behaviour::walk::{self, Ends};
use behaviour::{FileStream, Params, StreamKind};

/// A stream of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamInfo {
    /// The id of the stream.
    pub id: String,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// The name of the stream.
    pub name: String,
    /// The device of the stream.
    pub device: Option<String>,
    /// The device's parameters.
    pub params: Params,
}

impl StreamInfo {
    pub(crate) fn of(stream: &FileStream) -> Self {
        Self {
            id: stream.id.clone(),
            kind: stream.kind,
            name: stream.name.clone(),
            device: stream.device.clone(),
            params: stream.params.clone().unwrap_or_default(),
        }
    }
}

/// A connector of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct ConnectorInfo {
    /// The id of the connector.
    pub id: String,
    /// The connector's word in files.
    pub word: &'static str,
    /// The input streams, in order.
    pub inputs: Vec<StreamIx>,
    /// The output stream.
    pub output: StreamIx,
    /// The number of values that it gives for those that it takes.
    pub(crate) gives: Gives,
    /// The step of event mode when one of its inputs has a value.
    pub(crate) op: NextSteps,
}

impl ConnectorInfo {
    /// Returns the input streams by their places in the file.
    pub(crate) fn input_places(&self) -> Vec<usize> {
        self.inputs.iter().map(|input| input.index()).collect()
    }
}

/// The wiring of a run.
pub(crate) struct RunGraph {
    pub(crate) streams: IndexVec<StreamIx, StreamInfo>,
    /// For every stream whether it is a sensor's.
    pub(crate) sensed: IndexVec<StreamIx, bool>,
    /// The streams in the order of their ids.
    by_id: Vec<StreamIx>,
    pub(crate) connectors: IndexVec<ConnectorIx, ConnectorInfo>,
    /// For every stream the connectors that take from it, in array order, and as which of their inputs.
    pub(crate) outgoing: IndexVec<StreamIx, Vec<(ConnectorIx, u32)>>,
    /// For every connector the length of the longest path from a source to it.
    pub(crate) ranks: IndexVec<ConnectorIx, usize>,
}

impl RunGraph {
    /// Wires valid parts together.
    ///
    /// # Errors
    /// A connector that values would reach again in a circle.
    pub(crate) fn of(streams: Vec<StreamInfo>, connectors: Vec<ConnectorInfo>) -> Result<Self, ConnectorIx> {
        let (streams, connectors) = (IndexVec::from(streams), IndexVec::from(connectors));
        let mut outgoing = IndexVec::filled(&Vec::new(), streams.len());
        for (at, connector) in connectors.enumerate() {
            for (slot, &input) in (0..).zip(&connector.inputs) {
                outgoing[input].push((at, slot));
            }
        }
        outgoing.iter_mut().for_each(Vec::shrink_to_fit);
        let ranks = ranks(streams.len(), &connectors)?;
        let mut by_id: Vec<StreamIx> = streams.indices().collect();
        by_id.sort_unstable_by_key(|&at| &streams[at].id);
        let sensed = streams.iter().map(|stream| stream.kind == StreamKind::Sensor).collect();
        Ok(Self { streams, sensed, by_id, connectors, outgoing, ranks })
    }

    /// The number of a stream by its id.
    pub(crate) fn stream(&self, id: &str) -> Option<StreamIx> {
        let at = self.by_id.binary_search_by(|&at| self.streams[at].id.as_str().cmp(id)).ok()?;
        Some(self.by_id[at])
    }
}

/// For every connector the length of the longest path to it.
///
/// # Errors
/// A connector that is in a circle.
fn ranks(
    streams: usize,
    connectors: &IndexVec<ConnectorIx, ConnectorInfo>,
) -> Result<IndexVec<ConnectorIx, usize>, ConnectorIx> {
    let inputs: Vec<Vec<usize>> = connectors.iter().map(ConnectorInfo::input_places).collect();
    let ends: Vec<Ends> =
        inputs.iter().zip(connectors).map(|(inputs, info)| (&inputs[..], info.output.index())).collect();
    if let Some(at) = walk::in_circle(streams, &ends) {
        return Err(ConnectorIx::of(at));
    }
    let ranks = walk::ranks(streams, &ends);
    let longest = |info: &ConnectorInfo| info.inputs.iter().filter_map(|input| ranks[input.index()]).max();
    Ok(connectors.iter().map(|info| longest(info).unwrap_or_default() + 1).collect())
}
