//! New senses and connectors, as pure functions of the behaviour as it is.

use super::insert::inserted;
use super::plan::{ConnectPlan, Gap, NewSpot, Output};
use crate::build::free_name;
use crate::layout::{self, Ground};
use behaviour::{Change, Connector, Id, Kind, Params, Place, Record, RecordId, Stream, StreamKind};

fn new_stream(kind: StreamKind, name: &str, device: Option<String>, params: Params, order: i64) -> Stream {
    Stream { kind, name: name.trim().to_owned(), device, params, order, resources: None, priority: None, hold_ms: None }
}

fn key(kind: Kind, id: &Id) -> RecordId {
    RecordId::new(kind, id)
}

/// A new sensor stream, in the top row unless it has a place.
pub fn sensor(
    ground: Ground,
    change: Change,
    (id, device, name, params): (&Id, &str, &str, Params),
    at: Option<Place>,
) -> Change {
    let behaviour = ground.behaviour;
    let name = free_name(behaviour, name);
    let stream = new_stream(StreamKind::Sensor, &name, Some(device.to_owned()), params, behaviour.next_order());
    let place = at.map_or_else(|| layout::free_sensor_spot(ground, &stream), layout::snapped);
    change.put(behaviour, key(Kind::Place, id), Record::Place(place)).put(
        behaviour,
        key(Kind::Stream, id),
        Record::Stream(stream),
    )
}

/// A new connector and, if it leads to a new stream, that stream under its sources.
pub fn connected(ground: Ground, change: Change, (stream_id, connector_id): (&Id, &Id), plan: ConnectPlan) -> Change {
    let behaviour = ground.behaviour;
    if let NewSpot::Into(gap) = plan.spot.clone() {
        return inserted(ground, change, (stream_id, connector_id), (&gap, plan));
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
                NewSpot::Below | NewSpot::Into(_) => layout::free_spot(ground, &stream, &connector),
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
pub fn connected_twice(
    ground: Ground,
    change: Change,
    ids: [(&Id, &Id); 2],
    (first, then): (ConnectPlan, ConnectPlan),
) -> Change {
    let between = ids[0].0;
    let spot = match &first.spot {
        NewSpot::Into(gap) => NewSpot::Into(Gap { connector: gap.connector.clone(), input: between.clone() }),
        NewSpot::At(_) | NewSpot::Below => NewSpot::Below,
    };
    let change = connected(ground, change, ids[0], first);
    let (mut after, mut stand) = (ground.behaviour.clone(), ground.places.clone());
    after.apply(&change);
    stand.extend(change.edits.iter().filter_map(|edit| match edit.after {
        Some(Record::Place(place)) => Some((edit.id.id.clone(), place)),
        _ => None,
    }));
    let ground = Ground { behaviour: &after, places: &stand, ..ground };
    connected(ground, change, ids[1], ConnectPlan { inputs: vec![between.clone()], spot, ..then })
}

#[cfg(test)]
#[path = "connecting_tests.rs"]
mod tests;
