//! The records a behaviour is made of.

use crate::{Declared, Id, Kind, Operation, Pad, RecordId, Value};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// The parameters of a stream's device, by name.
pub type Params = BTreeMap<String, Value>;

/// Sensor, ordinary or actuator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StreamKind {
    /// Carries what a sense of the robot reads.
    Sensor,
    /// Carries what a connector makes.
    Ordinary,
    /// Carries what an action of the robot is told.
    Actuator,
}

/// A named stream of values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stream {
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// Unique in the behaviour.
    pub name: String,
    /// The sense or action, by its name in the catalogue; none for an ordinary stream.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The parameters of the device.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub params: Params,
    /// Place in the file and in the order of starting: lower first, ties by id.
    pub order: i64,
    /// The parts of the body it uses; none means what the catalogue says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resources: Option<Vec<String>>,
    /// The priority when two actions want one part of the body: the higher one wins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub priority: Option<i64>,
    /// For how long a command holds its parts of the body, in milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold_ms: Option<u64>,
}

/// The procedural parameter of a connector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Procedure {
    /// Written in place.
    Body {
        /// A Rhai expression or block over its arguments; may be empty while building.
        body: String,
        /// The argument names; none means derived from the input streams' names.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        args: Option<Vec<String>>,
    },
    /// A helper of the library, by name.
    Helper(String),
}

impl Procedure {
    /// A body with argument names from its inputs.
    #[must_use]
    pub fn body(body: &str) -> Self {
        Self::Body { body: body.to_owned(), args: None }
    }
}

/// Carries values from its input streams to its output stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Connector {
    /// The operation of the connector, with its settings.
    pub operation: Operation,
    /// The streams it takes from, in order.
    pub inputs: Vec<Id>,
    /// The stream it gives to.
    pub output: Id,
    /// Creation number: part of the meaning, since a value goes to lower connectors first; ties by id.
    pub order: i64,
}

/// A named reusable procedure of the shared library.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Helper {
    /// Unique in the library; a valid Rhai name.
    pub name: String,
    /// Parameter names, valid Rhai names.
    pub params: Vec<String>,
    /// A Rhai expression or block over the parameters.
    pub body: String,
    /// The sentence that says what the helper is for.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub says: String,
    /// The declared kind of each parameter in order; none was declared for those that are missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub takes: Vec<Declared>,
    /// The declared kind of the result, if somebody said so.
    #[serde(default, skip_serializing_if = "Declared::is_auto")]
    pub gives: Declared,
}

impl Helper {
    /// Returns the declared kind of the parameter at this place.
    #[must_use]
    pub fn taken(&self, at: usize) -> Declared {
        self.takes.get(at).copied().unwrap_or_default()
    }
}

/// A place on the canvas: the middle of the top edge for streams and folded groups, in canvas units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The distance to the right of the origin.
    pub x: f64,
    /// Downwards.
    pub y: f64,
}

/// A note on the canvas.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Note {
    /// The text of the note.
    pub text: String,
    /// The name of who wrote it last; empty if nobody knows.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub by: String,
    /// The time when it was written last, in milliseconds since 1970; 0 if nobody knows.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub at_ms: u64,
}

impl Note {
    /// A note of which nobody knows who wrote it, and when.
    #[must_use]
    pub fn new(text: String) -> Self {
        Self { text, ..Self::default() }
    }
}

/// A titled frame around streams. Its frame follows them; it has a [`Place`] only where its folded box was moved to, else
/// the box stands in the middle of its streams. It means nothing to a run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// The title that people gave; others may have the same one.
    pub title: String,
    /// The streams in it, each in no other group. Some may be gone: a removed stream that comes back is in it again.
    pub streams: BTreeSet<Id>,
    /// Drawn as one box, for everybody.
    #[serde(default, skip_serializing_if = "is_false")]
    pub folded: bool,
}

// Where pointers have 32 bits, a number of 64 is no smaller than one.
#[cfg_attr(not(target_arch = "wasm32"), expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so"))]
fn is_zero(number: &u64) -> bool {
    *number == 0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_false(truth: &bool) -> bool {
    !truth
}

/// The ways in which time runs in a behaviour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Engine {
    /// Every reading at its own instant.
    #[default]
    Event,
    /// Readings gathered into frames.
    #[serde(rename_all = "camelCase")]
    Frame {
        /// The length of a frame in milliseconds.
        frame_ms: u64,
    },
}

/// The name and choices of a behaviour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The behaviour's name.
    pub name: String,
    /// The kind of robot it is made for: `nao`.
    pub robot: String,
    /// The way in which time runs.
    #[serde(default)]
    pub engine: Engine,
    /// Short words by which it is found in the library, each once; at most [`crate::TAGS_MAX`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// The exercise it was begun as, by the name of its beginning; the page then shows the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exercise: Option<String>,
}

impl Settings {
    /// The settings of a new behaviour for a NAO.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            robot: "nao".to_owned(),
            engine: Engine::default(),
            tags: Vec::new(),
            exercise: None,
        }
    }
}

/// One record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Record {
    /// Name and choices.
    Settings(Settings),
    /// A helper.
    Helper(Helper),
    /// A stream.
    Stream(Stream),
    /// A connector.
    Connector(Connector),
    /// A position.
    Place(Place),
    /// A note.
    Note(Note),
    /// A titled frame around streams.
    Group(Group),
    /// The tiles that people press beside a session.
    Pad(Pad),
}

