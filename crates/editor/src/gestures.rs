//! Gestures on the graph: each builds one change with a label, under the name that its caller gives, and proposes it.

use crate::conflict::beside;
use crate::editor::after::AfterSaving;
use crate::effect::Announcement;
use crate::graph::{self, ConnectPlan, Ghost, LineUp, Output, ProgramPart, WireEnd, grouping, rewire};
use crate::layout::{Ground, Tidy};
use crate::{Editor, Selected, build};
use behaviour::labels;
use behaviour::{
    Behaviour, Change, Connector, FillFrom, Helper, Id, Kind, Operation, Params, Place, Record, RecordId, Settings,
    Stream,
};
use phrase::{Phrase, Phrased, phrase};
use std::collections::{BTreeMap, BTreeSet};

/// The most places that fit in one change and its message.
const MOVES_MAX: usize = 800;
/// The number of letters of a name in a label.
const LABEL_CHARS_MAX: usize = 60;

/// The place where a part of a program is put.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Put {
    /// There.
    At(Place),
    /// Beside what it was copied from, where nothing stands.
    Beside,
}

/// Returns a name as it stands in the label of a change.
#[must_use]
pub fn short(name: &str) -> String {
    name.chars().take(LABEL_CHARS_MAX).collect()
}

impl Editor {
    fn start(&self, op: Id, label: Phrase) -> Change {
        Change::of(op, &self.me.name, label)
    }

    fn built(&mut self, build: impl FnOnce(Ground) -> Change) -> Change {
        let (behaviour, places) = self.ground();
        build(Ground { behaviour: &behaviour, places: &places, sizes: self.places.sizes })
    }

    /// A new sense: at a place, or where there is room in the top row. It is selected once it is there.
    pub fn add_sensor(&mut self, op: Id, (device, name): (&str, &str), params: Params, at: Option<Place>) {
        let (id, start) = (self.next_id(), self.start(op, labels::add(name)));
        let change = self.built(|ground| graph::sensor(ground, start, (&id, device, name, params), at));
        self.propose_then(change, AfterSaving::Choose(alone(Selected::Stream(id))));
    }

    /// A new connector; the stream it leads to is selected once it is there.
    pub fn connect(&mut self, op: Id, plan: ConnectPlan) {
        let (stream, connector) = (self.next_id(), self.next_id());
        let select = match &plan.output {
            Output::New { .. } => stream.clone(),
            Output::Existing(id) => id.clone(),
        };
        let start = self.start(op, labels::add(plan.operation.spec().phrase()));
        let change = self.built(|ground| graph::connected(ground, start, (&stream, &connector), plan));
        self.propose_then(change, AfterSaving::Choose(alone(Selected::Stream(select))));
    }

    /// A new connector and another one out of what it makes, as one change; the last stream is selected once it is there.
    pub fn connect_twice(&mut self, op: Id, first: ConnectPlan, then: ConnectPlan) {
        let [between, connector, stream, last] = [(); 4].map(|()| self.next_id());
        let start = self.start(op, labels::add(then.operation.spec().phrase()));
        let ids = [(&between, &connector), (&stream, &last)];
        let change = self.built(|ground| graph::connected_twice(ground, start, ids, (first, then)));
        self.propose_then(change, AfterSaving::Choose(alone(Selected::Stream(stream))));
    }

    /// Leads a stream to where its wire ends, as one change; what it ends at is selected then.
    pub fn wire(&mut self, op: Id, from: &Id, end: &WireEnd) {
        let name = self.stream_name(from);
        let (start, ids) = (self.start(op, labels::connect(short(&name))), (self.next_id(), self.next_id()));
        let change = self.built(|ground| rewire::wired(ground, start, (&ids.0, &ids.1), (from, end)));
        let (before, what) = (self.chosen(), end.selected());
        self.propose_then(change, AfterSaving::SelectUnlessOther { before, what });
    }

    fn stream_name(&self, id: &Id) -> String {
        match self.shown(&RecordId::new(Kind::Stream, id)) {
            Some(Record::Stream(stream)) => stream.name,
            _ => String::new(),
        }
    }

    /// Adds what was shown of a typed sentence, as one change; it is chosen then.
    pub fn put_ghost(&mut self, op: Id, ghost: Ghost) {
        let (behaviour, start) =
            (self.shown_behaviour(), self.start(op, labels::add(phrase!("thing.sentence", "a sentence"))));
        let (change, streams) = ghost.into(&behaviour, start, || self.next_id());
        self.propose_then(change, AfterSaving::Choose(streams.into_iter().map(Selected::Stream).collect()));
    }

