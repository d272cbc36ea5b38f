//! A valid behaviour as numbers: streams and connectors by index, who hands values to whom, and in which order.

use behaviour::{FileStream, Params, StreamKind};

/// A stream of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamInfo {
    /// Its id.
    pub id: String,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// Its name.
    pub name: String,
    /// Its device.
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

/// What a connector does with values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Passes on what its procedure makes.
    Map,
    /// Passes on what its procedure finds true.
    Filter,
    /// Pairs with the time.
    Timestamp,
    /// Passes on the newest value at each beat of that many milliseconds.
    Sample(u64),
    /// Passes on what its procedure makes of the newest values of all inputs.
    CombineLatest,
    /// Passes on every value.
    Merge,
    /// Hands every value to an actuator.
    Subscribe,
}

/// A connector of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct ConnectorInfo {
    /// Its id.
    pub id: String,
    /// What it does.
    pub work: Work,
    /// Its input streams, in order.
    pub inputs: Vec<usize>,
    /// Its output stream.
    pub output: usize,
}

/// The wiring of a run.
pub(crate) struct Graph {
    pub(crate) streams: Vec<StreamInfo>,
    /// For every stream whether it is a sensor's.
    pub(crate) sensed: Vec<bool>,
    /// The streams in the order of their ids.
    by_id: Vec<usize>,
    pub(crate) connectors: Vec<ConnectorInfo>,
    /// For every stream the connectors that take from it, in array order, and as which of their inputs.
    pub(crate) outgoing: Vec<Vec<(usize, usize)>>,
    /// For every connector the length of the longest path from a source to it.
    pub(crate) ranks: Vec<usize>,
}

impl Graph {
    /// Wires valid parts together.
    ///
    /// # Errors
    /// A connector that values would reach again in a circle.
    pub(crate) fn of(streams: Vec<StreamInfo>, connectors: Vec<ConnectorInfo>) -> Result<Self, usize> {
        let mut outgoing = vec![Vec::new(); streams.len()];
        for (at, connector) in connectors.iter().enumerate() {
            for (slot, &input) in connector.inputs.iter().enumerate() {
                outgoing[input].push((at, slot));
            }
        }
        outgoing.iter_mut().for_each(Vec::shrink_to_fit);
        let ranks = ranks(&connectors, &outgoing)?;
        let mut by_id: Vec<usize> = (0..streams.len()).collect();
        by_id.sort_by_key(|&at| &streams[at].id);
        let sensed = streams.iter().map(|stream| stream.kind == StreamKind::Sensor).collect();
        Ok(Self { streams, sensed, by_id, connectors, outgoing, ranks })
    }

    /// The index of a stream by its id.
    pub(crate) fn stream(&self, id: &str) -> Option<usize> {
        let at = self.by_id.binary_search_by(|&at| self.streams[at].id.as_str().cmp(id)).ok()?;
        Some(self.by_id[at])
    }
}

/// Ranks by taking away, again and again, what has no open input.
fn ranks(connectors: &[ConnectorInfo], outgoing: &[Vec<(usize, usize)>]) -> Result<Vec<usize>, usize> {
    let mut waiting = vec![0_usize; connectors.len()];
    for connector in connectors {
        for &(next, _) in &outgoing[connector.output] {
            waiting[next] += 1;
        }
    }
    let mut ranks = vec![1; connectors.len()];
    let mut ready: Vec<usize> = (0..connectors.len()).filter(|&at| waiting[at] == 0).collect();
    while let Some(done) = ready.pop() {
        for &(next, _) in &outgoing[connectors[done].output] {
            ranks[next] = ranks[next].max(ranks[done] + 1);
            waiting[next] -= 1;
            if waiting[next] == 0 {
                ready.push(next);
            }
        }
    }
    on_circle(connectors, &waiting).map_or(Ok(ranks), Err)
}

/// A connector on a circle: walking up from any that still waits must come back.
fn on_circle(connectors: &[ConnectorInfo], waiting: &[usize]) -> Option<usize> {
    let mut seen = vec![false; connectors.len()];
    let mut at = waiting.iter().position(|&left| left > 0)?;
    while !seen[at] {
        seen[at] = true;
        let feeds = |&other: &usize| waiting[other] > 0 && connectors[at].inputs.contains(&connectors[other].output);
        at = (0..connectors.len()).find(feeds)?;
    }
    Some(at)
}
