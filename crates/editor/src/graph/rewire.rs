//! Other ways through a graph that is there, each as one change: another input, a stream fed again, a connector put into
//! an edge, a stream taken out of its way. Pure.

use super::connecting::connected;
use super::insert::{lowered, ordinary, with_inputs};
use super::plan::{ConnectPlan, NewSpot, Output};
use crate::Selected;
use crate::build::free_name;
use crate::layout::{Ground, LEVEL};
use behaviour::{Behaviour, Change, Connector, Graph, Id, Kind, Record, RecordId, Stream, StreamKind, connectors};
use std::collections::BTreeSet;

/// The things at which a wire out of a stream may end.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WireEnd {
    /// A stream: an action takes its values too, an ordinary stream is fed by it.
    Stream(Id),
    /// A connector: it takes from it as well, or instead.
    Connector(Id),
}

impl WireEnd {
    /// Returns the id of the end.
    pub fn id(&self) -> &Id {
        match self {
            Self::Stream(id) | Self::Connector(id) => id,
        }
    }

    /// Returns the end as something that can be selected on the graph.
    pub fn selected(&self) -> Selected {
        match self {
            Self::Stream(id) => Selected::Stream(id.clone()),
            Self::Connector(id) => Selected::Connector(id.clone()),
        }
    }
}

/// The outcome of a wire that ends there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joining {
    /// The action is told these values too.
    Acts,
    /// The stream that nothing flows into carries them.
    Feeds,
    /// The stream carries them beside what it carries already.
    Merges,
    /// The connector takes them as one more input.
    Adds,
    /// The connector takes them in place of its only input.
    Replaces,
}

/// Returns the ends that a wire out of `from` may have, and what comes of each, in the order of the file: streams, then
/// connectors.
pub fn wire_ends(behaviour: &Behaviour, from: &Id) -> Vec<(WireEnd, Joining)> {
    if behaviour.stream(from).is_none_or(|stream| stream.kind == StreamKind::Actuator) {
        return Vec::new();
    }
    let graph = Graph::of(behaviour);
    let above = above(&graph, from);
    let streams = behaviour.streams_in_order().into_iter().filter_map(|(id, stream)| {
        let joining = stream_end(&graph, &above, from, (id, stream))?;
        Some((WireEnd::Stream(id.clone()), joining))
    });
    let connectors = behaviour.connectors_in_order().into_iter().filter_map(|(id, connector)| {
        let open = !connector.inputs.contains(from) && !above.contains(&connector.output);
        let spec = connector.operation.spec();
        let joining = if spec.inputs.are_many() { Joining::Adds } else { Joining::Replaces };
        open.then(|| (WireEnd::Connector(id.clone()), joining))
    });
    streams.chain(connectors).collect()
}

fn stream_end(graph: &Graph, above: &BTreeSet<Id>, from: &Id, (id, stream): (&Id, &Stream)) -> Option<Joining> {
    let into = graph.into_stream(id);
    match stream.kind {
        StreamKind::Sensor => None,
        StreamKind::Actuator => {
            let is_there = into.iter().any(|(_, connector)| connector.inputs.contains(from));
            (!is_there).then_some(Joining::Acts)
        }
        StreamKind::Ordinary if above.contains(id) => None,
        StreamKind::Ordinary if into.is_empty() => Some(Joining::Feeds),
        StreamKind::Ordinary => {
            let merges = |connector: &Connector| connector.operation.spec() == connectors::to_join();
            let is_there = into.iter().any(|(_, connector)| merges(connector) && connector.inputs.contains(from));
            (!is_there).then_some(Joining::Merges)
        }
    }
}

/// A stream and everything that leads to it.
fn above(graph: &Graph, of: &Id) -> BTreeSet<Id> {
    let mut found = BTreeSet::new();
    found.insert(of.clone());
    let mut next = vec![of.clone()];
    while let Some(at) = next.pop() {
        let inputs = graph.into_stream(&at).iter().flat_map(|(_, connector)| &connector.inputs);
        next.extend(inputs.filter(|input| found.insert((*input).clone())).cloned());
    }
    found
}

