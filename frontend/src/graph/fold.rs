//! The ends of connectors as they are seen: at their streams, or at the box of the folded group that those are in.
//! The chip of a connector belongs to the group of the stream that it leads to.

use crate::desk::Desk;
use crate::layout::{BOX, STREAM_HEIGHT};
use behaviour::{Connector, Id, Place};
use leptos::prelude::*;

/// The greatest distance from the middle of a box at which an edge may reach it, in canvas units.
const REACH: f64 = 96.0;

/// The two ends of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ConnectorEnd {
    Input,
    Output,
}

/// Returns where the stream is seen that is an end of a connector; for a box, where a stream would stand that has its
/// edge there. Reactive.
pub(super) fn end_of(desk: &Desk, stream: &Id, end: ConnectorEnd) -> Option<Place> {
    let own = desk.document.stream(stream)?.place.get();
    let Some(group) = desk.document.hidden_in(stream) else { return Some(own) };
    let at = desk.document.group(&group)?.at.get()?;
    Some(on_box(own, at, end))
}

/// An edge reaches a box about where its stream is in it.
fn on_box(stream: Place, at: Place, end: ConnectorEnd) -> Place {
    let x = at.x + (stream.x - at.x).clamp(-REACH, REACH);
    match end {
        ConnectorEnd::Input => Place { x, y: at.y + BOX.1 - STREAM_HEIGHT },
        ConnectorEnd::Output => Place { x, y: at.y },
    }
}

/// The inputs of a connector that are seen apart from its output: not those in the same folded group. Reactive.
pub(super) fn inputs_outside<'a>(desk: &Desk, connector: &'a Connector) -> Vec<&'a Id> {
    let group = desk.document.hidden_in(&connector.output);
    let outside = |id: &&Id| group.is_none() || desk.document.hidden_in(id) != group;
    connector.inputs.iter().filter(outside).collect()
}

#[cfg(test)]
mod tests {
    use super::{ConnectorEnd, on_box};
    use behaviour::Place;

    #[test]
    fn edges_end_on_the_rim_of_a_box() {
        let at = Place { x: 100.0, y: 200.0 };
        let stream = |x: f64| Place { x, y: 0.0 };
        assert_eq!(on_box(stream(120.0), at, ConnectorEnd::Output), Place { x: 120.0, y: 200.0 });
        assert_eq!(on_box(stream(900.0), at, ConnectorEnd::Output).x, 196.0, "never past its corner");
        // A curve begins below a stream: 48 further down is the lower edge of a box of 64.
        assert_eq!(on_box(stream(-900.0), at, ConnectorEnd::Input), Place { x: 4.0, y: 216.0 });
    }
}