    /// Removes a stream of a way and joins what is above it with what is below, as one change.
    pub fn remove_and_heal(&mut self, op: Id, id: &Id) {
        let (behaviour, name) = (self.shown_behaviour(), self.stream_name(id));
        let change = rewire::healed(&behaviour, self.start(op, labels::remove(short(&name))), id);
        self.propose(grouping::without_empty(&behaviour, change));
    }

    /// Another operation or other inputs of a connector; `output_name` renames the output stream in the same change. A name that
    /// nobody typed follows. `seen` is what its author saw when they began.
    pub fn edit_connector(
        &mut self,
        op: Id,
        (id, seen): (&Id, Connector),
        (operation, inputs): (Operation, Vec<Id>),
        output_name: Option<&str>,
    ) {
        let (behaviour, start) = (self.shown_behaviour(), self.start(op, labels::edit(operation.spec().phrase())));
        let followed = self.followed_name(&behaviour, &seen, &operation, &inputs).filter(|_| output_name.is_none());
        let name = output_name.or(followed.as_deref());
        let change = build::connector_edited(&behaviour, start, (id, &seen), (operation, inputs), name);
        self.propose(build::as_seen(change, Kind::Connector, id, Record::Connector(seen)));
    }

    /// Returns the new name of what passes a test or comes at a beat, if it was called after that and nobody typed a name since.
    fn followed_name(
        &self,
        behaviour: &Behaviour,
        seen: &Connector,
        operation: &Operation,
        inputs: &[Id],
    ) -> Option<String> {
        let spec = operation.spec();
        if !spec.is_test() && spec.takes.period.is_none() {
            return None;
        }
        let name = &behaviour.stream(&seen.output)?.name;
        let edited = Connector { operation: operation.clone(), inputs: inputs.to_vec(), ..seen.clone() };
        (self.follow)(behaviour, name, seen, &edited).map(|name| build::free_name(behaviour, &name))
    }

    /// Another name or other settings of a stream; bodies that use its old argument name follow in the same change. The server
    /// refuses if it is not as `seen` any more; what somebody else changed beside it meanwhile stays as they have it.
    pub fn edit_stream(&mut self, op: Id, (id, seen): (&Id, Stream), stream: Stream) {
        let behaviour = self.shown_behaviour();
        let both = behaviour.stream(id).and_then(|now| Some((now.clone(), beside(&seen, &stream, now)?)));
        let (seen, stream) = both.unwrap_or((seen, stream));
        let label = if seen.name == stream.name { labels::edit } else { labels::rename };
        let start = self.start(op, label(short(&seen.name)));
        let change = build::stream_edited(&behaviour, start, id, stream);
        self.propose(build::as_seen(change, Kind::Stream, id, Record::Stream(seen)));
    }

    /// A stream goes with its connectors, a group with its streams.
    pub fn remove(&mut self, op: Id, what: &Selected) {
        let behaviour = self.shown_behaviour();
        let label = match what {
            Selected::Stream(id) => short(behaviour.stream(id).map_or("", |stream| &stream.name)).into(),
            Selected::Connector(id) => {
                let gone = || phrase!("thing.connector", "connector");
                behaviour.connector(id).map_or_else(gone, |connector| connector.operation.spec().phrase())
            }
            Selected::Note(_) => a_note(),
            Selected::Group(id) => self.shown_group(id).map(|group| short(&group.title)).unwrap_or_default().into(),
        };
        let start = self.start(op, labels::remove(label));
        self.propose(graph::without(&behaviour, start, &alone(what.clone())));
    }

    /// Removes several, as one change.
    pub fn remove_several(&mut self, op: Id, of: &BTreeSet<Selected>) {
        let start = self.start(op, labels::remove(of.len().to_string()));
        let change = graph::without(&self.shown_behaviour(), start, of);
        self.choose(BTreeSet::new());
        self.propose(change);
    }

    /// Streams, notes and boxes somewhere else; as one change, unless they are too many for one.
    pub fn move_to(&mut self, places: &[(Id, Place)]) {
        self.move_as(&labels::moved(), places);
    }

    fn move_as(&mut self, label: &Phrase, places: &[(Id, Place)]) {
        let behaviour = self.shown_behaviour();
        for some in places.chunks(MOVES_MAX) {
            let op = self.next_id();
            let change = build::moved(&behaviour, self.start(op, label.clone()), some);
            self.propose_moved(change, some, None);
        }
    }

