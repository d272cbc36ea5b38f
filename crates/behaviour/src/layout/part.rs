//! One part of a graph: all that is connected, in layers.

use super::across::{RowReach, apart};
use super::rows::rows;
use super::{BENDS, GAP, LEVEL, LaidOut, STREAM_HEIGHT, WAY};
use crate::Place;

/// The number of times that the members of a row are drawn to the row above and to the one below.
const SWEEPS: usize = 6;
/// More rows than this times its members are not filled up with what keeps the ways of edges free.
const FILLED_MAX: usize = 8;

/// The place of a shape in its part.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartSpot {
    pub(super) shape: usize,
    pub(super) at: Place,
    /// True if it is an action in the last row, and goes down with the others of its row of parts.
    pub(super) sinks: bool,
}

/// A part with its corner at the origin.
#[derive(Clone, Debug)]
pub(super) struct PlacedPart {
    pub(super) spots: Vec<PartSpot>,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// Members of a part, and the edges between them by their places among the members.
type PartMembers = (Vec<usize>, Vec<(usize, usize)>);

/// The first of all that something is known to be connected with.
fn top(root: &mut [usize], mut at: usize) -> usize {
    while root[at] != at {
        root[at] = root[root[at]];
        at = root[at];
    }
    at
}

/// Groups the members that are connected with each other, each part in the order of its members.
pub(super) fn connected(count: usize, edges: &[(usize, usize)]) -> Vec<PartMembers> {
    let mut root: Vec<usize> = (0..count).collect();
    for (from, to) in edges {
        let (one, other) = (top(&mut root, *from), top(&mut root, *to));
        root[one.max(other)] = one.min(other);
    }
    let mut parts: Vec<PartMembers> = Vec::new();
    let mut place = vec![(0, 0); count];
    for at in 0..count {
        let first = top(&mut root, at);
        if first == at {
            place[at].0 = parts.len();
            parts.push(PartMembers::default());
        }
        let part = place[first].0;
        place[at] = (part, parts[part].0.len());
        parts[part].0.push(at);
    }
    for (from, to) in edges.iter().filter(|(from, to)| from != to) {
        parts[place[*from].0].1.push((place[*from].1, place[*to].1));
    }
    parts
}

/// The layers of a part while they are made. Numbers from `members` on are what keeps ways free.
struct Layers {
    members: usize,
    rows: Vec<usize>,
    edges: Vec<(usize, usize)>,
}

impl Layers {
    fn of(members: usize, edges: &[(usize, usize)], acts: impl Fn(usize) -> bool) -> Self {
        let mut rows = rows(members, edges);
        let bottom = rows.iter().copied().max().unwrap_or_default();
        for (at, row) in rows.iter_mut().enumerate() {
            if acts(at) && !edges.iter().any(|(from, _)| *from == at) {
                *row = bottom;
            }
        }
        let mut layers = Self { members, rows, edges: Vec::new() };
        let span = |(from, to): &(usize, usize)| layers.rows[*to].saturating_sub(layers.rows[*from]).saturating_sub(1);
        let fills = edges.iter().map(span).sum::<usize>() <= members.saturating_mul(FILLED_MAX);
        for (from, to) in edges {
            layers.lead(*from, *to, fills);
        }
        layers
    }

    /// An edge, with something in each row between that keeps its way free.
    fn lead(&mut self, from: usize, to: usize, fills: bool) {
        let mut above = from;
        // An edge that closes a circle leads up, and keeps nothing free.
        let between = self.rows[from] + 1..self.rows[to].max(self.rows[from] + 1);
        for row in if fills { between } else { 0..0 } {
            self.rows.push(row);
            self.edges.push((above, self.rows.len() - 1));
            above = self.rows.len() - 1;
        }
        if self.rows[above] < self.rows[to] {
            self.edges.push((above, to));
        }
    }

    /// Returns for each member those of the row above that lead to it, and those of the row below to which it leads.
    fn neighbours(&self) -> [Vec<Vec<usize>>; 2] {
        let mut both = [vec![Vec::new(); self.rows.len()], vec![Vec::new(); self.rows.len()]];
        for (from, to) in &self.edges {
            both[0][*to].push(*from);
            both[1][*from].push(*to);
        }
        both
    }

