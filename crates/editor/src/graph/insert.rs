//! A connector put between a stream and another connector, and what is below it makes room.

use super::plan::{ConnectPlan, Gap, Output};
use crate::layout::{Ground, LEVEL, snapped};
use behaviour::{
    Behaviour, Change, Connector, FillFrom, Graph, Id, Kind, Params, Place, Procedure, Record, RecordId, Stream,
    StreamKind,
};

/// A new connector with its new stream between a stream and a connector that takes from it; what is below makes room.
pub(super) fn inserted(
    ground: Ground,
    change: Change,
    (stream_id, connector_id): (&Id, &Id),
    (gap, plan): (&Gap, ConnectPlan),
) -> Change {
    let Ground { behaviour, places, .. } = ground;
    let Some(below) = behaviour.connector(&gap.connector) else { return change };
    let Output::New { name, device: None, .. } = plan.output else { return change };
    let order = behaviour.next_order();
    let made = ordinary(&name, order);
    let new = Connector { operation: plan.operation, inputs: plan.inputs, output: stream_id.clone(), order: order + 1 };
    let mut after = behaviour.clone();
    after.records.insert(key(Kind::Stream, stream_id), Record::Stream(made.clone()));
    let inputs = below.inputs.iter().map(|input| if *input == gap.input { stream_id } else { input }).cloned();
    let turned = with_inputs(&after, below, inputs.collect());
    let change = change
        .put(behaviour, key(Kind::Stream, stream_id), Record::Stream(made))
        .put(behaviour, key(Kind::Connector, connector_id), Record::Connector(new))
        .put(behaviour, key(Kind::Connector, &gap.connector), Record::Connector(turned));
    let (Some(above), Some(output)) = (places.get(&gap.input), places.get(&below.output)) else { return change };
    let is_alone = below.inputs.len() == 1;
    let x = if is_alone && (above.x - output.x).abs() > LEVEL { output.x } else { above.x };
    let place = snapped(Place { x, y: above.y + LEVEL });
    let change = change.put(behaviour, key(Kind::Place, stream_id), Record::Place(place));
    let missing = place.y + LEVEL - output.y;
    if missing > 0.0 { lowered(ground, change, &below.output, missing) } else { change }
}

/// A stream and all that is below it, lower by so much.
pub(super) fn lowered(ground: Ground, change: Change, from: &Id, by: f64) -> Change {
    let Ground { behaviour, places, .. } = ground;
    let graph = Graph::of(behaviour);
    let below = graph.below(from).into_iter().chain([from]).distinct();
    let moved = below.into_iter().filter_map(|id| Some((id, *places.get(id)?)));
    moved.fold(change, |change, (id, place)| {
        change.put(behaviour, key(Kind::Place, id), Record::Place(snapped(Place { y: place.y + by, ..place })))
    })
}

/// A connector that takes from other streams: what its body calls them follows, place by place.
pub(super) fn with_inputs(behaviour: &Behaviour, connector: &Connector, inputs: Vec<Id>) -> Connector {
    let mut taken = Connector { inputs, ..connector.clone() };
    if let Some(Procedure::Body { body, args: None }) = connector.operation.procedure() {
        let (old, new) = (behaviour.arguments(connector), behaviour.arguments(&taken));
        let body = behaviour::rename_identifiers(body, &old, &new);
        if let Some(procedure) = taken.operation.procedure_mut() {
            *procedure = Procedure::body(&body);
        }
    }
    taken
}

/// A stream between connectors.
pub(super) fn ordinary(name: &str, order: i64) -> Stream {
    Stream {
        kind: StreamKind::Ordinary,
        name: name.trim().to_owned(),
        device: None,
        params: Params::new(),
        order,
        resources: None,
        priority: None,
        hold_ms: None,
    }
}

fn key(kind: Kind, id: &Id) -> RecordId {
    RecordId::new(kind, id)
}
