//! The places of everything on this page: as they are saved, else a free spot for as long as the page is open. And a program of
//! the past that is shown in place of the open one, only to look at.

use crate::layout::{self, DrawnSizes, Tidy, snapped};
use crate::{Editor, Selected};
use behaviour::{Behaviour, Change, Edit, FillFrom, Group, Id, Kind, Place, Record, RecordId};
use std::collections::{BTreeMap, BTreeSet};

/// The distance to the left of the graph at which a note stands that nobody placed, and below the one before.
const APART: (f64, f64) = (320.0, 140.0);

/// The places that nobody chose, and what they come of.
#[derive(Debug)]
pub(crate) struct ShownPlaces {
    /// The sizes of what is drawn on this page.
    pub(crate) sizes: DrawnSizes,
    /// The places of streams and notes that nobody placed.
    free: BTreeMap<Id, Place>,
    /// Lays out a behaviour in which nobody placed anything; comes later.
    tidy: Option<Tidy>,
    /// The width and height in which all of it shall be seen.
    pub(crate) stage: (f64, f64),
}

impl ShownPlaces {
    pub(crate) fn new(sizes: DrawnSizes) -> Self {
        Self { sizes, free: BTreeMap::new(), tidy: None, stage: (0.0, 0.0) }
    }

    fn missing(&self, behaviour: &Behaviour) -> BTreeMap<Id, Place> {
        layout::missing_places(behaviour, self.sizes, (self.tidy, self.stage))
    }

    /// Another program is open: its streams get their spots anew.
    pub(crate) fn begin_anew(&mut self, behaviour: &Behaviour) {
        self.free = self.missing(behaviour);
    }
}

impl Editor {
    /// Returns the program that is shown: the open one with what waits to be sent, or one of the past.
    #[must_use]
    pub fn shown_behaviour(&self) -> Behaviour {
        self.past.clone().unwrap_or_else(|| self.behaviour())
    }

    /// Returns a record of what is shown.
    #[must_use]
    pub fn shown(&self, key: &RecordId) -> Option<Record> {
        match &self.past {
            Some(past) => past.records.get(key).cloned(),
            None => self.record(key),
        }
    }

    /// Looks at what is shown as the server has it.
    #[must_use]
    pub fn shown_saved(&self) -> &Behaviour {
        self.past.as_ref().unwrap_or(&self.confirmed)
    }

    /// Shows the records of another program in place of the open one, only to look at; with none the open one again.
    pub fn show_past(&mut self, past: Option<Behaviour>) {
        if past.is_none() && self.past.is_none() {
            return;
        }
        let before = std::mem::replace(&mut self.past, past);
        let shown = self.past.as_ref().unwrap_or(&self.confirmed);
        for (id, place) in self.places.missing(shown) {
            self.places.free.entry(id).or_insert(place);
        }
        let open = self.behaviour();
        let all = [before.as_ref(), self.past.as_ref(), Some(&open)];
        let touched: BTreeSet<RecordId> =
            all.into_iter().flatten().flat_map(|one| one.records.keys().cloned()).filled();
        let placed: Vec<RecordId> = touched.iter().map(|id| RecordId::new(Kind::Place, &id.id)).collect();
        self.touch(touched.into_iter().chain(placed));
    }

    /// Puts another program of the past, or none, in place of the one that is looked at, and says nothing of it.
    pub fn swap_past(&mut self, past: Option<Behaviour>) -> Option<Behaviour> {
        std::mem::replace(&mut self.past, past)
    }

    /// Lays out with `tidy` what nobody placed, from now on: it may come later than the behaviour that needs it. Returns true
    /// if anything stands elsewhere by that.
    pub fn lay_out_with(&mut self, tidy: Tidy) -> bool {
        self.places.tidy = Some(tidy);
        let ids: Vec<Id> = self.confirmed.streams().map(|(id, _)| id.clone()).collect();
        let is_free = !ids.is_empty() && ids.iter().all(|id| self.confirmed.place(id).is_none());
        if is_free {
            self.places.begin_anew(&self.confirmed);
            self.touch(ids.iter().map(|id| RecordId::new(Kind::Place, id)));
        }
        is_free
    }

    /// Tells the width and height of the stage that are free: the next layout fits it. A stream that stands already stays.
    pub fn tell_stage(&mut self, free: (f64, f64)) {
        self.places.stage = free;
    }

    /// Returns places for the streams of a behaviour that nobody placed.
    #[must_use]
    pub fn missing_places(&self, behaviour: &Behaviour) -> BTreeMap<Id, Place> {
        self.places.missing(behaviour)
    }

    /// Returns a change with places for the streams that it makes and places nowhere, and, where nobody placed any stream yet,
    /// for all: what is laid out by itself would not make room.
    #[must_use]
    pub fn with_room(&self, change: Change) -> Change {
        let makes_streams = |edit: &Edit| edit.id.kind == Kind::Stream && edit.before.is_none();
        if !change.edits.iter().any(makes_streams) {
            return change;
        }
        let behaviour = self.shown_behaviour();
        let mut after = behaviour.clone();
        after.apply(&change);
        let put = |change: Change, (id, place): (Id, Place)| {
            change.put(&behaviour, RecordId::new(Kind::Place, &id), Record::Place(place))
        };
        self.missing_places(&after).into_iter().fold(change, put)
    }