    /// Orders the members of each row from the left: below what leads there, siblings as they stood.
    fn ordered(&self, above: &[Vec<usize>], key: impl Fn(usize) -> (f64, usize)) -> Vec<Vec<usize>> {
        let mut ordered = vec![Vec::new(); self.rows.iter().max().map_or(0, |bottom| bottom + 1)];
        for (at, row) in self.rows.iter().enumerate() {
            ordered[*row].push(at);
        }
        let mut position = vec![0.0; self.rows.len()];
        for row in &mut ordered {
            let wants = |at: usize| mean(above[at].iter().map(|from| position[*from]));
            let first = |at: &usize| (wants(*at), key(*at));
            let mut keyed: Vec<_> = row.iter().map(|at| (first(at), *at)).collect();
            // What nothing leads to stands by where it stood, among those whose place is known by what leads there.
            keyed.sort_by(|((_, one), _), ((_, other), _)| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            let (mut led, roots): (Vec<_>, Vec<_>) = keyed.into_iter().partition(|((wants, _), _)| wants.is_some());
            led.sort_by(|((one, _), _), ((other, _), _)| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal));
            for root in roots {
                let at = led.iter().position(|((_, key), _)| key.0 > root.0.1.0).unwrap_or(led.len());
                led.insert(at, root);
            }
            *row = led.into_iter().map(|(_, at)| at).collect();
            for (at, member) in row.iter().enumerate() {
                position[*member] = (at as f64 + 0.5) / row.len() as f64;
            }
        }
        ordered
    }
}

fn mean(all: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, many) = all.fold((0.0, 0_usize), |(sum, many), value| (sum + value, many + 1));
    (many > 0).then(|| sum / many as f64)
}

impl PlacedPart {
    pub(super) fn of(shapes: &[LaidOut], members: Vec<usize>, edges: &[(usize, usize)]) -> Self {
        let layers = Layers::of(members.len(), edges, |at| shapes[members[at]].acts);
        let [above, below] = layers.neighbours();
        let stood = |at: usize| members.get(at).and_then(|shape| shapes[*shape].stood).map(|place| place.x);
        // What keeps a way free goes with what it leads to.
        let leads = |mut at: usize| {
            while at >= layers.members {
                at = below[at].first().copied().unwrap_or(0);
            }
            at
        };
        let key = |at: usize| (stood(leads(at)).unwrap_or(f64::MAX), leads(at));
        let ordered = layers.ordered(&above, key);
        let reach = |at: &usize| match members.get(*at) {
            Some(shape) => RowReach { left: shapes[*shape].left, right: shapes[*shape].right },
            None => RowReach { left: WAY / 2.0, right: WAY / 2.0 },
        };
        let reaches: Vec<Vec<RowReach>> = ordered.iter().map(|row| row.iter().map(reach).collect()).collect();
        let x = across(&ordered, &reaches, &[above, below]);
        let several = (0..layers.members)
            .any(|at| shapes[members[at]].acts && edges.iter().filter(|(_, to)| *to == at).nth(1).is_some());
        let edge = ordered.iter().flatten().map(|at| x[*at] - reach(at).left).fold(f64::MAX, f64::min);
        let width = ordered.iter().flatten().map(|at| x[*at] + reach(at).right - edge).fold(0.0, f64::max);
        let bottom = ordered.len().saturating_sub(1);
        let bends = if several { BENDS } else { 0.0 };
        let lower = |row: usize| if row > 0 && row == bottom { bends } else { 0.0 };
        let spot = |(at, shape): (usize, &usize)| {
            let row = layers.rows[at];
            let place = Place { x: (x[at] - edge).round(), y: row as f64 * LEVEL + lower(row) };
            PartSpot { shape: *shape, at: place, sinks: shapes[*shape].acts && row == bottom }
        };
        let height = bottom as f64 * LEVEL + lower(bottom) + STREAM_HEIGHT;
        Self { spots: members.iter().enumerate().map(spot).collect(), width, height }
    }
}

/// Places everything from left to right.
fn across(ordered: &[Vec<usize>], reaches: &[Vec<RowReach>], neighbours: &[Vec<Vec<usize>>; 2]) -> Vec<f64> {
    let mut x = vec![0.0; neighbours[0].len()];
    let mut draw = |row: usize, side: usize| {
        let at_row = &ordered[row];
        let wanted: Vec<f64> = at_row
            .iter()
            .map(|at| mean(neighbours[side][*at].iter().map(|other| x[*other])).unwrap_or(x[*at]))
            .collect();
        for (at, place) in at_row.iter().zip(apart(&wanted, &reaches[row], GAP)) {
            x[*at] = place;
        }
    };
    for _ in 0..SWEEPS {
        (0..ordered.len()).for_each(|row| draw(row, 0));
        (0..ordered.len()).rev().for_each(|row| draw(row, 1));
    }
    x
}