impl Record {
    /// Returns the kind of the record.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self {
            Self::Settings(_) => Kind::Settings,
            Self::Helper(_) => Kind::Helper,
            Self::Stream(_) => Kind::Stream,
            Self::Connector(_) => Kind::Connector,
            Self::Place(_) => Kind::Place,
            Self::Note(_) => Kind::Note,
            Self::Group(_) => Kind::Group,
            Self::Pad(_) => Kind::Pad,
        }
    }
}

/// All records of one behaviour, or of the helper library.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Behaviour {
    /// All records by id.
    pub records: BTreeMap<RecordId, Record>,
}

impl Behaviour {
    /// The settings record.
    #[must_use]
    pub fn settings(&self) -> Option<&Settings> {
        match self.records.get(&RecordId::settings()) {
            Some(Record::Settings(settings)) => Some(settings),
            _ => None,
        }
    }

    /// The pad that somebody made, if there is one.
    #[must_use]
    pub fn pad(&self) -> Option<&Pad> {
        match self.records.get(&RecordId::pad()) {
            Some(Record::Pad(pad)) => Some(pad),
            _ => None,
        }
    }

    /// The name, or an empty text for the library.
    #[must_use]
    pub fn name(&self) -> &str {
        self.settings().map_or("", |settings| &settings.name)
    }

    /// One stream.
    #[must_use]
    pub fn stream(&self, id: &Id) -> Option<&Stream> {
        match self.records.get(&RecordId::new(Kind::Stream, id)) {
            Some(Record::Stream(stream)) => Some(stream),
            _ => None,
        }
    }

    /// One connector.
    #[must_use]
    pub fn connector(&self, id: &Id) -> Option<&Connector> {
        match self.records.get(&RecordId::new(Kind::Connector, id)) {
            Some(Record::Connector(connector)) => Some(connector),
            _ => None,
        }
    }

    /// The position of a stream, connector, note or folded group.
    #[must_use]
    pub fn place(&self, id: &Id) -> Option<Place> {
        match self.records.get(&RecordId::new(Kind::Place, id)) {
            Some(Record::Place(place)) => Some(*place),
            _ => None,
        }
    }

    /// All streams by id.
    pub fn streams(&self) -> impl Iterator<Item = (&Id, &Stream)> {
        self.records.iter().filter_map(|(key, record)| match record {
            Record::Stream(stream) => Some((&key.id, stream)),
            _ => None,
        })
    }

    /// All connectors by id.
    pub fn connectors(&self) -> impl Iterator<Item = (&Id, &Connector)> {
        self.records.iter().filter_map(|(key, record)| match record {
            Record::Connector(connector) => Some((&key.id, connector)),
            _ => None,
        })
    }

    /// All helpers by id.
    pub fn helpers(&self) -> impl Iterator<Item = (&Id, &Helper)> {
        self.records.iter().filter_map(|(key, record)| match record {
            Record::Helper(helper) => Some((&key.id, helper)),
            _ => None,
        })
    }

    /// All notes by id.
    pub fn notes(&self) -> impl Iterator<Item = (&Id, &Note)> {
        self.records.iter().filter_map(|(key, record)| match record {
            Record::Note(note) => Some((&key.id, note)),
            _ => None,
        })
    }

    /// All groups by id.
    pub fn groups(&self) -> impl Iterator<Item = (&Id, &Group)> {
        self.records.iter().filter_map(|(key, record)| match record {
            Record::Group(group) => Some((&key.id, group)),
            _ => None,
        })
    }

    /// The group that a stream is in, if it is in one.
    #[must_use]
    pub fn group_of(&self, stream: &Id) -> Option<(&Id, &Group)> {
        self.groups().find(|(_, group)| group.streams.contains(stream))
    }

    /// Streams in file order.
    #[must_use]
    pub fn streams_in_order(&self) -> Vec<(&Id, &Stream)> {
        let mut all: Vec<_> = self.streams().collect();
        all.sort_unstable_by_key(|(id, stream)| (stream.order, *id));
        all
    }

    /// Connectors in file order, which is part of the meaning.
    #[must_use]
    pub fn connectors_in_order(&self) -> Vec<(&Id, &Connector)> {
        let mut all: Vec<_> = self.connectors().collect();
        all.sort_unstable_by_key(|(id, connector)| (connector.order, *id));
        all
    }

    /// A creation number larger than any in use.
    #[must_use]
    pub fn next_order(&self) -> i64 {
        let streams = self.streams().map(|(_, stream)| stream.order);
        let connectors = self.connectors().map(|(_, connector)| connector.order);
        streams.chain(connectors).max().map_or(0, |highest| highest.saturating_add(1))
    }

    /// Every body that was written with the argument names of before gets those of today; it means the same.
    pub fn use_names_of_today(&mut self) {
        let today = |(id, connector): (&Id, &Connector)| {
            let Some(Procedure::Body { body, args: None }) = connector.operation.procedure() else { return None };
            let names = connector.inputs.iter().map(|id| self.stream(id).map_or("", |stream| stream.name.as_str()));
            let now = connector.operation.spec().in_names_of_today(body, names);
            (now != *body).then(|| (RecordId::new(Kind::Connector, id), now))
        };
        let rewritten: Vec<_> = self.connectors().filter_map(today).collect();
        for (id, body) in rewritten {
            let Some(Record::Connector(connector)) = self.records.get_mut(&id) else { continue };
            if let Some(procedure) = connector.operation.procedure_mut() {
                *procedure = Procedure::body(&body);
            }
        }
    }

    /// The argument names of a connector: as given, else from the names of its inputs.
    #[must_use]
    pub fn arguments(&self, connector: &Connector) -> Vec<String> {
        let names = connector.inputs.iter().map(|id| self.stream(id).map_or("", |stream| stream.name.as_str()));
        connector.operation.arguments(names)
    }
}