    /// Streams somewhere else, in an open group from then on, as one change; only moved if that group is gone by now.
    pub fn move_into(&mut self, places: &[(Id, Place)], group: &Id) {
        let Some(title) = self.shown_group(group).map(|group| group.title) else { return self.move_to(places) };
        let (behaviour, op) = (self.shown_behaviour(), self.next_id());
        let moved = build::moved(&behaviour, self.start(op, labels::move_into(short(&title))), places);
        let chosen = places.iter().map(|(id, _)| Selected::Stream(id.clone())).chain([Selected::Group(group.clone())]);
        match grouping::grouped(&behaviour, moved, &chosen.filled(), (group, &title)) {
            Some((change, _)) => self.propose_moved(change, places, Some(title)),
            None => self.move_to(places),
        }
    }

    fn propose_moved(&mut self, change: Change, places: &[(Id, Place)], into: Option<String>) {
        let ids = places.iter().map(|(id, _)| id.clone()).collect();
        self.propose_then(change, AfterSaving::Moved { ids, into });
    }

    /// Lays everything out afresh.
    pub fn tidy(&mut self, tidy: Tidy) {
        let places: Vec<_> = tidy(&self.shown_behaviour(), self.places.stage).into_iter().collect();
        self.move_as(&labels::tidied(), &places);
    }

    /// Lines up several streams, notes and folded groups.
    pub fn line_up(&mut self, of: &BTreeSet<Selected>, how: LineUp) {
        let (behaviour, places) = self.whole_ground();
        let ground = Ground { behaviour: &behaviour, places: &places, sizes: self.places.sizes };
        let moved = graph::lined_up(ground, of, how);
        self.move_as(&labels::aligned(), &moved);
    }

    /// Another name of the open program; `seen` is what its author saw when they began.
    pub fn rename_program(&mut self, op: Id, seen: Settings, name: &str) {
        let change = build::renamed(&self.shown_behaviour(), self.start(op, labels::program_renamed()), name);
        self.propose(build::as_seen_at(change, &RecordId::settings(), Record::Settings(seen)));
    }

    /// Returns a part of what is shown, with the helpers of the library that it uses.
    pub fn part(&mut self, of: &BTreeSet<Selected>, helpers: &[Helper]) -> ProgramPart {
        let (behaviour, places) = self.whole_ground();
        ProgramPart::of(&behaviour, &places, &grouping::expanded(&behaviour, of), helpers)
    }

    /// Puts a part into the open program, as one change; helpers that are not in the library go there first. What was put in is
    /// chosen then.
    pub fn put_in(&mut self, op: Id, part: ProgramPart, put: Put, known: &[Helper]) {
        let (part, new) = part.for_library(known);
        new.into_iter().for_each(|helper| self.add_helper(helper));
        let (behaviour, places) = self.whole_ground();
        let shift = self.shift_of(&part, put, (&behaviour, &places));
        let start = self.start(op, labels::pasted());
        let (change, made) = part.into(&behaviour, start, shift, || self.next_id());
        self.propose_then(change, AfterSaving::Choose(made));
    }

    fn shift_of(
        &self,
        part: &ProgramPart,
        put: Put,
        (behaviour, places): (&Behaviour, &BTreeMap<Id, Place>),
    ) -> (f64, f64) {
        match put {
            Put::At(place) => part.to(place, self.places.sizes),
            Put::Beside => part.to_free(Ground { behaviour, places, sizes: self.places.sizes }),
        }
    }

    fn add_helper(&mut self, helper: Helper) {
        let (op, id) = (self.next_id(), self.next_id());
        let start = self.start(op, labels::helper(short(&helper.name)));
        self.propose_to_library(build::helper_put(&Behaviour::default(), start, &id, helper));
    }

    /// Makes a group of what is chosen, called `base` or that with a number, and selects it.
    pub fn make_group(&mut self, op: Id, of: &BTreeSet<Selected>, base: &str) {
        let (behaviour, new) = (self.shown_behaviour(), self.next_id());
        let title = free_title(&behaviour, base);
        let start = self.start(op, labels::group(&title));
        match grouping::grouped(&behaviour, start, of, (&new, &title)) {
            Some((change, id)) => self.propose_then(change, AfterSaving::Choose(alone(Selected::Group(id)))),
            None => self.say(Announcement::NothingToGroup),
        }
    }

