//! Gestures: each builds one change with a label and proposes it.

use super::{ConnectPlan, Document, Output, Selected, build};
use crate::desk::tab::new_id;
use crate::layout;
use behaviour::{Behaviour, Change, Connector, Filled, Id, Kind, Operation, Params, Place, Record, RecordId, Stream};
use leptos::prelude::*;
use protocol::Refused;
use std::collections::BTreeMap;

/// So many places fit in one change and its message.
const MOVES_MAX: usize = 800;

impl Document {
    /// The first free stream name: "Tracker", then "Tracker 2".
    pub(crate) fn name_for(&self, base: &str) -> String {
        build::free_name(&self.behaviour(), base)
    }

    /// A new sensor stream, selected once it is there. `device` is the catalogue's name.
    pub(crate) fn add_sensor(&self, device: &str, params: Params) {
        let (behaviour, places) = self.behaviour_and_places();
        let id = new_id();
        let change = build::sensor(&behaviour, &places, self.change(&format!("Add {device}")), (&id, device, params));
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
        let change = self.change(&format!("Add {}", plan.operation.word()));
        let change = build::connected(&behaviour, &places, change, (&stream, &connector), plan);
        self.propose_and(change, self.select_on_yes(select, on_answer));
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
        let change = self.change(&format!("Edit {}", operation.word()));
        let change = build::connector_edited(&self.behaviour(), change, id, (operation, inputs), output_name);
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
        let before = behaviour.stream(id).map_or("", |stream| &stream.name);
        let change =
            self.change(&format!("{} {}", if before == stream.name { "Edit" } else { "Rename" }, short(before)));
        let change = build::stream_edited(&behaviour, change, id, stream);
        self.propose_and(build::as_seen(change, Kind::Stream, id, Record::Stream(seen)), on_answer);
    }

    /// A stream goes with its connectors.
    pub(crate) fn remove(&self, what: &Selected) {
        let behaviour = self.behaviour();
        let change = match what {
            Selected::Stream(id) => {
                let name = behaviour.stream(id).map_or("", |stream| &stream.name);
                build::without_stream(&behaviour, self.change(&format!("Remove {}", short(name))), id)
            }
            Selected::Connector(id) => {
                let word = behaviour.connector(id).map_or("connector", |connector| connector.operation.word());
                build::without_connector(&behaviour, self.change(&format!("Remove {word}")), id)
            }
        };
        self.propose(change);
    }

    /// Streams somewhere else, as one change.
    pub(crate) fn move_streams(&self, places: Vec<(Id, Place)>) {
        self.move_as("Move", &places);
    }

    fn move_as(&self, label: &str, places: &[(Id, Place)]) {
        let behaviour = self.behaviour();
        for some in places.chunks(MOVES_MAX) {
            let change = build::moved(&behaviour, self.change(label), some);
            let (document, back) = (self.clone(), some.iter().map(|(id, _)| id.clone()).collect::<Vec<_>>());
            self.propose_and(change, move |answer| {
                if answer.is_err() {
                    document.put_back(&back);
                }
                document.tab.say_refusal(answer);
            });
        }
    }

    /// Shows streams where the server has them, after a drag that came to nothing.
    pub(crate) fn put_back(&self, ids: &[Id]) {
        let keys: Vec<_> = ids.iter().map(|id| RecordId::new(Kind::Place, id)).collect();
        self.refresh(&keys);
    }

    /// Lays everything out afresh, top to bottom.
    pub(crate) fn tidy(&self) {
        let places: Vec<_> = layout::tidy(&self.behaviour()).into_iter().collect();
        self.move_as("Tidy", &places);
    }

    /// Another name of the open program.
    pub(crate) fn rename_program(&self, name: &str) {
        let change = build::renamed(&self.behaviour(), self.change("Rename program"), name);
        self.propose(change);
    }

    /// A change of who sits here, still empty.
    pub(in crate::desk) fn change(&self, label: &str) -> Change {
        Change::of(new_id(), &self.tab.my_name(), label)
    }

    /// The open behaviour, and where its streams stand on this page, placed by people or not.
    fn behaviour_and_places(&self) -> (Behaviour, BTreeMap<Id, Place>) {
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

pub(in crate::desk) fn short(name: &str) -> String {
    name.chars().take(60).collect()
}
