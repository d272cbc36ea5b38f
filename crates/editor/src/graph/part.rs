//! A part of a program as a text: copied, and put in elsewhere. Pure.

use super::grouping::members;
use crate::Selected;
use crate::build::free_name;
use crate::layout::{CHIP_HEIGHT, DrawnSizes, GAP, Ground, STREAM_HEIGHT, VALUE_ROOM, snapped};
use behaviour::{
    Behaviour, Change, Connector, FillFrom, Group, Helper, Id, Kind, Place, Procedure, Record, RecordId, Stream,
    numbered,
};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// The mark at the beginning of the text of a part of a program.
const FORMAT: &str = "rrp-part/1";
/// The largest text that is put in, in bytes.
const TEXT_MAX_BYTES: usize = 200 << 10;
/// The distance between the places that are tried for a copy, and the number of them to the right and down.
const STEP: f64 = 60.0;
const STEPS_MAX: i32 = 40;

/// A part of a program as a text: its records, and the helpers that they use.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProgramPart {
    format: String,
    records: Behaviour,
    helpers: Vec<Helper>,
}

impl ProgramPart {
    /// The streams, connectors and notes among these, the connectors between the streams, the groups of which all streams
    /// are among them, and where everything stands.
    pub fn of(
        behaviour: &Behaviour,
        places: &BTreeMap<Id, Place>,
        of: &BTreeSet<Selected>,
        helpers: &[Helper],
    ) -> Self {
        let mut records = Behaviour::default();
        let mut put = |kind, id: &Id, record| drop(records.records.insert(RecordId::new(kind, id), record));
        let mut used = BTreeSet::new();
        let has = |id: &Id| of.contains(&Selected::Stream(id.clone()));
        for (id, stream) in behaviour.streams().filter(|(id, _)| has(id)) {
            put(Kind::Stream, id, Record::Stream(stream.clone()));
            if let Some(place) = places.get(id) {
                put(Kind::Place, id, Record::Place(*place));
            }
        }
        for (id, connector) in behaviour.connectors() {
            let whole = has(&connector.output) && connector.inputs.iter().any(has);
            if whole || (of.contains(&Selected::Connector(id.clone())) && has(&connector.output)) {
                put(Kind::Connector, id, Record::Connector(connector.clone()));
                if let Some(Procedure::Helper(name)) = connector.operation.procedure() {
                    used.insert(name.clone());
                }
            }
        }
        for (id, note) in behaviour.notes().filter(|(id, _)| of.contains(&Selected::Note((*id).clone()))) {
            put(Kind::Note, id, Record::Note(note.clone()));
            if let Some(place) = places.get(id) {
                put(Kind::Place, id, Record::Place(*place));
            }
        }
        for (id, group) in behaviour.groups() {
            let streams: BTreeSet<Id> = members(behaviour, group).cloned().filled();
            if !streams.is_empty() && streams.iter().all(has) {
                put(Kind::Group, id, Record::Group(Group { streams, ..group.clone() }));
                if let Some(place) = behaviour.place(id) {
                    put(Kind::Place, id, Record::Place(place));
                }
            }
        }
        let helpers = helpers.iter().filter(|helper| used.contains(&helper.name)).cloned().collect();
        Self { format: FORMAT.to_owned(), records, helpers }
    }

    /// Read from a text by `read`, if it is one.
    pub fn read<'a>(text: &'a str, read: impl FnOnce(&'a str) -> serde_json::Result<Self>) -> Option<Self> {
        let text = Some(text.trim()).filter(|text| text.len() <= TEXT_MAX_BYTES && text.starts_with('{'))?;
        read(text).ok().filter(|part| part.format == FORMAT)
    }

    /// Returns the part as a text.
    pub fn text(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }

    /// True if something that was chosen is in it: a connector is only with the stream that it leads to.
    pub fn holds(&self, what: &Selected) -> bool {
        self.records.records.contains_key(&what.record())
    }

    /// Fits the part to a library: a helper that the library knows under another name is used under that, and one whose
    /// name it has with another meaning gets a free one. Returns with it the helpers that the library is to get.
    pub fn for_library(mut self, known: &[Helper]) -> (Self, Vec<Helper>) {
        let mut new: Vec<Helper> = Vec::new();
        let mut names = BTreeMap::new();
        for helper in std::mem::take(&mut self.helpers) {
            let all: Vec<Helper> = known.iter().chain(&new).cloned().collect();
            let name = name_in(&helper, &all).unwrap_or_else(|| {
                let is_free = |name: &String| all.iter().all(|other| other.name != *name);
                numbered(&helper.name, "_").find(is_free).unwrap_or_else(|| helper.name.clone())
            });
            if all.iter().all(|other| other.name != name) {
                new.push(Helper { name: name.clone(), ..helper.clone() });
            }
            names.insert(helper.name, name);
        }
        for record in self.records.records.values_mut() {
            if let Record::Connector(connector) = record
                && let Some(Procedure::Helper(name)) = connector.operation.procedure_mut()
                && let Some(other) = names.get(name)
            {
                name.clone_from(other);
            }
        }
        (self, new)
    }

