//! A program as its tracer sees it: what each connector means, what it takes from, and what takes from each stream.

use behaviour::connectors::ConnectorMeaning;
use behaviour::{BehaviourFile, Lookup, Value};
use engine::{ConnectorIx, StreamIx};
use std::sync::Arc;

/// The wiring of a program.
#[derive(Debug)]
pub(crate) struct Wiring {
    /// By connector.
    pub(crate) parts: Vec<WiredConnector>,
    /// For every stream the connectors that take from it, in array order, and as which of their inputs.
    pub(crate) outgoing: Vec<Vec<(ConnectorIx, u32)>>,
    /// For every stream the connectors that give to it, in array order.
    pub(crate) incoming: Vec<Vec<ConnectorIx>>,
}

/// A connector.
#[derive(Debug)]
pub(crate) struct WiredConnector {
    pub(crate) meaning: ConnectorMeaning,
    pub(crate) inputs: Vec<StreamIx>,
    /// The time for which it lets values wait, in milliseconds.
    pub(crate) period_ms: u64,
    /// The value that it remembers at first.
    pub(crate) start: Value,
}

/// The ids of a program's streams and connectors.
#[derive(Clone, Debug)]
pub(crate) struct Ids {
    pub(crate) streams: Arc<[String]>,
    pub(crate) connectors: Arc<[String]>,
}

impl Wiring {
    /// Returns the wiring of a program that runs. A connector that cannot be read takes and gives nothing.
    pub(crate) fn of(file: &BehaviourFile) -> Self {
        let places: Lookup<&str, usize> =
            file.streams.iter().enumerate().map(|(at, stream)| (stream.id.as_str(), at)).collect();
        let stream = |id: &String| places.get(id.as_str()).map(|at| StreamIx::of(*at));
        let mut wiring = Self {
            parts: Vec::new(),
            outgoing: vec![Vec::new(); file.streams.len()],
            incoming: vec![Vec::new(); file.streams.len()],
        };
        for (at, connector) in file.connectors.iter().enumerate() {
            let operation = connector.operation().ok();
            let inputs: Vec<StreamIx> = connector.inputs.iter().filter_map(stream).collect();
            let at = ConnectorIx::of(at);
            for (slot, input) in (0..).zip(&inputs) {
                wiring.outgoing[input.index()].push((at, slot));
            }
            if let Some(output) = stream(&connector.output) {
                wiring.incoming[output.index()].push(at);
            }
            let operation = operation.as_ref();
            wiring.parts.push(WiredConnector {
                meaning: operation.map_or(ConnectorMeaning::PassesOn, |operation| operation.spec().meaning),
                inputs,
                period_ms: operation.and_then(|operation| operation.period_ms()).unwrap_or_default(),
                start: operation.and_then(|operation| operation.start().cloned()).unwrap_or_default(),
            });
        }
        wiring
    }
}

impl WiredConnector {
    /// True if it gives by itself, later, what it took.
    pub(crate) fn gives_later(&self) -> bool {
        match self.meaning {
            ConnectorMeaning::Every | ConnectorMeaning::Later | ConnectorMeaning::Settles => true,
            ConnectorMeaning::Makes
            | ConnectorMeaning::Keeps
            | ConnectorMeaning::Stamps
            | ConnectorMeaning::Changes
            | ConnectorMeaning::Remembers
            | ConnectorMeaning::PassesOn
            | ConnectorMeaning::Together
            | ConnectorMeaning::Latest => false,
        }
    }

    /// True if it knows the newest value of each input.
    pub(crate) fn knows_inputs(&self) -> bool {
        matches!(self.meaning, ConnectorMeaning::Together | ConnectorMeaning::Latest)
    }
}

impl Ids {
    /// Those of a program.
    pub(crate) fn of(file: &BehaviourFile) -> Self {
        Self {
            streams: file.streams.iter().map(|stream| stream.id.clone()).collect(),
            connectors: file.connectors.iter().map(|connector| connector.id.clone()).collect(),
        }
    }
}
