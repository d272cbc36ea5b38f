//! Tidying: a layered drawing, top to bottom, each connected part beside the one before.

use super::spot::whole_width;
use super::{GAP, LEVEL, snapped};
use behaviour::{Behaviour, Filled, Graph, Id, Place};
use rust_sugiyama::configure::{Config, CrossingMinimization, RankingType};
use std::collections::{BTreeMap, BTreeSet};

/// A place for every stream.
pub(crate) fn tidy(behaviour: &Behaviour) -> BTreeMap<Id, Place> {
    let streams = behaviour.streams_in_order();
    let graph = Graph::of(behaviour);
    let number: BTreeMap<&Id, u32> = (0..).zip(&streams).map(|(at, (id, _))| (*id, at)).filled();
    let width = |at: usize| {
        let (id, stream) = streams[at];
        whole_width(stream, graph.into_stream(id).iter().map(|(_, connector)| *connector))
    };
    let edges = edges(behaviour, &number);
    let joined: BTreeSet<u32> = edges.iter().flat_map(|(from, to)| [*from, *to]).filled();
    let vertices: Vec<_> = joined.iter().map(|at| (*at, (width(*at as usize), 48.0))).collect();
    let mut parts: Vec<Vec<(usize, f64, f64)>> = Vec::new();
    if !edges.is_empty() {
        let layouts = rust_sugiyama::from_vertices_and_edges(&vertices, &edges, &config());
        parts.extend(layouts.into_iter().map(|(spots, _, _)| in_rows(&spots)));
    }
    let alone = (0..streams.len()).filter(|at| !joined.contains(&(*at as u32)));
    parts.extend(alone.map(|at| vec![(at, 0.0, 0.0)]));
    parts.sort_by_key(|part| part.iter().map(|spot| spot.0).min());
    let mut places = BTreeMap::new();
    let mut left = 0.0;
    for part in parts {
        left = put_beside(&part, left, &width, |at, place| {
            places.insert(streams[at].0.clone(), place);
        });
    }
    places
}

fn config() -> Config {
    Config {
        vertex_spacing: GAP,
        ranking_type: RankingType::Up,
        c_minimization: CrossingMinimization::Barycenter,
        ..Config::default()
    }
}

fn edges(behaviour: &Behaviour, number: &BTreeMap<&Id, u32>) -> Vec<(u32, u32)> {
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

/// Heights become rows of equal distance.
fn in_rows(spots: &[(usize, (f64, f64))]) -> Vec<(usize, f64, f64)> {
    let mut heights: Vec<f64> = spots.iter().map(|(_, (_, y))| *y).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|one, other| (*one - *other).abs() < 1.0);
    let row = |y: f64| heights.iter().position(|height| (height - y).abs() < 1.0).unwrap_or(0) as f64;
    spots.iter().map(|(at, (x, y))| (*at, *x, row(*y) * LEVEL)).collect()
}

/// Puts one part at the right of what is there; returns where the next may begin.
fn put_beside(
    part: &[(usize, f64, f64)],
    left: f64,
    width: &impl Fn(usize) -> f64,
    mut put: impl FnMut(usize, Place),
) -> f64 {
    let edge = part.iter().map(|(at, x, _)| x - width(*at) / 2.0).fold(f64::MAX, f64::min);
    let mut right = left;
    for (at, x, y) in part {
        let x = x - edge + left;
        right = f64::max(right, x + width(*at) / 2.0);
        put(*at, snapped(Place { x, y: *y }));
    }
    right + GAP * 2.0
}

#[cfg(test)]
mod tests {
    use super::tidy;
    use behaviour::{
        Behaviour, Connector, Id, Kind, Params, Place, Procedure, Record, RecordId, Stream, StreamKind, connectors,
    };

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
        let places = tidy(&made);
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
    fn an_empty_behaviour_and_a_single_stream_are_tidy() {
        assert!(tidy(&Behaviour::default()).is_empty());
        assert_eq!(tidy(&behaviour(&["a"], &[])).len(), 1);
    }
}
