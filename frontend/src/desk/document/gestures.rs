//! Gestures: the editor builds one change with a label of each, and proposes it.

use super::{ConnectPlan, Document, Selected, WireEnd, build};
use crate::desk::tab::new_id;
use crate::layout::Tidy;
use crate::words;
use behaviour::{Behaviour, Change, Connector, Id, Operation, Params, Place, Settings, Stream};
use editor::graph::rewire;
use phrase::Phrase;
use protocol::Refused;
use std::collections::BTreeMap;

impl Document {
    /// The name of a change whose answer somebody waits for.
    pub(super) fn awaited(&self, on_answer: impl FnOnce(Result<(), Refused>) + 'static) -> Id {
        let op = new_id();
        self.on_answer(&op, Box::new(on_answer));
        op
    }

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
        self.input(|editor| editor.add_sensor(new_id(), (device.name, words::device(device)), params, at));
    }

    /// A new connector; the stream it leads to is selected once it is there.
    pub(crate) fn connect(&self, plan: ConnectPlan, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let op = self.awaited(on_answer);
        self.input(|editor| editor.connect(op, plan));
    }

    /// A new connector and another one out of what it makes, as one change; the last stream is selected once it is there.
    pub(crate) fn connect_twice(
        &self,
        first: ConnectPlan,
        then: ConnectPlan,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let op = self.awaited(on_answer);
        self.input(|editor| editor.connect_twice(op, first, then));
    }

    /// Leads a stream to where its wire ends, as one change; what it ends at is selected then.
    pub(crate) fn wire(&self, from: &Id, end: &WireEnd) {
        self.input(|editor| editor.wire(new_id(), from, end));
    }

    /// Removes a stream of a way and joins what is above it with what is below, as one change.
    pub(crate) fn remove_and_heal(&self, id: &Id) {
        self.input(|editor| editor.remove_and_heal(new_id(), id));
    }

    /// The stream that takes the place of a removed one, if its way can be healed, and its name.
    pub(crate) fn healed_by(&self, id: &Id) -> Option<(Id, String)> {
        let behaviour = self.behaviour();
        let above = rewire::healed_by(&behaviour, id)?;
        Some((above.clone(), behaviour.stream(above)?.name.clone()))
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
        let op = self.awaited(on_answer);
        self.input(|editor| editor.edit_connector(op, (id, seen), (operation, inputs), output_name));
    }

    /// Another name or other settings; bodies that use its old argument name follow in the same change.
    /// `seen` is what the person saw when they began; the server refuses if it is not that any more.
    pub(crate) fn edit_stream(
        &self,
        (id, seen): (&Id, Stream),
        stream: Stream,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let op = self.awaited(on_answer);
        self.input(|editor| editor.edit_stream(op, (id, seen), stream));
    }

    /// A stream goes with its connectors, a group with its streams.
    pub(crate) fn remove(&self, what: &Selected) {
        self.input(|editor| editor.remove(new_id(), what));
    }

    /// Streams, notes and boxes somewhere else, as one change.
    pub(crate) fn move_to(&self, places: Vec<(Id, Place)>) {
        self.input(|editor| editor.move_to(&places));
    }

    /// A stream somewhere else, in an open group from then on, as one change; only moved if that group is gone by now.
    pub(crate) fn move_into(&self, places: Vec<(Id, Place)>, group: &Id) {
        self.input(|editor| editor.move_into(&places, group));
    }

    /// Shows things where the server has them, after a drag that came to nothing.
    pub(crate) fn put_back(&self, ids: &[Id]) {
        self.input(|editor| editor.put_back(ids));
    }

    /// Lays everything out afresh.
    pub(crate) fn tidy(&self, tidy: Tidy) {
        self.input(|editor| editor.tidy(tidy));
    }

    /// Another name of the open program; `seen` is what its author saw when they began.
    pub(crate) fn rename_program(&self, seen: Settings, name: &str) {
        self.input(|editor| editor.rename_program(new_id(), seen, name));
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
        self.state().editor.ground()
    }
}
