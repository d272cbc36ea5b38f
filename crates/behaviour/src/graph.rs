//! A behaviour seen as a graph: what flows from where to where.

use crate::{Behaviour, Connector, Id};
use std::collections::{BTreeMap, BTreeSet};

/// The connectors around every stream, in file order.
#[derive(Debug, Default)]
pub struct Graph<'a> {
    into: BTreeMap<&'a Id, Vec<(&'a Id, &'a Connector)>>,
    out_of: BTreeMap<&'a Id, Vec<(&'a Id, &'a Connector)>>,
}

impl<'a> Graph<'a> {
    /// The graph of a behaviour.
    #[must_use]
    pub fn of(behaviour: &'a Behaviour) -> Self {
        let mut graph = Self::default();
        for (id, connector) in behaviour.connectors_in_order() {
            graph.into.entry(&connector.output).or_default().push((id, connector));
            for input in &connector.inputs {
                graph.out_of.entry(input).or_default().push((id, connector));
            }
        }
        graph
    }

    /// Connectors that give to this stream.
    #[must_use]
    pub fn into_stream(&self, stream: &Id) -> &[(&'a Id, &'a Connector)] {
        self.into.get(stream).map_or(&[], Vec::as_slice)
    }

    /// Connectors that take from this stream.
    #[must_use]
    pub fn out_of_stream(&self, stream: &Id) -> &[(&'a Id, &'a Connector)] {
        self.out_of.get(stream).map_or(&[], Vec::as_slice)
    }

    /// All streams that values of `stream` can reach, without itself unless there is a cycle.
    #[must_use]
    pub fn below(&self, stream: &Id) -> BTreeSet<&'a Id> {
        let mut reached = BTreeSet::new();
        let mut open: Vec<&'a Id> = self.out_of_stream(stream).iter().map(|(_, connector)| &connector.output).collect();
        while let Some(next) = open.pop() {
            if reached.insert(next) {
                open.extend(self.out_of_stream(next).iter().map(|(_, connector)| &connector.output));
            }
        }
        reached
    }

    /// A stream that flows back into itself, if there is one.
    #[must_use]
    pub fn cycle(&self) -> Option<&'a Id> {
        let mut missing: BTreeMap<&'a Id, usize> = BTreeMap::new();
        for (output, connectors) in &self.into {
            missing.insert(output, connectors.iter().map(|(_, connector)| connector.inputs.len()).sum());
        }
        let mut ready: Vec<&'a Id> = self.out_of.keys().filter(|id| !missing.contains_key(*id)).copied().collect();
        while let Some(stream) = ready.pop() {
            for (_, connector) in self.out_of_stream(stream) {
                let left = missing.entry(&connector.output).or_default();
                *left = left.saturating_sub(1);
                if *left == 0 {
                    ready.push(&connector.output);
                }
            }
        }
        missing
            .into_iter()
            .find(|(output, left)| *left > 0 && self.below(output).contains(output))
            .map(|(output, _)| output)
    }
}
