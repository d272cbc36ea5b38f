//! The bounds of things on the canvas: streams, chips, notes, groups. Not reactive.

use super::chip::chip_of;
use super::fold::{ConnectorEnd, end_of};
use super::view::CanvasBounds;
use crate::desk::Desk;
use crate::layout::{BOX, CHIP_HEIGHT, LEVEL, STREAM_HEIGHT, chip_width, chip_words, note_size, stream_width};
use behaviour::{Id, Place};
use leptos::prelude::*;

/// Room in a frame at the sides of its streams, above them for its title and the chips that lead in, and below, in canvas units.
const FRAME: (f64, f64, f64) = (20.0, 84.0, 16.0);

/// Returns the bounds of a stream, without its live value, or of a note or group.
pub(super) fn bounds(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    let Some(signals) = desk.document.stream(id) else {
        return note_bounds(desk, id).or_else(|| group_bounds(desk, id));
    };
    let width = signals.record.with_untracked(stream_width);
    Some(around(signals.place.get_untracked(), width))
}

/// Returns the bounds of a note.
fn note_bounds(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    let signals = desk.document.note_signals(id)?;
    let (width, height) = signals.record.with_untracked(|note| note_size(&note.text));
    let place = signals.place.get_untracked();
    Some(CanvasBounds { bottom: place.y + height, ..around(place, width) })
}

/// Returns the bounds of a group: of its box, or of its frame.
fn group_bounds(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    untrack(|| if desk.document.is_folded(id) { box_bounds(desk, id) } else { frame_of(desk, id) })
}

pub(super) fn box_bounds(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    let at = desk.document.group(id)?.at.get_untracked()?;
    Some(CanvasBounds { bottom: at.y + BOX.1, ..around(at, BOX.0) })
}

/// Returns the bounds of an open group's frame: around its streams.
fn frame_of(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    framed(untrack(|| desk.document.members(id)).iter().filter_map(|id| bounds(desk, id)))
}

/// The open group into whose frame a stream is carried, if that stream alone moves `by` so much, is in no group and did not
/// stand there before.
pub(super) fn group_at(desk: &Desk, moving: &[(Id, Place)], by: (f64, f64)) -> Option<Id> {
    let [(stream, was)] = moving else { return None };
    let groups = desk.document.group_ids.get_untracked();
    let has = |group: &Id| untrack(|| desk.document.members(group)).contains(stream);
    if groups.is_empty() || desk.document.stream(stream).is_none() || groups.iter().any(has) {
        return None;
    }
    let middle = |x: f64, y: f64| Place { x, y: y + STREAM_HEIGHT / 2.0 };
    let (before, now) = (middle(was.x, was.y), middle(was.x + by.0, was.y + by.1));
    let is_into = |id: &Id| {
        let open = !untrack(|| desk.document.is_folded(id));
        open && frame_of(desk, id).is_some_and(|frame| frame.holds(now) && !frame.holds(before))
    };
    groups.into_iter().find(is_into)
}

/// The frame around some streams, with its title on top.
pub(super) fn framed(streams: impl Iterator<Item = CanvasBounds>) -> Option<CanvasBounds> {
    let CanvasBounds { left, top, right, bottom } = CanvasBounds::around(streams)?;
    Some(CanvasBounds { left: left - FRAME.0, top: top - FRAME.1, right: right + FRAME.0, bottom: bottom + FRAME.2 })
}

/// Returns the bounds of the notes and groups.
pub(super) fn aside_bounds(desk: &Desk) -> Vec<CanvasBounds> {
    let (notes, groups) = (desk.document.note_ids.get_untracked(), desk.document.group_ids.get_untracked());
    let notes = notes.iter().filter_map(|id| note_bounds(desk, id));
    notes.chain(groups.iter().filter_map(|id| group_bounds(desk, id))).collect()
}

pub(super) fn around(place: Place, width: f64) -> CanvasBounds {
    CanvasBounds {
        left: place.x - width / 2.0,
        top: place.y,
        right: place.x + width / 2.0,
        bottom: place.y + STREAM_HEIGHT,
    }
}

/// Returns the bounds of a connector's chip, if it is seen.
pub(super) fn chip_bounds(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    let record = desk.document.connector(id)?.record.get_untracked();
    let chip = untrack(|| chip_of(desk, &record))?;
    Some(CanvasBounds { bottom: chip.y + CHIP_HEIGHT, ..around(chip, chip_width(&chip_words(&record))) })
}

/// About where a connector runs.
pub(super) fn connector_bounds(desk: &Desk, id: &Id) -> Option<CanvasBounds> {
    let ends = desk.document.connector(id)?.record.with_untracked(|connector| {
        let mut ends = connector.inputs.clone();
        ends.push(connector.output.clone());
        ends
    });
    let places = ends.iter().filter_map(|end| untrack(|| end_of(desk, end, ConnectorEnd::Output)));
    CanvasBounds::around(places.map(|place| around(place, LEVEL)))
}

#[cfg(test)]
mod tests {
    use super::framed;
    use crate::graph::view::CanvasBounds;

    #[test]
    fn a_frame_goes_around_its_streams_with_room_for_its_title() {
        let at = |left: f64, top: f64| CanvasBounds { left, top, right: left + 100.0, bottom: top + 48.0 };
        let frame = framed([at(0.0, 0.0), at(300.0, 140.0)].into_iter()).unwrap();
        assert_eq!(frame, CanvasBounds { left: -20.0, top: -84.0, right: 420.0, bottom: 204.0 });
        assert!(framed(std::iter::empty()).is_none());
    }
}
