//! Tidying: a layered drawing, top to bottom, each connected part beside the one before.

use super::spot::whole_width;
use super::{GAP, LEVEL, snapped};
use behaviour::{Behaviour, Filled, Graph, Id, Place, StreamKind};
use rust_sugiyama::configure::{Config, CrossingMinimization, RankingType};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// More rows than this times the streams are not filled up for actions to stand at the bottom.
const FILLED_MAX: usize = 8;
/// The width of what keeps the way of an edge free.
const WAY: f64 = 40.0;
/// Kept between the last row of others and actions that several connectors lead to, for the bends of these.
const BENDS: f64 = 40.0;

/// A place for every stream: senses in the top row, actions all in the bottom one.
pub(crate) fn tidy(behaviour: &Behaviour) -> BTreeMap<Id, Place> {
    let streams = behaviour.streams_in_order();
    let graph = Graph::of(behaviour);
    let number: HashMap<&Id, u32> = (0..).zip(&streams).map(|(at, (id, _))| (*id, at)).filled();
    let acts = |at: usize| streams.get(at).is_some_and(|(_, stream)| stream.kind == StreamKind::Actuator);
    let width = |at: usize| {
        let Some((id, stream)) = streams.get(at) else { return WAY };
        whole_width(stream, graph.into_stream(id).iter().map(|(_, connector)| *connector))
    };
    let (edges, rows) = to_bottom(edges(behaviour, &number), streams.len(), acts);
    let bottom = rows.iter().flatten().copied().max().unwrap_or_default();
    let joined: BTreeSet<u32> = edges.iter().flat_map(|(from, to)| [*from, *to]).filled();
    // The rows are right only if what leads to something comes before it.
    let mut joined_in_order: Vec<u32> = joined.iter().copied().collect();
    joined_in_order.sort_by_key(|at| rows.get(*at as usize).copied().flatten().unwrap_or(usize::MAX));
    let vertices: Vec<_> = joined_in_order.iter().map(|at| (*at, (width(*at as usize), 48.0))).collect();
    let mut parts: Vec<Vec<(usize, f64, f64)>> = Vec::new();
    if !edges.is_empty() {
        let layouts = rust_sugiyama::from_vertices_and_edges(&vertices, &edges, &config());
        // What comes back is numbered as it was handed in.
        let at = |spot: &(usize, (f64, f64))| Some((*joined_in_order.get(spot.0)? as usize, spot.1));
        parts
            .extend(layouts.into_iter().map(|(spots, _, _)| in_rows(&spots.iter().filter_map(at).collect::<Vec<_>>())));
    }
    let alone = (0..streams.len()).filter(|at| !joined.contains(&(*at as u32)));
    parts.extend(alone.map(|at| vec![(at, 0.0, if acts(at) { bottom as f64 * LEVEL } else { 0.0 })]));
    parts.sort_by_key(|part| part.iter().map(|spot| spot.0).min());
    let bends =
        streams.iter().any(|(id, stream)| stream.kind == StreamKind::Actuator && graph.into_stream(id).len() > 1);
    let lower = if bends { BENDS } else { 0.0 };
    let mut places = BTreeMap::new();
    let mut left = 0.0;
    for part in parts {
        left = put_beside(&part, left, &width, |at, place| {
            let Some((id, _)) = streams.get(at) else { return };
            let y = if acts(at) { place.y + lower } else { place.y };
            places.insert((*id).clone(), Place { y, ..place });
        });
    }
    places
}

/// The same edges with as much put between an action and the lowest of what leads to it that all actions come to stand in
/// the bottom row, and the rows. What is put there has the numbers after those of the streams.
fn to_bottom(
    mut edges: Vec<(u32, u32)>,
    streams: usize,
    acts: impl Fn(usize) -> bool,
) -> (Vec<(u32, u32)>, Vec<Option<usize>>) {
    let mut rows = rows(&edges, streams);
    let bottom = rows.iter().flatten().copied().max().unwrap_or_default();
    let row = |at: usize| rows.get(at).copied().flatten().filter(|row| *row > 0 && *row < bottom && acts(at));
    let higher: Vec<(usize, usize)> = (0..streams).filter_map(|at| Some((at, row(at)?))).collect();
    if higher.iter().map(|(_, row)| bottom - row).sum::<usize>() > streams.saturating_mul(FILLED_MAX) {
        return (edges, rows);
    }
    let mut lowest: BTreeMap<usize, usize> = BTreeMap::new();
    for (place, (from, to)) in edges.iter().enumerate() {
        let above = |place: &usize| rows.get(edges[*place].0 as usize).copied().flatten();
        let best = lowest.entry(*to as usize).or_insert(place);
        if above(best) < rows.get(*from as usize).copied().flatten() {
            *best = place;
        }
    }
    for (at, row) in higher {
        let Some(place) = lowest.get(&at) else { continue };
        let mut above = edges[*place].0;
        for between in row..bottom {
            let filling = rows.len() as u32;
            rows.push(Some(between));
            if between == row {
                edges[*place].1 = filling;
            } else {
                edges.push((above, filling));
            }
            above = filling;
        }
        edges.push((above, at as u32));
        rows[at] = Some(bottom);
    }
    (edges, rows)
}

/// In which row each stream comes to stand: one below the lowest that leads to it; none where values flow in a circle.
fn rows(edges: &[(u32, u32)], streams: usize) -> Vec<Option<usize>> {
    let mut waits = vec![0_usize; streams];
    let mut below: Vec<Vec<usize>> = vec![Vec::new(); streams];
    for (from, to) in edges {
        waits[*to as usize] += 1;
        below[*from as usize].push(*to as usize);
    }
    let mut rows = vec![None; streams];
    let mut ready: Vec<(usize, usize)> = (0..streams).filter(|at| waits[*at] == 0).map(|at| (at, 0)).collect();
    let mut lowest = vec![0_usize; streams];
    while let Some((at, row)) = ready.pop() {
        rows[at] = Some(row);
        for next in &below[at] {
            lowest[*next] = lowest[*next].max(row + 1);
            waits[*next] -= 1;
            if waits[*next] == 0 {
                ready.push((*next, lowest[*next]));
            }
        }
    }
    rows
}

fn config() -> Config {
    Config {
        vertex_spacing: GAP,
        ranking_type: RankingType::Up,
        c_minimization: CrossingMinimization::Barycenter,
        ..Config::default()
    }
}

fn edges(behaviour: &Behaviour, number: &HashMap<&Id, u32>) -> Vec<(u32, u32)> {
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
        let places = tidy(&made);
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
        assert!(tidy(&Behaviour::default()).is_empty());
        assert_eq!(tidy(&behaviour(&["a"], &[])).len(), 1);
    }
}
