//! Records as the properties of nodes and relationships, and back.

use super::fault::Neo4jFault;
use crate::usage::words;
use crate::{Damage, StoreError, json};
use behaviour::{
    Connector, Declared, Engine, Group, Helper, Id, Kind, Note, Pad, Parameters, Place, Procedure, Record, RecordId,
    Settings, Stream, StreamKind, connectors, connectors::Spec,
};
use serde::{Deserialize, Deserializer};
use serde_json::{Value, json};

/// A whole number from 0 on. Neo4j has none above the largest `i64`; a larger one is kept as its digits.
pub(super) fn whole(number: u64) -> Value {
    i64::try_from(number).map_or_else(|_| Value::from(number.to_string()), Value::from)
}

fn read_whole<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u64>, D::Error> {
    let wrong = |what: Value| serde::de::Error::custom(format!("{what} is no whole number"));
    match Option::<Value>::deserialize(from)? {
        None | Some(Value::Null) => Ok(None),
        Some(Value::String(digits)) => digits.parse().map(Some).map_err(|_| wrong(Value::String(digits))),
        Some(number) => number.as_u64().map(Some).ok_or_else(|| wrong(number)),
    }
}

/// The label of a stream's kind.
pub(super) fn label(kind: StreamKind) -> &'static str {
    match kind {
        StreamKind::Sensor => "Sensor",
        StreamKind::Ordinary => "Ordinary",
        StreamKind::Actuator => "Actuator",
    }
}

/// The kind of a device, which is that of the streams it feeds.
pub(super) fn device_kind(kind: StreamKind) -> &'static str {
    match kind {
        StreamKind::Sensor => "sensor",
        StreamKind::Ordinary => "ordinary",
        StreamKind::Actuator => "actuator",
    }
}

/// The type of the relationship as which a connector is kept, if the thesis draws it as one: between two streams, with
/// what it does written in it.
pub(super) fn relationship(connector: &Connector) -> Option<&'static str> {
    let has_helper = matches!(connector.operation.procedure(), Some(Procedure::Helper(_)));
    let kind = connector.operation.spec().graph.relationship;
    kind.filter(|_| connector.inputs.len() == 1 && !has_helper)
}

/// Every type of relationship as which connectors are kept.
pub(super) fn relationships() -> impl Iterator<Item = &'static str> {
    connectors::ALL.iter().filter_map(|spec| spec.graph.relationship)
}

/// A statement in which `$TYPES` stands for every type of relationship that a connector may be.
pub(super) fn with_relationships(statement: &str) -> String {
    statement.replace("$TYPES", &relationships().collect::<Vec<_>>().join("|"))
}

/// The properties of a stream's node.
pub(super) fn of_stream(program: &Id, id: &Id, stream: &Stream) -> serde_json::Result<Value> {
    let params = if stream.params.is_empty() { None } else { Some(json::encode(&stream.params)?) };
    Ok(json!({
        "program_id": program, "id": id, "name": stream.name, "order": stream.order, "device": stream.device,
        "params_json": params, "resources": stream.resources, "priority": stream.priority,
        "hold_ms": stream.hold_ms.map(whole),
    }))
}

/// The properties of a connector's node or relationship.
pub(super) fn of_connector(program: &Id, id: &Id, record: &Record, connector: &Connector) -> serde_json::Result<Value> {
    let (body, args, helper) = match connector.operation.procedure() {
        Some(Procedure::Body { body, args }) => (Some(body), args.as_ref(), None),
        Some(Procedure::Helper(name)) => (None, None, Some(name)),
        None => (None, None, None),
    };
    let (period_ms, start) = (connector.operation.period_ms().map(whole), connector.operation.start());
    let start = start.map(json::encode).transpose()?;
    Ok(json!({
        "program_id": program, "id": id, "order": connector.order, "body": body, "args": args, "helper": helper,
        "period_ms": period_ms, "start_json": start,
        "words": body.map(|_| words(record)).filter(|words| !words.is_empty()),
    }))
}