    /// The groups among these go and their streams stay; the streams among these leave their groups.
    pub fn ungroup(&mut self, op: Id, of: &BTreeSet<Selected>) {
        let behaviour = self.shown_behaviour();
        let group = |one: &Selected| match one {
            Selected::Group(id) => behaviour.groups().find(|(group, _)| *group == id),
            Selected::Stream(id) => behaviour.group_of(id),
            Selected::Connector(_) | Selected::Note(_) => None,
        };
        let Some((_, first)) = of.iter().find_map(group) else { return self.say(Announcement::InNoGroup) };
        let start = self.start(op, labels::ungroup(short(&first.title)));
        let change = grouping::ungrouped(&behaviour, start, of);
        let inside = grouping::expanded(&behaviour, of).into_iter();
        let streams = inside.filter(|one| matches!(one, Selected::Stream(_))).collect();
        self.propose_then(change, AfterSaving::Choose(streams));
    }

    /// Another title of a group; `seen` is what its author saw when they began. Who only put streams into it meanwhile, or folded
    /// it, is in nobody's way.
    pub fn retitle(&mut self, op: Id, id: &Id, seen: behaviour::Group, title: &str) {
        let title = title.trim();
        if title.is_empty() || title == seen.title {
            return;
        }
        let (behaviour, key) = (self.shown_behaviour(), RecordId::new(Kind::Group, id));
        let seen = self.shown_group(id).filter(|now| now.title == seen.title).unwrap_or(seen);
        let mine = behaviour::Group { title: title.to_owned(), ..seen.clone() };
        let start = self.start(op, labels::rename(short(&seen.title)));
        let change = start.put(&behaviour, key, Record::Group(mine));
        self.propose(build::as_seen(change, Kind::Group, id, Record::Group(seen)));
    }

    /// Folds a group for everybody, or unfolds it. Who may not edit unfolds it here only.
    pub fn fold(&mut self, op: Id, id: &Id, folded: bool) {
        let Some(group) = self.shown_group(id) else { return };
        if group.folded == folded {
            if self.folds.opened.remove(id) {
                self.see_groups();
            }
            return;
        }
        if self.me.refused.is_some() && group.folded {
            return self.unfold_here(id);
        }
        let label = if folded { labels::fold } else { labels::unfold };
        let start = self.start(op, label(short(&group.title)));
        self.propose(grouping::edited(&self.shown_behaviour(), start, id, |group| group.folded = folded));
    }

    /// A new note with its place; gives its id.
    pub fn add_note(&mut self, op: Id, text: &str, at: Place) -> Id {
        let (id, behaviour, start) = (self.next_id(), self.shown_behaviour(), self.start(op, labels::add(a_note())));
        let change = start.put(&behaviour, RecordId::new(Kind::Note, &id), self.written(text));
        let place = Record::Place(crate::layout::snapped(at));
        self.propose(change.put(&behaviour, RecordId::new(Kind::Place, &id), place));
        id
    }

    /// Another text of a note; `seen` is what its author saw when they began.
    pub fn edit_note(&mut self, op: Id, id: &Id, seen: behaviour::Note, text: &str) {
        let start = self.start(op, labels::edit(a_note()));
        let change = start.put(&self.shown_behaviour(), RecordId::new(Kind::Note, id), self.written(text));
        self.propose(build::as_seen(change, Kind::Note, id, Record::Note(seen)));
    }

    /// Removes a note that nothing is left of, if it is still as its author saw it.
    pub fn remove_note(&mut self, op: Id, id: &Id, seen: behaviour::Note) {
        let what = alone(Selected::Note(id.clone()));
        let change = graph::without(&self.shown_behaviour(), self.start(op, labels::remove(a_note())), &what);
        self.propose(build::as_seen(change, Kind::Note, id, Record::Note(seen)));
    }

    /// Returns the note as it is written here and now.
    fn written(&self, text: &str) -> Record {
        let (text, by, at_ms) = (text.to_owned(), self.me.name.clone(), self.now.today_ms as u64);
        Record::Note(behaviour::Note { text, by, at_ms })
    }
}

fn alone(one: Selected) -> BTreeSet<Selected> {
    std::iter::once(one).filled()
}

/// A note, as a change to one says it.
fn a_note() -> Phrase {
    phrase!("thing.note", "note")
}

fn free_title(behaviour: &Behaviour, base: &str) -> String {
    let taken = |title: &String| behaviour.groups().any(|(_, group)| group.title == *title);
    behaviour::numbered(base, " ").find(|title| !taken(title)).unwrap_or_else(|| base.to_owned())
}