/// Leads a stream to where its wire ends. `ids` are of a new stream and a new connector, if there are any.
pub fn wired(ground: Ground, change: Change, ids: (&Id, &Id), (from, end): (&Id, &WireEnd)) -> Change {
    let behaviour = ground.behaviour;
    let joining = wire_ends(behaviour, from).into_iter().find(|(known, _)| known == end).map(|(_, joining)| joining);
    let to_existing = |operation, to: &Id| {
        let plan = ConnectPlan {
            operation,
            inputs: vec![from.clone()],
            output: Output::Existing(to.clone()),
            spot: NewSpot::Below,
        };
        connected(ground, change.clone(), ids, plan)
    };
    match (end, joining) {
        (_, None) => change,
        (WireEnd::Stream(to), Some(Joining::Acts)) => to_existing(connectors::to_action().with(()), to),
        (WireEnd::Stream(to), Some(Joining::Merges)) => merged(ground, change, ids, (from, to)),
        (WireEnd::Stream(to), Some(_)) => to_existing(connectors::to_join().with(()), to),
        (WireEnd::Connector(to), Some(joining)) => {
            let Some(connector) = behaviour.connector(to) else { return change };
            let mut inputs = connector.inputs.clone();
            if joining == Joining::Replaces {
                inputs.clear();
            }
            inputs.push(from.clone());
            let taken = with_inputs(behaviour, connector, inputs);
            change.put(behaviour, key(Kind::Connector, to), Record::Connector(taken))
        }
    }
}

/// Puts what a stream carries already, and the new values, both on it: into the merge that feeds it, or into a new one
/// behind the connector that feeds it.
fn merged(ground: Ground, change: Change, (stream_id, connector_id): (&Id, &Id), (from, to): (&Id, &Id)) -> Change {
    let Ground { behaviour, places, .. } = ground;
    let graph = Graph::of(behaviour);
    let Some((feeding_id, feeding)) = graph.into_stream(to).first() else { return change };
    if feeding.operation.spec() == connectors::to_join() {
        let inputs = feeding.inputs.iter().chain([from]).cloned().collect();
        let taken = Connector { inputs, ..(*feeding).clone() };
        return change.put(behaviour, key(Kind::Connector, feeding_id), Record::Connector(taken));
    }
    let order = behaviour.next_order();
    let name = behaviour.stream(to).map_or("", |stream| &stream.name);
    let between = ordinary(&free_name(behaviour, name), order);
    let turned = Connector { output: stream_id.clone(), ..(*feeding).clone() };
    let merge = Connector {
        operation: connectors::to_join().with(()),
        inputs: vec![stream_id.clone(), from.clone()],
        output: to.clone(),
        order: order + 1,
    };
    let change = change
        .put(behaviour, key(Kind::Stream, stream_id), Record::Stream(between))
        .put(behaviour, key(Kind::Connector, feeding_id), Record::Connector(turned))
        .put(behaviour, key(Kind::Connector, connector_id), Record::Connector(merge));
    let Some(place) = places.get(to) else { return change };
    let change = change.put(behaviour, key(Kind::Place, stream_id), Record::Place(*place));
    lowered(ground, change, to, LEVEL)
}

/// The stream that takes the place of a removed one, if its way can be healed: it has one connector above it, which takes
/// from one stream, and some below.
pub fn healed_by<'a>(behaviour: &'a Behaviour, id: &Id) -> Option<&'a Id> {
    let graph = Graph::of(behaviour);
    let [(_, above)] = graph.into_stream(id) else { return None };
    let [input] = above.inputs.as_slice() else { return None };
    let is_middle = behaviour.stream(id).is_some_and(|stream| stream.kind == StreamKind::Ordinary);
    (is_middle && !graph.out_of_stream(id).is_empty()).then_some(input)
}

/// Without a stream and the connector that makes it: what took from it takes from the stream above.
pub fn healed(behaviour: &Behaviour, change: Change, id: &Id) -> Change {
    let Some(input) = healed_by(behaviour, id) else { return change };
    let graph = Graph::of(behaviour);
    let change = graph.out_of_stream(id).iter().fold(change, |change, (below, connector)| {
        let mut inputs: Vec<Id> = Vec::new();
        for one in &connector.inputs {
            let one = if one == id { input } else { one };
            if !inputs.contains(one) {
                inputs.push(one.clone());
            }
        }
        let turned = with_inputs(behaviour, connector, inputs);
        change.put(behaviour, key(Kind::Connector, below), Record::Connector(turned))
    });
    let change = graph.into_stream(id).iter().fold(change, |change, (above, _)| {
        change.take(behaviour, key(Kind::Connector, above)).take(behaviour, key(Kind::Place, above))
    });
    change.take(behaviour, key(Kind::Stream, id)).take(behaviour, key(Kind::Place, id))
}

fn key(kind: Kind, id: &Id) -> RecordId {
    RecordId::new(kind, id)
}

#[cfg(test)]
#[path = "rewire_tests.rs"]
mod tests;
