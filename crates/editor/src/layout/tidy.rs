//! Tidying: a layered drawing, top to bottom, the parts without a connection in rows that fit the stage.

use super::spot::reach;
use super::{DrawnSizes, snapped};
use behaviour::layout::{LaidOut, arranged};
use behaviour::{Behaviour, FillFrom, Graph, Id, Place, StreamKind};
use std::collections::{BTreeMap, BTreeSet};

/// A place for every stream: senses in the top row of their part, actions in its bottom one; branches keep their order.
#[must_use]
pub fn tidy(behaviour: &Behaviour, sizes: DrawnSizes, stage: (f64, f64)) -> BTreeMap<Id, Place> {
    let streams = behaviour.streams_in_order();
    let graph = Graph::of(behaviour);
    let number: BTreeMap<&Id, usize> = (0..).zip(&streams).map(|(at, (id, _))| (*id, at)).filled();
    let shapes: Vec<LaidOut> = streams
        .iter()
        .map(|(id, stream)| {
            let (left, right) = reach(sizes, stream, graph.into_stream(id).iter().map(|(_, connector)| *connector));
            LaidOut { left, right, acts: stream.kind == StreamKind::Actuator, stood: behaviour.place(id) }
        })
        .collect();
    let places = arranged(&shapes, &edges(behaviour, &number), stage);
    streams.iter().zip(places).map(|((id, _), place)| ((*id).clone(), snapped(place))).filled()
}

fn edges(behaviour: &Behaviour, number: &BTreeMap<&Id, usize>) -> Vec<(usize, usize)> {
    let mut edges = BTreeSet::new();
    for (_, connector) in behaviour.connectors_in_order() {
        for input in &connector.inputs {
            if let (Some(from), Some(to)) = (number.get(input), number.get(&connector.output))
                && from != to
            {
                edges.insert((*from, *to));
            }
        }
    }
    edges.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::tidy;
    use crate::layout::tests::SIZES;
    use behaviour::{
        Behaviour, Connector, Id, Kind, Params, Place, Procedure, Record, RecordId, Stream, StreamKind, connectors,
    };

    const STAGE: (f64, f64) = (1_400.0, 800.0);

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn behaviour(streams: &[&str], edges: &[(&str, &str)]) -> Behaviour {
        let mut made = Behaviour::default();
        for (order, name) in (0..).zip(streams) {
            let kind = StreamKind::Ordinary;
            let (name, params) = ((*name).to_owned(), Params::new());
            let key = RecordId::new(Kind::Stream, &id(&name));
            let stream =
                Stream { kind, name, device: None, params, order, resources: None, priority: None, hold_ms: None };
            made.records.insert(key, Record::Stream(stream));
        }
        for (order, (from, to)) in (0..).zip(edges) {
            let operation = connectors::map::SPEC.with(Procedure::body("1"));
            let connector = Connector { operation, inputs: vec![id(from)], output: id(to), order };
            made.records
                .insert(RecordId::new(Kind::Connector, &id(&format!("c{order}"))), Record::Connector(connector));
        }
        made
    }

    #[test]
    fn everything_flows_down_and_nothing_overlaps() {
        let made = behaviour(&["a", "b", "c", "d", "e", "alone"], &[("a", "b"), ("b", "c"), ("b", "d"), ("e", "d")]);
        let places = tidy(&made, SIZES, STAGE);
        assert_eq!(places.len(), 6);
        for (from, to) in [("a", "b"), ("b", "c"), ("b", "d"), ("e", "d")] {
            assert!(places[&id(from)].y < places[&id(to)].y, "{from} {to} {places:?}");
        }
        let all: Vec<&Place> = places.values().collect();
        for (at, one) in all.iter().enumerate() {
            let near = |other: &&&Place| (one.x - other.x).abs() < 100.0 && (one.y - other.y).abs() < 60.0;
            assert!(!all[at + 1..].iter().any(|other| near(&other)), "{places:?}");
        }
    }

    #[test]
    fn actions_stand_in_one_bottom_row_and_senses_in_the_top_one() {
        let edges =
            [("sa", "b"), ("b", "c"), ("c", "x1"), ("sa", "x2"), ("sd", "x3"), ("sd", "b"), ("se", "x5"), ("c", "x5")];
        let mut made = behaviour(&["sa", "b", "c", "x1", "x2", "sd", "x3", "se", "x4", "x5"], &edges);
        for (id, record) in &mut made.records {
            if let Record::Stream(stream) = record {
                stream.kind = match id.id.as_str().as_bytes()[0] {
                    b's' => StreamKind::Sensor,
                    b'x' => StreamKind::Actuator,
                    _ => StreamKind::Ordinary,
                };
            }
        }
        let places = tidy(&made, SIZES, STAGE);
        let row = |names: &[&str]| -> std::collections::BTreeSet<i64> {
            names.iter().map(|name| places[&id(name)].y as i64).collect()
        };
        let (top, bottom) = (row(&["sa", "sd", "se"]), row(&["x1", "x2", "x3", "x4", "x5"]));
        assert!(top.len() == 1 && bottom.len() == 1 && top.first() < bottom.first(), "{places:?}");
        assert!(places.values().all(|place| place.y as i64 <= bottom.first().copied().unwrap()), "{places:?}");
        let all: Vec<&Place> = places.values().collect();
        for (at, one) in all.iter().enumerate() {
            assert!(
                !all[at + 1..].iter().any(|other| (one.x - other.x).abs() < 100.0 && (one.y - other.y).abs() < 60.0),
                "{places:?}"
            );
        }
    }

    #[test]
    fn an_empty_behaviour_and_a_single_stream_are_tidy() {
        assert!(tidy(&Behaviour::default(), SIZES, STAGE).is_empty());
        assert_eq!(tidy(&behaviour(&["a"], &[]), SIZES, STAGE).len(), 1);
    }
}
