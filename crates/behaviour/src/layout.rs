//! The layout of a graph: parts in layers, values flowing down, and the parts in rows that fit a stage.
//!
//! Only sizes, edges and earlier places are handed in, so the page and the pictures of the library lay out alike. What stood
//! left of its sibling stays left of it: people find their programs by where things are.

mod across;
mod pack;
mod part;
mod rows;

use crate::Place;

/// The height of a stream, in canvas units.
pub const STREAM_HEIGHT: f64 = 48.0;
/// The distance from the top of a stream to the top of the next one below.
pub const LEVEL: f64 = 120.0;
/// The distance between neighbours.
pub const GAP: f64 = 24.0;
/// The distance between two parts without a connection, to the side and down; above a part there may be the chips of
/// nothing.
pub const PARTS_APART: (f64, f64) = (40.0, 48.0);
/// Kept between the last row of others and actions that several connectors lead to, for the bends of these.
const BENDS: f64 = 40.0;
/// The width of what keeps the way of an edge free.
const WAY: f64 = 40.0;

/// Something that is laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaidOut {
    /// The distance from the middle to the left edge.
    pub left: f64,
    /// The distance from the middle to the right edge, with the value beside it.
    pub right: f64,
    /// True if it is an action: these stand in the last row.
    pub acts: bool,
    /// The place where it stood, if somebody put it there.
    pub stood: Option<Place>,
}

/// The most times that a graph is arranged until that moves nothing any more.
const PASSES_MAX: usize = 8;

/// A place for every shape: the middle of its top edge. `edges` lead from one number to another; `stage` is the width and
/// height in which everything shall be seen. What is arranged already stays where it is, in nearly all graphs.
#[must_use]
pub fn arranged(shapes: &[LaidOut], edges: &[(usize, usize)], stage: (f64, f64)) -> Vec<Place> {
    let mut shapes = shapes.to_vec();
    let mut places = once(&shapes, edges, stage);
    // Where everything stands decides what comes first, and so where it stands: until both agree.
    for _ in 1..PASSES_MAX {
        shapes.iter_mut().zip(&places).for_each(|(shape, at)| shape.stood = Some(*at));
        let again = once(&shapes, edges, stage);
        if again == places {
            break;
        }
        places = again;
    }
    places
}

fn once(shapes: &[LaidOut], edges: &[(usize, usize)], stage: (f64, f64)) -> Vec<Place> {
    let mut places = vec![Place { x: 0.0, y: 0.0 }; shapes.len()];
    let parts: Vec<part::PlacedPart> = part::connected(shapes.len(), edges)
        .into_iter()
        .map(|(members, edges)| part::PlacedPart::of(shapes, members, &edges))
        .collect();
    let parts = pack::in_order(parts, shapes);
    for (part, at) in parts.iter().zip(pack::packed(&parts, stage)) {
        for spot in &part.spots {
            let lower = if spot.sinks { at.lower } else { 0.0 };
            places[spot.shape] = Place { x: spot.at.x + at.x, y: spot.at.y + at.y + lower };
        }
    }
    places
}

#[cfg(test)]
mod tests;
