//! A change while it is being made: streams and connectors put between what is there.

use super::{Fix, FixKind};
use crate::{
    Behaviour, Connector, Edit, Id, Kind, NAME_MAX_CHARS, Operation, Place, Procedure, Record, RecordId, Stream,
    StreamKind, argument_names, look_same, numbered, rename_identifier,
};

/// The distance from a stream to the next row of the canvas, in its units, with room for a bubble.
/// With less than two of them between its neighbours, a new stream and the connectors beside it would cover each other.
const LEVEL: f64 = 140.0;

/// A change of a behaviour.
pub(super) struct FixDraft<'a> {
    behaviour: &'a Behaviour,
    new_id: &'a mut dyn FnMut() -> Id,
    next_order: i64,
    edits: Vec<Edit>,
}

impl<'a> FixDraft<'a> {
    pub(super) fn of(behaviour: &'a Behaviour, new_id: &'a mut dyn FnMut() -> Id) -> Self {
        Self { behaviour, new_id, next_order: behaviour.next_order(), edits: Vec::new() }
    }

    pub(super) fn fix(self, kind: FixKind) -> Fix {
        Fix { kind, edits: self.edits }
    }

    pub(super) fn set_stream(&mut self, id: &Id, stream: Stream) {
        self.put(Kind::Stream, id, Record::Stream(stream));
    }

    pub(super) fn set_procedure(&mut self, id: &Id, procedure: Procedure) {
        if let Some(mut connector) = self.connector(id) {
            if let Some(now) = connector.operation.procedure_mut() {
                *now = procedure;
            }
            self.put(Kind::Connector, id, Record::Connector(connector));
        }
    }

    /// Returns the name that procedures use for the value of a stream.
    pub(super) fn argument(&self, stream: &Id) -> String {
        argument_names([self.name(stream).as_str()]).pop().unwrap_or_default()
    }

    /// A connector and its stream between an input of a connector and that connector, whose procedure then takes the new
    /// stream's value.
    pub(super) fn between(&mut self, connector: &Id, input: usize, operation: Operation, name: &str) {
        let Some(mut taking) = self.connector(connector) else { return };
        let Some(from) = taking.inputs.get(input).cloned() else { return };
        let before = self.arguments(&taking);
        let made = self.stream(name, &from, &taking.output);
        self.connect(operation, &from, &made);
        taking.inputs[input] = made;
        let after = self.arguments(&taking);
        if let Some(Procedure::Body { body, args: args @ None }) = taking.operation.procedure_mut() {
            let others: Vec<_> = before.iter().zip(&after).filter(|(before, after)| before != after).collect();
            match others[..] {
                [] => {}
                [(old, new)] => *body = rename_identifier(body, old, new),
                _ => *args = Some(before),
            }
        }
        self.put(Kind::Connector, connector, Record::Connector(taking));
    }

    /// A new stream to which a connector gives now, instead of to its own.
    pub(super) fn after(&mut self, connector: &Id, name: &str) -> Option<Id> {
        let mut giving = self.connector(connector)?;
        let made = self.stream(name, giving.inputs.first()?, &giving.output);
        giving.output = made.clone();
        self.put(Kind::Connector, connector, Record::Connector(giving));
        Some(made)
    }

    /// A new stream of what a connector makes of another stream, on the way to a third.
    pub(super) fn onward(&mut self, from: &Id, operation: Operation, name: &str, to: &Id) -> Id {
        let made = self.stream(name, from, to);
        self.connect(operation, from, &made);
        made
    }

    /// A new connector.
    pub(super) fn connect(&mut self, operation: Operation, from: &Id, to: &Id) {
        let (id, order) = ((self.new_id)(), self.order());
        let connector = Connector { operation, inputs: vec![from.clone()], output: to.clone(), order };
        self.put(Kind::Connector, &id, Record::Connector(connector));
    }

    /// A new stream, half way between two others; they make room if they stand too close for that.
    fn stream(&mut self, name: &str, from: &Id, to: &Id) -> Id {
        let (id, order, name) = ((self.new_id)(), self.order(), self.free_name(name));
        let (kind, device, params) = (StreamKind::Ordinary, None, crate::Params::new());
        let stream = Stream { kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
        self.put(Kind::Stream, &id, Record::Stream(stream));
        if let (Some(from), Some(mut to)) = (self.place(from), self.place(to)) {
            if (0.0..2.0 * LEVEL).contains(&(to.y - from.y)) {
                self.make_room(from.y, to.y);
                to.y += LEVEL;
            }
            let place = Place { x: f64::midpoint(from.x, to.x), y: f64::midpoint(from.y, to.y) };
            self.put(Kind::Place, &id, Record::Place(place));
        }
        id
    }

    /// Moves everything that stands at this height or below it one row down. What stands as high as the stream above
    /// stays there.
    fn make_room(&mut self, above: f64, from: f64) {
        let placed = self.behaviour.records.keys().filter(|id| id.kind == Kind::Place).map(|id| id.id.clone());
        for id in placed.collect::<Vec<_>>() {
            if let Some(place) = self.place(&id).filter(|place| place.y >= from && place.y > above) {
                self.put(Kind::Place, &id, Record::Place(Place { y: place.y + LEVEL, ..place }));
            }
        }
    }

    fn free_name(&self, wanted: &str) -> String {
        let short: String = wanted.chars().take(NAME_MAX_CHARS - 20).collect();
        let new = self.edits.iter().filter_map(|edit| match &edit.after {
            Some(Record::Stream(stream)) => Some(stream.name.as_str()),
            _ => None,
        });
        let taken: Vec<&str> = self.behaviour.streams().map(|(_, stream)| stream.name.as_str()).chain(new).collect();
        let free = numbered(&short, " ").find(|name| !taken.iter().any(|taken| look_same(taken, name)));
        free.unwrap_or_default()
    }

    fn order(&mut self) -> i64 {
        let order = self.next_order;
        self.next_order = order.saturating_add(1);
        order
    }

    fn put(&mut self, kind: Kind, id: &Id, after: Record) {
        let id = RecordId::new(kind, id);
        match self.edits.iter_mut().find(|edit| edit.id == id) {
            Some(edit) => edit.after = Some(after),
            None => {
                let before = self.behaviour.records.get(&id).cloned();
                self.edits.push(Edit { id, before, after: Some(after) });
            }
        }
    }

    fn record(&self, kind: Kind, id: &Id) -> Option<&Record> {
        let id = RecordId::new(kind, id);
        let edited = self.edits.iter().find(|edit| edit.id == id);
        edited.map_or_else(|| self.behaviour.records.get(&id), |edit| edit.after.as_ref())
    }

    fn connector(&self, id: &Id) -> Option<Connector> {
        match self.record(Kind::Connector, id) {
            Some(Record::Connector(connector)) => Some(connector.clone()),
            _ => None,
        }
    }

    fn place(&self, id: &Id) -> Option<Place> {
        match self.record(Kind::Place, id) {
            Some(Record::Place(place)) => Some(*place),
            _ => None,
        }
    }

    fn name(&self, id: &Id) -> String {
        match self.record(Kind::Stream, id) {
            Some(Record::Stream(stream)) => stream.name.clone(),
            _ => String::new(),
        }
    }

    fn arguments(&self, connector: &Connector) -> Vec<String> {
        let names: Vec<String> = connector.inputs.iter().map(|id| self.name(id)).collect();
        connector.operation.arguments(names.iter().map(String::as_str))
    }
}
