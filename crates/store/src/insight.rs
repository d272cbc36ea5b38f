//! The knowledge in a library of graphs: who drives an action and from what, who shares it, what is alike.

use behaviour::{Behaviour, Graph, Id, StreamKind};
use std::collections::BTreeSet;

/// The names of the sensor streams that lead to an action; none if the behaviour does not drive it.
pub(crate) fn sensors_of(behaviour: &Behaviour, actuator: &str) -> Option<Vec<String>> {
    let driven = |kind, device: Option<&str>| kind == StreamKind::Actuator && device == Some(actuator);
    let streams = behaviour.streams().filter(|(_, stream)| driven(stream.kind, stream.device.as_deref()));
    let mut open: Vec<&Id> = streams.map(|(id, _)| id).collect();
    if open.is_empty() {
        return None;
    }
    let (graph, mut seen) = (Graph::of(behaviour), BTreeSet::new());
    while let Some(stream) = open.pop() {
        if seen.insert(stream) {
            open.extend(graph.into_stream(stream).iter().flat_map(|(_, connector)| &connector.inputs));
        }
    }
    let streams = seen.into_iter().filter_map(|id| behaviour.stream(id));
    let sensors = streams.filter(|stream| stream.kind == StreamKind::Sensor).map(|stream| stream.name.clone());
    Some(sensors.collect::<BTreeSet<_>>().into_iter().collect())
}

/// Every sense and action that a behaviour uses.
pub(crate) fn devices_of(behaviour: &Behaviour) -> BTreeSet<(StreamKind, &str)> {
    behaviour.streams().filter_map(|(_, stream)| Some((stream.kind, stream.device.as_deref()?))).collect()
}