    /// Returns the place where something that is shown was put.
    #[must_use]
    pub fn put_at(&self, id: &Id) -> Option<Place> {
        match &self.past {
            Some(past) => past.place(id),
            None => self.saved_place(id),
        }
    }

    /// Returns the place of a stream; a stream that nobody placed gets a free spot for as long as this page is open.
    pub fn stream_place(&mut self, id: &Id) -> Place {
        if let Some(place) = self.put_at(id).or_else(|| self.places.free.get(id).copied()) {
            return place;
        }
        let place = self.places.missing(&self.confirmed).get(id).copied().unwrap_or(Place { x: 0.0, y: 0.0 });
        self.places.free.insert(id.clone(), place);
        place
    }

    /// Returns the place of a note; one that nobody placed stands left of the graph.
    pub fn note_place(&mut self, id: &Id) -> Place {
        if let Some(place) = self.put_at(id).or_else(|| self.places.free.get(id).copied()) {
            return place;
        }
        let shown = self.shown_behaviour();
        let before = shown.notes().filter(|(note, _)| self.places.free.contains_key(note)).count();
        let place = self.left_of_graph(&shown, before);
        self.places.free.insert(id.clone(), place);
        place
    }

    /// Returns the place of a new note that nobody places: left of the graph, below the notes that are there.
    pub fn place_for_note(&mut self) -> Place {
        let shown = self.shown_behaviour();
        let many = shown.notes().count();
        self.left_of_graph(&shown, many)
    }

    fn left_of_graph(&mut self, shown: &Behaviour, row: usize) -> Place {
        let ids: Vec<&Id> = shown.streams().map(|(id, _)| id).collect();
        let places = ids.into_iter().map(|id| self.stream_place(id));
        let corner = places.reduce(|one, other| Place { x: one.x.min(other.x), y: one.y.min(other.y) });
        let corner = corner.unwrap_or(Place { x: 0.0, y: 0.0 });
        snapped(Place { x: corner.x - APART.0, y: corner.y + row as f64 * APART.1 })
    }

    /// Returns the place of the box of a group: where it was put, else in the middle of its streams.
    pub fn box_place(&mut self, id: &Id, group: &Group) -> Option<Place> {
        self.put_at(id).or_else(|| {
            let inside: Vec<Place> = self.members(group).iter().map(|id| self.stream_place(id)).collect();
            layout::box_place(&inside)
        })
    }

    /// Returns what is shown, and where its streams stand on this page.
    pub fn ground(&mut self) -> (Behaviour, BTreeMap<Id, Place>) {
        let behaviour = self.shown_behaviour();
        let ids: Vec<Id> = behaviour.streams().map(|(id, _)| id.clone()).collect();
        let places = ids.into_iter().map(|id| (id.clone(), self.stream_place(&id))).filled();
        (behaviour, places)
    }

    /// Returns what is shown, and where everything in it stands: streams, notes, and the boxes of folded groups.
    pub(crate) fn whole_ground(&mut self) -> (Behaviour, BTreeMap<Id, Place>) {
        let (behaviour, mut places) = self.ground();
        for (id, _) in behaviour.notes() {
            places.insert(id.clone(), self.note_place(id));
        }
        for (id, group) in behaviour.groups() {
            if self.folded.contains(id) {
                places.extend(self.box_place(id, group).map(|place| (id.clone(), place)));
            }
        }
        (behaviour, places)
    }

    /// Returns what moves when something is dragged, and where it stands: with one of several that are chosen all of them, with
    /// a group its streams.
    pub fn moving(&mut self, id: &Id) -> Vec<(Id, Place)> {
        let is_one = self.several.iter().any(|one| one.id() == id);
        let others = self.several.iter().map(Selected::id).filter(|other| is_one && *other != id);
        let ids: Vec<Id> = std::iter::once(id).chain(others).cloned().collect();
        let mut seen = BTreeSet::new();
        let mut moving = Vec::new();
        for id in ids {
            let group = self.shown_group(&id);
            let inside = group.as_ref().map_or_else(Vec::new, |group| self.members(group));
            let own = match group {
                Some(_) => self.put_at(&id),
                None => self.stands_at(&id),
            };
            let inside = inside.into_iter().map(|id| (id.clone(), self.stream_place(&id)));
            let all: Vec<(Id, Place)> = inside.chain(own.map(|own| (id, own))).collect();
            moving.extend(all.into_iter().filter(|(id, _)| seen.insert(id.clone())));
        }
        moving
    }

    /// Returns the place of a stream or a note that is shown.
    pub(crate) fn stands_at(&mut self, id: &Id) -> Option<Place> {
        if self.shown(&RecordId::new(Kind::Stream, id)).is_some() {
            return Some(self.stream_place(id));
        }
        self.shown(&RecordId::new(Kind::Note, id)).map(|_| self.note_place(id))
    }

    /// Returns the streams of a group that are there.
    pub(crate) fn members(&self, group: &Group) -> Vec<Id> {
        let is_there = |id: &&Id| self.shown(&RecordId::new(Kind::Stream, id)).is_some();
        group.streams.iter().filter(is_there).cloned().collect()
    }

    /// Returns a group that is shown.
    #[must_use]
    pub fn shown_group(&self, id: &Id) -> Option<Group> {
        match self.shown(&RecordId::new(Kind::Group, id)) {
            Some(Record::Group(group)) => Some(group),
            _ => None,
        }
    }
}