    /// True if there is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.records.streams().next().is_none() && self.records.notes().next().is_none()
    }

    /// Put into a behaviour under new ids and free names, so far from where it was: the change, and what it
    /// makes that is chosen then. A connector takes from streams outside of the part where they are there.
    pub fn into(
        self,
        behaviour: &Behaviour,
        change: Change,
        shift: (f64, f64),
        mut new_id: impl FnMut() -> Id,
    ) -> (Change, BTreeSet<Selected>) {
        let ids: BTreeMap<Id, Id> = self.records.streams().map(|(id, _)| (id.clone(), new_id())).filled();
        let mut after = behaviour.clone();
        let (mut change, aside) = self.aside(behaviour, change, (&ids, shift), &mut new_id);
        let mut order = behaviour.next_order();
        for (id, stream) in self.records.streams_in_order() {
            let new = &ids[id];
            let stream = Stream { name: free_name(&after, &stream.name), order, ..stream.clone() };
            order += 1;
            after.records.insert(RecordId::new(Kind::Stream, new), Record::Stream(stream.clone()));
            change = change.put(behaviour, RecordId::new(Kind::Stream, new), Record::Stream(stream));
            if let Some(place) = self.records.place(id) {
                let place = snapped(Place { x: place.x + shift.0, y: place.y + shift.1 });
                change = change.put(behaviour, RecordId::new(Kind::Place, new), Record::Place(place));
            }
        }
        for (_, connector) in self.records.connectors_in_order() {
            if let Some(connector) = self.connector(connector, &ids, &after, order) {
                order += 1;
                let id = RecordId::new(Kind::Connector, &new_id());
                change = change.put(behaviour, id, Record::Connector(connector));
            }
        }
        let grouped = |id: &Id| self.records.group_of(id).is_some_and(|(_, group)| group.folded);
        let seen = ids.iter().filter(|(old, _)| !grouped(old)).map(|(_, new)| Selected::Stream(new.clone()));
        (change, seen.chain(aside).collect())
    }

    /// The notes and groups of the part put in: the change, and the notes and folded groups that it makes.
    fn aside(
        &self,
        behaviour: &Behaviour,
        mut change: Change,
        (ids, shift): (&BTreeMap<Id, Id>, (f64, f64)),
        new_id: &mut impl FnMut() -> Id,
    ) -> (Change, Vec<Selected>) {
        let mut made = Vec::new();
        let notes = self.records.notes().map(|(id, note)| (id, Record::Note(note.clone())));
        let groups = self.records.groups().map(|(id, group)| {
            let streams = group.streams.iter().filter_map(|id| ids.get(id).cloned()).collect();
            (id, Record::Group(Group { streams, ..group.clone() }))
        });
        for (old, record) in notes.chain(groups) {
            let id = new_id();
            if let Some(place) = self.records.place(old) {
                let place = snapped(Place { x: place.x + shift.0, y: place.y + shift.1 });
                change = change.put(behaviour, RecordId::new(Kind::Place, &id), Record::Place(place));
            }
            let chosen = match &record {
                Record::Note(_) => Some(Selected::Note(id.clone())),
                Record::Group(group) if group.folded => Some(Selected::Group(id.clone())),
                _ => None,
            };
            made.extend(chosen);
            change = change.put(behaviour, RecordId::new(record.kind(), &id), record);
        }
        (change, made)
    }

    /// Returns the shift that brings its middle and its top to a place.
    pub fn to(&self, at: Place, sizes: DrawnSizes) -> (f64, f64) {
        let rooms = self.rooms(sizes);
        let places = rooms.iter().map(|(place, _)| place);
        if rooms.is_empty() {
            return (0.0, 0.0);
        }
        let top = places.clone().map(|place| place.y).fold(f64::MAX, f64::min);
        (at.x - places.map(|place| place.x).sum::<f64>() / rooms.len() as f64, at.y - top)
    }

    /// The shortest way to the right or down to where it covers nothing that stands in a behaviour.
    pub fn to_free(&self, Ground { behaviour, places, sizes }: Ground) -> (f64, f64) {
        let Some(own) = self.rooms(sizes).into_iter().map(|(_, room)| room).reduce(TakenRoom::and) else {
            return (0.0, 0.0);
        };
        let place = |id: &Id| places.get(id).copied();
        let taken: Vec<TakenRoom> = rooms(behaviour, sizes, place).into_iter().map(|(_, room)| room).collect();
        let (width, height) = (own.right - own.left + GAP, own.bottom - own.top + GAP);
        let step = |start: f64, number: i32| start + f64::from(number) * STEP;
        let ways = (0..STEPS_MAX).flat_map(|number| [(step(width, number), 0.0), (0.0, step(height, number))]);
        let mut ways: Vec<(f64, f64)> = ways.collect();
        // Beside is nearer than below: graphs grow down.
        let far = |way: &(f64, f64)| way.0 + 1.5 * way.1;
        ways.sort_by(|one, other| far(one).total_cmp(&far(other)));
        let is_free = |way: &(f64, f64)| taken.iter().all(|other| !own.shifted(*way).meets(other));
        let right = taken.iter().map(|other| other.right).fold(own.left, f64::max) - own.left + GAP;
        ways.into_iter().find(is_free).unwrap_or((right, 0.0))
    }

    /// Returns the places of its streams and notes, and the room that they take.
    fn rooms(&self, sizes: DrawnSizes) -> Vec<(Place, TakenRoom)> {
        rooms(&self.records, sizes, |id| self.records.place(id))
    }

    fn connector(&self, old: &Connector, ids: &BTreeMap<Id, Id>, after: &Behaviour, order: i64) -> Option<Connector> {
        let there = |id: &Id| ids.get(id).or_else(|| after.stream(id).map(|_| id)).cloned();
        let inputs: Vec<Id> = old.inputs.iter().filter_map(there).collect();
        if inputs.is_empty() {
            return None;
        }
        let mut new = Connector { inputs, output: ids.get(&old.output)?.clone(), order, ..old.clone() };
        if let Some(Procedure::Body { body, args: None }) = old.operation.procedure()
            && old.inputs.len() == new.inputs.len()
        {
            let mut both = after.clone();
            for (id, stream) in self.records.streams() {
                both.records.insert(RecordId::new(Kind::Stream, id), Record::Stream(stream.clone()));
            }
            let body = behaviour::rename_identifiers(body, &both.arguments(old), &both.arguments(&new));
            if let Some(procedure) = new.operation.procedure_mut() {
                *procedure = Procedure::body(&body);
            }
        }
        Some(new)
    }
}

