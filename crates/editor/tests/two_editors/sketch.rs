//! A small graph for two people, and what they see of it.

use crate::server::id;
use crate::table::Table;
use behaviour::{
    Behaviour, Id, Kind, Operation, Params, Place, Procedure, Record, RecordId, Stream, StreamKind, connectors,
};
use editor::Selected;
use editor::graph::{ConnectPlan, NewSpot, Output};
use std::collections::BTreeSet;

pub(crate) fn stream(name: &str) -> Selected {
    Selected::Stream(id(name))
}

pub(crate) fn connector(name: &str) -> Selected {
    Selected::Connector(id(name))
}

pub(crate) fn streams(names: &[&str]) -> BTreeSet<Selected> {
    names.iter().map(|name| stream(name)).collect()
}

pub(crate) fn filter(body: &str) -> Operation {
    connectors::filter::SPEC.with(Procedure::body(body))
}

pub(crate) fn plan(inputs: &[&str], operation: Operation, name: &str) -> ConnectPlan {
    let output = Output::New { name: name.to_owned(), device: None, params: Params::new() };
    ConnectPlan { operation, inputs: inputs.iter().map(|input| id(input)).collect(), output, spot: NewSpot::Below }
}

/// Ball -> distance -> close -> tracker below each other, and a touch beside them that leads nowhere. The connectors are called
/// as what they lead to, with `to-` before it.
pub(crate) fn sketch() -> Behaviour {
    let mut made = Behaviour::default();
    let all = [
        ("ball", StreamKind::Sensor, Some("RedBall"), (0.0, 0.0)),
        ("touch", StreamKind::Sensor, Some("HeadTouch"), (600.0, 0.0)),
        ("distance", StreamKind::Ordinary, None, (0.0, 140.0)),
        ("close", StreamKind::Ordinary, None, (0.0, 280.0)),
        ("tracker", StreamKind::Actuator, Some("Tracker"), (0.0, 420.0)),
    ];
    for (order, (name, kind, device, (x, y))) in (0..).zip(all) {
        let (device, params) = (device.map(str::to_owned), Params::new());
        let stream = Stream {
            kind,
            name: name.to_owned(),
            device,
            params,
            order,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        made.records.insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream));
        made.records.insert(RecordId::new(Kind::Place, &id(name)), Record::Place(Place { x, y }));
    }
    let distance = connectors::map::SPEC.with(Procedure::body("ball.size * 2"));
    let ways = [
        ("ball", "distance", distance),
        ("distance", "close", filter("distance < 20")),
        ("close", "tracker", connectors::to_action().with(())),
    ];
    for (order, (from, to, operation)) in (10..).zip(ways) {
        let connector = behaviour::Connector { operation, inputs: vec![id(from)], output: id(to), order };
        made.records.insert(RecordId::new(Kind::Connector, &id(&format!("to-{to}"))), Record::Connector(connector));
    }
    made
}

impl Table {
    /// Both have opened the small graph.
    pub(crate) fn sketched() -> Self {
        Self::with(sketch())
    }

    /// The names of the saved streams, in order.
    pub(crate) fn names(&self) -> Vec<String> {
        self.program().streams_in_order().into_iter().map(|(_, stream)| stream.name.clone()).collect()
    }

    /// The id of a saved stream by its name.
    pub(crate) fn named(&self, name: &str) -> Id {
        let found = self.program().streams().find(|(_, stream)| stream.name == name);
        found.map(|(id, _)| id.clone()).unwrap_or_else(|| panic!("there is no {name} in {:?}", self.names()))
    }

    /// From where a stream gets its values, by name.
    pub(crate) fn sources(&self, name: &str) -> Vec<String> {
        let of = self.named(name);
        let into = self.program().connectors().filter(|(_, connector)| connector.output == of);
        let called = |id: &Id| self.program().stream(id).map_or_else(String::new, |stream| stream.name.clone());
        into.flat_map(|(_, connector)| connector.inputs.iter().map(called).collect::<Vec<_>>()).collect()
    }

    pub(crate) fn place(&self, name: &str) -> Place {
        self.program().place(&self.named(name)).unwrap_or_else(|| panic!("{name} is placed"))
    }

    pub(crate) fn selected(&self, who: usize) -> Option<Selected> {
        (*self.editor(who).selected).clone()
    }

    /// Somebody takes back their last change.
    pub(crate) fn undo(&mut self, who: usize) {
        self.does(who, |page| page.input(editor::Editor::undo));
    }
}
