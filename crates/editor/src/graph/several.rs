//! Several things at once: removed, lined up. Pure.

use super::grouping::{expanded, members, without_empty, without_group};
use crate::Selected;
use crate::build::{without_connector, without_stream};
use crate::layout::{BOX, GAP, Ground, LEVEL, VALUE_ROOM, snapped};
use behaviour::{Behaviour, Change, Id, Kind, Place, Record, RecordId};
use std::collections::{BTreeMap, BTreeSet};

/// Without all of these, the connectors at the streams, and the streams in the groups.
pub fn without(behaviour: &Behaviour, change: Change, of: &BTreeSet<Selected>) -> Change {
    let change = expanded(behaviour, of).iter().fold(change, |change, one| match one {
        Selected::Stream(id) => without_stream(behaviour, change, id),
        Selected::Connector(id) => without_connector(behaviour, change, id),
        Selected::Note(id) => {
            let change = change.take(behaviour, RecordId::new(Kind::Note, id));
            change.take(behaviour, RecordId::new(Kind::Place, id))
        }
        Selected::Group(id) => without_group(behaviour, change, id),
    });
    without_empty(behaviour, change)
}

/// The ways to line things up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineUp {
    /// Beside each other, at the height of the topmost.
    Row,
    /// Below each other, under the topmost.
    Column,
}

/// One of what is lined up: a stream, a note, or a folded group with its streams.
struct LinedUp {
    id: Id,
    place: Place,
    half: f64,
    /// Room for its value.
    spare: f64,
}

fn item(Ground { behaviour, places, sizes }: Ground, one: &Selected) -> Option<LinedUp> {
    let (width, spare) = match one {
        Selected::Stream(id) => (behaviour.stream(id).map_or(0.0, sizes.stream), VALUE_ROOM),
        Selected::Note(id) => match behaviour.records.get(&RecordId::new(Kind::Note, id)) {
            Some(Record::Note(note)) => ((sizes.note)(&note.text).0, 0.0),
            _ => return None,
        },
        Selected::Group(_) => (BOX.0, 0.0),
        Selected::Connector(_) => return None,
    };
    Some(LinedUp { id: one.id().clone(), place: *places.get(one.id())?, half: width / 2.0, spare })
}

/// Returns the places of these in a row or a column, in the order in which they stand now.
#[must_use]
pub fn lined_up(ground: Ground, of: &BTreeSet<Selected>, how: LineUp) -> Vec<(Id, Place)> {
    let Ground { behaviour, places, .. } = ground;
    let mut items: Vec<LinedUp> = of.iter().filter_map(|one| item(ground, one)).collect();
    let along = |place: &Place| if how == LineUp::Row { place.x } else { place.y };
    items.sort_by(|one, other| along(&one.place).total_cmp(&along(&other.place)));
    let Some(first) = items.iter().map(|item| item.place).min_by(|one, other| one.y.total_cmp(&other.y)) else {
        return Vec::new();
    };
    let mut free = f64::MIN;
    let mut moved = Vec::new();
    for LinedUp { id, place, half, spare } in items {
        let now = match how {
            LineUp::Row => {
                let now = snapped(Place { x: place.x.max(free + half), y: first.y });
                free = now.x + half + spare + GAP;
                now
            }
            LineUp::Column => {
                let now = snapped(Place { x: first.x, y: place.y.max(free) });
                free = now.y + LEVEL;
                now
            }
        };
        let by = (now.x - place.x, now.y - place.y);
        moved.extend(inside(behaviour, places, &id, by));
        if behaviour.groups().all(|(group, _)| *group != id) || behaviour.place(&id).is_some() {
            moved.push((id, now));
        }
    }
    moved
}

/// The streams of a group, so far from where they are.
fn inside(behaviour: &Behaviour, places: &BTreeMap<Id, Place>, id: &Id, by: (f64, f64)) -> Vec<(Id, Place)> {
    let group = behaviour.groups().find(|(group, _)| *group == id);
    let streams = group.into_iter().flat_map(|(_, group)| members(behaviour, group));
    let moved = |id: &Id| places.get(id).map(|at| (id.clone(), Place { x: at.x + by.0, y: at.y + by.1 }));
    streams.filter_map(moved).collect()
}

#[cfg(test)]
#[path = "several_tests.rs"]
mod tests;
