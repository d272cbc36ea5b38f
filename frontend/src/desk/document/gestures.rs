//! Gestures: each builds one change with a label and proposes it.

use super::{ConnectPlan, Document, Output, Selected, WireEnd, build, conflict, grouping, rewire, several};
use crate::desk::tab::new_id;
use crate::layout::Tidy;
use crate::naming;
use crate::words;
use behaviour::labels;
use behaviour::{
    Behaviour, Change, Connector, FillFrom, Id, Kind, Operation, Params, Place, Record, RecordId, Settings, Stream,
};
use leptos::prelude::*;
use phrase::Phrase;
use protocol::Refused;
use std::collections::BTreeMap;

/// The most places that fit in one change and its message.
const MOVES_MAX: usize = 800;

impl Document {
    /// The first free stream name: "Tracker", then "Tracker 2".
    pub(crate) fn name_for(&self, base: &str) -> String {
        build::free_name(&self.behaviour(), base)
    }

    /// A new sensor stream where there is room in the top row, selected once it is there.
    pub(crate) fn add_sensor(&self, device: &robot::Device, params: Params) {
        self.add_sensor_there(device, params, None);
    }

    /// A new sensor stream at a place, selected once it is there.
    pub(crate) fn add_sensor_at(&self, device: &robot::Device, at: Place) {
        self.add_sensor_there(device, Params::new(), Some(at));
    }

    fn add_sensor_there(&self, device: &robot::Device, params: Params, at: Option<Place>) {
        let (behaviour, places) = self.behaviour_and_places();
        let id = new_id();
        let name = words::device(device);
        let change = self.change(labels::add(name));
        let change = build::sensor(&behaviour, &places, change, (&id, device.name, name, params), at);
        let tab = self.tab.clone();
        self.propose_and(change, self.select_on_yes(id, move |answer| tab.say_refusal(answer)));
    }

    /// A new connector; the stream it leads to is selected once it is there.
    pub(crate) fn connect(&self, plan: ConnectPlan, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let (behaviour, places) = self.behaviour_and_places();
        let (stream, connector) = (new_id(), new_id());
        let select = match &plan.output {
            Output::New { .. } => stream.clone(),
            Output::Existing(id) => id.clone(),
        };
        let change = self.change(labels::add(Phrase::word(plan.operation.word())));
        let change = build::connected(&behaviour, &places, change, (&stream, &connector), plan);
        self.propose_and(change, self.select_on_yes(select, on_answer));
    }

    /// A new connector and another one out of what it makes, as one change; the last stream is selected once it is there.
    pub(crate) fn connect_twice(
        &self,
        first: ConnectPlan,
        then: ConnectPlan,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let (behaviour, places) = self.behaviour_and_places();
        let [between, connector, stream, last] = [(); 4].map(|()| new_id());
        let change = self.change(labels::add(Phrase::word(then.operation.word())));
        let ids = [(&between, &connector), (&stream, &last)];
        let change = build::connected_twice(&behaviour, &places, change, ids, (first, then));
        self.propose_and(change, self.select_on_yes(stream, on_answer));
    }

    /// Leads a stream to where its wire ends, as one change; what it ends at is selected then.
    pub(crate) fn wire(&self, from: &Id, end: &WireEnd) {
        let (behaviour, places) = self.behaviour_and_places();
        let name = behaviour.stream(from).map_or("", |stream| &stream.name);
        let change = self.change(labels::connect(short(name)));
        let change = rewire::wired(&behaviour, &places, change, (&new_id(), &new_id()), (from, end));
        let select = match end {
            WireEnd::Stream(id) => Selected::Stream(id.clone()),
            WireEnd::Connector(id) => Selected::Connector(id.clone()),
        };
        let document = self.clone();
        let before = self.selected.get_untracked();
        self.propose_and(change, move |answer| {
            // Who selected something else meanwhile keeps that.
            if answer.is_ok() && document.selected.get_untracked() == before {
                document.selected.set(Some(select));
            }
            document.tab.say_refusal(answer);
        });
    }

