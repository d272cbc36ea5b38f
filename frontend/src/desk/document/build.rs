//! From gestures to changes, as pure functions of the behaviour as it is.

use super::{ConnectPlan, Gap, NewSpot, Output, rewire};
use crate::layout;
use behaviour::{Behaviour, Change, Connector, Id, Kind, Params, Place, Record, RecordId, Stream, StreamKind};
pub(in crate::desk) use editor::build::{as_seen, helper_gone, helper_put};
pub(super) use editor::build::{
    as_seen_at, connector_edited, free_name, moved, renamed, stream_edited, without_connector, without_stream,
};
use std::collections::BTreeMap;

fn new_stream(kind: StreamKind, name: &str, device: Option<String>, params: Params, order: i64) -> Stream {
    Stream { kind, name: name.trim().to_owned(), device, params, order, resources: None, priority: None, hold_ms: None }
}

fn key(kind: Kind, id: &Id) -> RecordId {
    RecordId::new(kind, id)
}

/// A new sensor stream, in the top row unless it has a place.
pub(super) fn sensor(
    behaviour: &Behaviour,
    places: &BTreeMap<Id, Place>,
    change: Change,
    (id, device, name, params): (&Id, &str, &str, Params),
    at: Option<Place>,
) -> Change {
    let name = free_name(behaviour, name);
    let stream = new_stream(StreamKind::Sensor, &name, Some(device.to_owned()), params, behaviour.next_order());
    let place = at.map_or_else(|| layout::free_sensor_spot(behaviour, places, &stream), layout::snapped);
    change.put(behaviour, key(Kind::Place, id), Record::Place(place)).put(
        behaviour,
        key(Kind::Stream, id),
        Record::Stream(stream),
    )
}

/// A new connector and, if it leads to a new stream, that stream under its sources.
pub(super) fn connected(
    behaviour: &Behaviour,
    places: &BTreeMap<Id, Place>,
    change: Change,
    (stream_id, connector_id): (&Id, &Id),
    plan: ConnectPlan,
) -> Change {
    if let NewSpot::Into(gap) = plan.spot.clone() {
        return rewire::inserted(behaviour, places, change, (stream_id, connector_id), (&gap, plan));
    }
    let order = behaviour.next_order();
    match plan.output {
        Output::Existing(output) => {
            let connector = Connector { operation: plan.operation, inputs: plan.inputs, output, order };
            change.put(behaviour, key(Kind::Connector, connector_id), Record::Connector(connector))
        }
        Output::New { name, device, params } => {
            let kind = if device.is_some() { StreamKind::Actuator } else { StreamKind::Ordinary };
            let stream = new_stream(kind, &name, device, params, order);
            let output = stream_id.clone();
            let connector = Connector { operation: plan.operation, inputs: plan.inputs, output, order: order + 1 };
            let place = match plan.spot {
                NewSpot::At(place) => layout::snapped(place),
                NewSpot::Below | NewSpot::Into(_) => layout::free_spot(behaviour, places, &stream, &connector),
            };
            change
                .put(behaviour, key(Kind::Stream, stream_id), Record::Stream(stream))
                .put(behaviour, key(Kind::Connector, connector_id), Record::Connector(connector))
                .put(behaviour, key(Kind::Place, stream_id), Record::Place(place))
        }
    }
}

/// A new connector with its new stream, and another one out of that stream, as one change: where one stream would have
/// been made or put in, both are.
pub(super) fn connected_twice(
    behaviour: &Behaviour,
    places: &BTreeMap<Id, Place>,
    change: Change,
    ids: [(&Id, &Id); 2],
    (first, then): (ConnectPlan, ConnectPlan),
) -> Change {
    let between = ids[0].0;
    let spot = match &first.spot {
        NewSpot::Into(gap) => NewSpot::Into(Gap { connector: gap.connector.clone(), input: between.clone() }),
        NewSpot::At(_) | NewSpot::Below => NewSpot::Below,
    };
    let change = connected(behaviour, places, change, ids[0], first);
    let (mut after, mut stand) = (behaviour.clone(), places.clone());
    after.apply(&change);
    stand.extend(change.edits.iter().filter_map(|edit| match edit.after {
        Some(Record::Place(place)) => Some((edit.id.id.clone(), place)),
        _ => None,
    }));
    connected(&after, &stand, change, ids[1], ConnectPlan { inputs: vec![between.clone()], spot, ..then })
}

#[cfg(test)]
#[path = "build_tests.rs"]
mod tests;