/// The properties of a helper's node.
pub(super) fn of_helper(program: &Id, id: &Id, record: &Record, helper: &Helper) -> Value {
    let takes = Some(&helper.takes).filter(|takes| !takes.is_empty());
    let gives = Some(helper.gives).filter(|gives| !gives.is_auto());
    json!({
        "program_id": program, "id": id, "name": helper.name, "params": helper.params, "body": helper.body,
        "says": helper.says, "takes": takes, "gives": gives, "words": Some(words(record)).filter(|words| !words.is_empty()),
    })
}

/// Returns the properties of a note's node; null takes away.
pub(super) fn of_note(id: &Id, note: &Note) -> Value {
    let by = Some(&note.by).filter(|by| !by.is_empty());
    json!({ "id": id, "text": note.text, "by": by, "at_ms": Some(note.at_ms).filter(|at_ms| *at_ms > 0).map(whole) })
}

/// Returns the properties of a group's node.
pub(super) fn of_group(id: &Id, group: &Group) -> Value {
    json!({ "id": id, "title": group.title, "streams": group.streams, "folded": group.folded })
}

/// The pad on the node of its behaviour, as JSON; null without one.
pub(super) fn of_pad(pad: Option<&Pad>) -> serde_json::Result<Value> {
    Ok(pad.map(json::encode).transpose()?.into())
}

/// The pad as it is read.
pub(super) fn pad(text: Option<&str>) -> Result<Option<(RecordId, Record)>, Neo4jFault> {
    let pad = text.map(json::decode).transpose().map_err(|reason| Neo4jFault::damaged(&reason))?;
    Ok(pad.map(|pad| (RecordId::pad(), Record::Pad(pad))))
}

/// The properties of the settings, on the node of their behaviour; all null without settings.
pub(super) fn of_settings(settings: Option<&Settings>) -> serde_json::Result<Value> {
    let engine = settings.map(|settings| json::encode(&settings.engine)).transpose()?;
    let name = settings.map(|settings| &settings.name);
    let tags = settings.map(|settings| &settings.tags).filter(|tags| !tags.is_empty());
    Ok(json!({
        "name": name, "robot": settings.map(|settings| &settings.robot), "engine_json": engine, "tags": tags,
        "exercise": settings.map(|settings| &settings.exercise),
    }))
}

/// Settings as they are read.
#[derive(Deserialize)]
pub(super) struct SettingsNode {
    name: Option<String>,
    robot: Option<String>,
    engine_json: Option<String>,
    tags: Option<Vec<String>>,
    exercise: Option<String>,
}

impl SettingsNode {
    /// The settings, if there are any.
    pub(super) fn record(self) -> Result<Option<(RecordId, Record)>, Neo4jFault> {
        let (Some(name), Some(robot), Some(engine)) = (self.name, self.robot, self.engine_json) else {
            return Ok(None);
        };
        let tags = self.tags.unwrap_or_default();
        let engine: Engine = json::decode(&engine).map_err(|reason| Neo4jFault::damaged(&reason))?;
        Ok(Some((
            RecordId::settings(),
            Record::Settings(Settings { name, robot, engine, tags, exercise: self.exercise }),
        )))
    }
}

/// A stream as it is read.
#[derive(Deserialize)]
pub(super) struct StreamNode {
    id: Id,
    kind: StreamKind,
    name: String,
    order: i64,
    device: Option<String>,
    params_json: Option<String>,
    resources: Option<Vec<String>>,
    priority: Option<i64>,
    #[serde(default, deserialize_with = "read_whole")]
    hold_ms: Option<u64>,
}

impl StreamNode {
    /// The stream.
    pub(super) fn record(self) -> Result<(RecordId, Record), Neo4jFault> {
        let params = self.params_json.as_deref().map(json::decode).transpose();
        let stream = Stream {
            kind: self.kind,
            name: self.name,
            device: self.device,
            params: params.map_err(|reason| Neo4jFault::damaged(&reason))?.unwrap_or_default(),
            order: self.order,
            resources: self.resources,
            priority: self.priority,
            hold_ms: self.hold_ms,
        };
        Ok((RecordId::new(Kind::Stream, &self.id), Record::Stream(stream)))
    }
}