    /// Removes a stream of a way and joins what is above it with what is below, as one change.
    pub(crate) fn remove_and_heal(&self, id: &Id) {
        let behaviour = self.behaviour();
        let name = behaviour.stream(id).map_or("", |stream| &stream.name);
        let change = rewire::healed(&behaviour, self.change(labels::remove(short(name))), id);
        self.propose(grouping::without_empty(&behaviour, change));
    }

    /// The stream that takes the place of a removed one, if its way can be healed, and its name.
    pub(crate) fn healed_by(&self, id: &Id) -> Option<(Id, String)> {
        let behaviour = self.behaviour();
        let above = rewire::healed_by(&behaviour, id)?;
        Some((above.clone(), behaviour.stream(above)?.name.clone()))
    }

    fn select_on_yes(
        &self,
        id: Id,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) -> impl FnOnce(Result<(), Refused>) + 'static {
        let document = self.clone();
        move |answer| {
            if answer.is_ok() && document.stream(&id).is_some() {
                document.selected.set(Some(Selected::Stream(id)));
            }
            on_answer(answer);
        }
    }

    /// Another operation or other inputs; `output_name` renames the output stream in the same change.
    pub(crate) fn edit_connector(
        &self,
        (id, seen): (&Id, Connector),
        operation: Operation,
        inputs: Vec<Id>,
        output_name: Option<&str>,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let change = self.change(labels::edit(Phrase::word(operation.word())));
        let behaviour = self.behaviour();
        let followed = followed_name(&behaviour, &seen, &operation, &inputs).filter(|_| output_name.is_none());
        let name = output_name.or(followed.as_deref());
        let change = build::connector_edited(&behaviour, change, (id, &seen), (operation, inputs), name);
        self.propose_and(build::as_seen(change, Kind::Connector, id, Record::Connector(seen)), on_answer);
    }

    /// Another name or other settings; bodies that use its old argument name follow in the same change.
    /// `seen` is what the person saw when they began; the server refuses if it is not that any more.
    pub(crate) fn edit_stream(
        &self,
        (id, seen): (&Id, Stream),
        stream: Stream,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let behaviour = self.behaviour();
        // What somebody else changed beside it meanwhile stays as they have it.
        let both = behaviour.stream(id).and_then(|now| Some((now.clone(), conflict::beside(&seen, &stream, now)?)));
        let (seen, stream) = both.unwrap_or((seen, stream));
        let before = &seen.name;
        let change = self.change(if *before == stream.name {
            labels::edit(short(before))
        } else {
            labels::rename(short(before))
        });
        let change = build::stream_edited(&behaviour, change, id, stream);
        self.propose_and(build::as_seen(change, Kind::Stream, id, Record::Stream(seen)), on_answer);
    }

    /// A stream goes with its connectors, a group with its streams.
    pub(crate) fn remove(&self, what: &Selected) {
        let behaviour = self.behaviour();
        let change = match what {
            Selected::Stream(id) => {
                let name = behaviour.stream(id).map_or("", |stream| &stream.name);
                let change = build::without_stream(&behaviour, self.change(labels::remove(short(name))), id);
                grouping::without_empty(&behaviour, change)
            }
            Selected::Connector(id) => {
                let word = behaviour.connector(id).map_or("connector", |connector| connector.operation.word());
                build::without_connector(&behaviour, self.change(labels::remove(Phrase::word(word))), id)
            }
            Selected::Note(_) => {
                several::without(&behaviour, self.change(labels::remove(Phrase::word("note"))), &[what.clone()].into())
            }
            Selected::Group(id) => {
                let title = self.group(id).map(|signals| signals.record.with_untracked(|group| short(&group.title)));
                let change = self.change(labels::remove(title.unwrap_or_default()));
                several::without(&behaviour, change, &[what.clone()].into())
            }
        };
        self.propose(change);
    }

    /// Streams, notes and boxes somewhere else, as one change.
    pub(crate) fn move_to(&self, places: Vec<(Id, Place)>) {
        self.move_as(&labels::moved(), &places);
    }

    /// A stream somewhere else, in an open group from then on, as one change; only moved if that group is gone by now.
    pub(crate) fn move_into(&self, places: Vec<(Id, Place)>, group: &Id) {
        let Some(signals) = self.group(group) else { return self.move_to(places) };
        let (behaviour, title) = (self.behaviour(), signals.record.with_untracked(|group| group.title.clone()));
        let moved = build::moved(&behaviour, self.change(labels::move_into(short(&title))), &places);
        let chosen = places.iter().map(|(id, _)| Selected::Stream(id.clone())).chain([Selected::Group(group.clone())]);
        let Some((change, _)) = grouping::grouped(&behaviour, moved, &chosen.collect(), (group, &title)) else {
            return self.move_to(places);
        };
        let whisper = self.tab.whisper.clone();
        self.propose_moved(change, &places, move || whisper.set(words::moved_into(&title)));
    }

    pub(super) fn move_as(&self, label: &Phrase, places: &[(Id, Place)]) {
        let behaviour = self.behaviour();
        for some in places.chunks(MOVES_MAX) {
            self.propose_moved(build::moved(&behaviour, self.change(label), some), some, || {});
        }
    }

    /// Proposes a change that moves these; refused, they are shown where they were.
    fn propose_moved(&self, change: Change, places: &[(Id, Place)], then: impl FnOnce() + 'static) {
        let (document, back) = (self.clone(), places.iter().map(|(id, _)| id.clone()).collect::<Vec<_>>());
        self.propose_and(change, move |answer| {
            match &answer {
                Ok(()) => then(),
                Err(_) => document.put_back(&back),
            }
            document.tab.say_refusal(answer);
        });
    }

    /// Shows things where the server has them, after a drag that came to nothing.
    pub(crate) fn put_back(&self, ids: &[Id]) {
        let keys: Vec<_> = ids.iter().map(|id| RecordId::new(Kind::Place, id)).collect();
        self.refresh(&keys);
    }

    /// Lays everything out afresh.
    pub(crate) fn tidy(&self, tidy: Tidy) {
        let stage = self.state().stage;
        let places: Vec<_> = tidy(&self.behaviour(), stage).into_iter().collect();
        self.move_as(&labels::tidied(), &places);
    }

    /// Another name of the open program; `seen` is what its author saw when they began.
    pub(crate) fn rename_program(&self, seen: Settings, name: &str) {
        let change = build::renamed(&self.behaviour(), self.change(labels::program_renamed()), name);
        self.propose(build::as_seen_at(change, &RecordId::settings(), Record::Settings(seen)));
    }

    /// Name and choices of the open program.
    pub(crate) fn settings(&self) -> Option<Settings> {
        self.behaviour().settings().cloned()
    }

    /// Proposes a change of the open program's settings.
    pub(in crate::desk) fn propose_settings(
        &self,
        change: Change,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        self.propose_and(change, on_answer);
    }

    /// A change of who sits here, still empty.
    pub(in crate::desk) fn change(&self, label: impl Into<Phrase>) -> Change {
        Change::of(new_id(), &self.tab.my_name(), label)
    }

    /// The open behaviour, and where its streams stand on this page, placed by people or not.
    pub(super) fn behaviour_and_places(&self) -> (Behaviour, BTreeMap<Id, Place>) {
        let behaviour = self.behaviour();
        let state = self.state();
        let shown = |id: &Id| state.streams.get(id).map(|signals| signals.place.get_untracked());
        let places = behaviour.streams().filter_map(|(id, _)| {
            let place = behaviour.place(id).or_else(|| shown(id))?;
            Some((id.clone(), place))
        });
        let places = places.filled();
        drop(state);
        (behaviour, places)
    }
}

/// The new name of what passes a test or comes at a beat, if it was called after that and nobody typed a name since.
fn followed_name(behaviour: &Behaviour, seen: &Connector, operation: &Operation, inputs: &[Id]) -> Option<String> {
    let spec = operation.spec();
    if !spec.is_test() && spec.takes.period.is_none() {
        return None;
    }
    let name = &behaviour.stream(&seen.output)?.name;
    let edited = Connector { operation: operation.clone(), inputs: inputs.to_vec(), ..seen.clone() };
    naming::followed(behaviour, name, seen, &edited).map(|name| build::free_name(behaviour, &name))
}

pub(in crate::desk) fn short(name: &str) -> String {
    name.chars().take(60).collect()
}