/// Returns the name of a helper among others, if one of them does the same, whatever is said of it; its own name first.
fn name_in(helper: &Helper, all: &[Helper]) -> Option<String> {
    let is_same = |other: &&Helper| {
        let named = Helper { name: other.name.clone(), says: other.says.clone(), ..helper.clone() };
        named == **other
    };
    all.iter().filter(is_same).map(|other| &other.name).max_by_key(|name| **name == helper.name).cloned()
}

/// Room that something takes.
#[derive(Clone, Copy)]
struct TakenRoom {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl TakenRoom {
    fn and(self, other: TakenRoom) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    fn shifted(self, (dx, dy): (f64, f64)) -> Self {
        Self { left: self.left + dx, top: self.top + dy, right: self.right + dx, bottom: self.bottom + dy }
    }

    fn meets(self, other: &TakenRoom) -> bool {
        self.left < other.right && self.right > other.left && self.top < other.bottom && self.bottom > other.top
    }
}

/// Returns the places of a behaviour's streams and notes, and the room that they take: a stream with its value and the
/// chip above it.
fn rooms(behaviour: &Behaviour, sizes: DrawnSizes, place: impl Fn(&Id) -> Option<Place>) -> Vec<(Place, TakenRoom)> {
    let room = |place: Place, half: f64, (above, right, below): (f64, f64, f64)| TakenRoom {
        left: place.x - half,
        top: place.y - above,
        right: place.x + half + right,
        bottom: place.y + below,
    };
    let streams = behaviour.streams().filter_map(|(id, stream)| {
        let place = place(id)?;
        Some((place, room(place, (sizes.stream)(stream) / 2.0, (CHIP_HEIGHT + GAP, VALUE_ROOM, STREAM_HEIGHT))))
    });
    let notes = behaviour.notes().filter_map(|(id, note)| {
        let (place, (width, height)) = (place(id)?, (sizes.note)(&note.text));
        Some((place, room(place, width / 2.0, (0.0, 0.0, height))))
    });
    streams.chain(notes).collect()
}

#[cfg(test)]
#[path = "part_tests.rs"]
mod tests;