/// A connector as it is read, from a node or a relationship.
#[derive(Deserialize)]
pub(super) struct ConnectorNode {
    id: Id,
    kind: String,
    inputs: Vec<Id>,
    output: Id,
    order: i64,
    body: Option<String>,
    args: Option<Vec<String>>,
    helper: Option<String>,
    #[serde(default, deserialize_with = "read_whole")]
    period_ms: Option<u64>,
    start_json: Option<String>,
}

impl ConnectorNode {
    /// The connector.
    pub(super) fn record(self) -> Result<(RecordId, Record), Neo4jFault> {
        let wrong = || Neo4jFault::Said(StoreError::Damaged(Damage::PartMissing(self.id.clone())));
        let kept_as = |spec: &&&Spec| spec.graph.label == self.kind || spec.graph.relationship == Some(&self.kind);
        let spec = *connectors::ALL.iter().find(kept_as).ok_or_else(wrong)?;
        let procedure = match (&self.helper, &self.body) {
            (Some(name), _) => Some(Procedure::Helper(name.clone())),
            (None, Some(body)) => Some(Procedure::Body { body: body.clone(), args: self.args.clone() }),
            (None, None) => None,
        };
        let start = self.start_json.as_deref().map(json::decode).transpose();
        let start = start.map_err(|reason| Neo4jFault::damaged(&reason))?;
        let parameters = Parameters { procedure, period_ms: self.period_ms, start };
        if spec.lacks(&parameters).is_some() {
            return Err(wrong());
        }
        let operation = spec.with(parameters);
        let key = RecordId::new(Kind::Connector, &self.id);
        Ok((
            key,
            Record::Connector(Connector { operation, inputs: self.inputs, output: self.output, order: self.order }),
        ))
    }
}

/// A helper as it is read.
#[derive(Deserialize)]
pub(super) struct HelperNode {
    id: Id,
    name: String,
    params: Vec<String>,
    body: String,
    says: String,
    #[serde(default)]
    takes: Option<Vec<Declared>>,
    #[serde(default)]
    gives: Option<Declared>,
}

impl HelperNode {
    /// The helper.
    pub(super) fn record(self) -> (RecordId, Record) {
        let helper = Helper {
            name: self.name,
            params: self.params,
            body: self.body,
            says: self.says,
            takes: self.takes.unwrap_or_default(),
            gives: self.gives.unwrap_or_default(),
        };
        (RecordId::new(Kind::Helper, &self.id), Record::Helper(helper))
    }
}

/// A place as it is read.
#[derive(Deserialize)]
pub(super) struct PlaceNode {
    id: Id,
    x: f64,
    y: f64,
}

impl PlaceNode {
    /// The place.
    pub(super) fn record(self) -> (RecordId, Record) {
        (RecordId::new(Kind::Place, &self.id), Record::Place(Place { x: self.x, y: self.y }))
    }
}

/// A note as it is read.
#[derive(Deserialize)]
pub(super) struct NoteNode {
    id: Id,
    text: String,
    by: Option<String>,
    #[serde(default, deserialize_with = "read_whole")]
    at_ms: Option<u64>,
}

impl NoteNode {
    /// The note.
    pub(super) fn record(self) -> (RecordId, Record) {
        let (by, at_ms) = (self.by.unwrap_or_default(), self.at_ms.unwrap_or_default());
        (RecordId::new(Kind::Note, &self.id), Record::Note(Note { text: self.text, by, at_ms }))
    }
}

/// A group as it is read.
#[derive(Deserialize)]
pub(super) struct GroupNode {
    id: Id,
    title: String,
    streams: Vec<Id>,
    folded: bool,
}

impl GroupNode {
    /// The group.
    pub(super) fn record(self) -> (RecordId, Record) {
        let streams = self.streams.into_iter().collect();
        (RecordId::new(Kind::Group, &self.id), Record::Group(Group { title: self.title, streams, folded: self.folded }))
    }
}
