//! `rrp-behaviour/1`: one behaviour with its helpers as one file, what `rrp replay` reads and a run is pinned to.

use crate::{
    Behaviour, Connector, Engine, Helper, Id, Kind, Operation, Params, Place, Procedure, Record, RecordId, Settings,
    Stream, StreamKind, calls_helper,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The format's name and version.
pub const FORMAT: &str = "rrp-behaviour/1";

/// A behaviour as a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct BehaviourFile {
    /// Always `rrp-behaviour/1`.
    pub format: String,
    /// The behaviour's name.
    pub name: String,
    /// The kind of robot, `nao` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    /// How time runs, `event` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub engine: Option<Engine>,
    /// The helpers it uses.
    pub helpers: Vec<FileHelper>,
    /// Its streams.
    pub streams: Vec<FileStream>,
    /// Its connectors; their order is part of the meaning.
    pub connectors: Vec<FileConnector>,
    /// Where things stand, by id.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub layout: BTreeMap<String, Place>,
}

/// A helper in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileHelper {
    /// Its name.
    pub name: String,
    /// Its parameters.
    pub params: Vec<String>,
    /// Its procedure.
    pub body: String,
    /// What it is for.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub says: String,
}

/// A stream in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct FileStream {
    /// Its id.
    pub id: String,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// Its name.
    pub name: String,
    /// Its device.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The device's parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub params: Option<Params>,
    /// The parts of the body it uses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resources: Option<Vec<String>>,
    /// Who wins: higher first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub priority: Option<i64>,
    /// For how long a command holds, in milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold_ms: Option<u64>,
}

/// A connector in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct FileConnector {
    /// Its id.
    pub id: String,
    /// `map`, `filter`, `timestamp`, `sample`, `combineLatest`, `merge` or `subscribe`.
    #[serde(rename = "type")]
    pub operation: String,
    /// The streams it takes from.
    pub inputs: Vec<String>,
    /// The stream it gives to.
    pub output: String,
    /// The procedure written in place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// The argument names of the body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub args: Option<Vec<String>>,
    /// The helper used instead of a body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub helper: Option<String>,
    /// The beat of a sample, in milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_ms: Option<u64>,
}

impl BehaviourFile {
    /// The file of a behaviour with those helpers of `library` that it uses, also through other helpers.
    #[must_use]
    pub fn of(behaviour: &Behaviour, library: &[&Helper]) -> Self {
        let settings = behaviour.settings().cloned().unwrap_or_else(|| Settings::named(""));
        let connectors: Vec<_> =
            behaviour.connectors_in_order().into_iter().map(|(id, c)| file_connector(id, c)).collect();
        Self {
            format: FORMAT.to_owned(),
            name: settings.name,
            robot: Some(settings.robot).filter(|robot| robot != "nao"),
            engine: Some(settings.engine).filter(|engine| *engine != Engine::Event),
            helpers: used_helpers(&connectors, library),
            streams: behaviour.streams_in_order().into_iter().map(|(id, stream)| file_stream(id, stream)).collect(),
            connectors,
            layout: layout_of(behaviour),
        }
    }

    /// The records of the file, with new ids from `new_id` (called once per stream and connector) or, if it
    /// returns none, the file's own.
    ///
    /// # Errors
    /// One line per fault: `id: reason`.
    pub fn records(&self, mut new_id: impl FnMut(&str) -> Option<Id>) -> Result<Behaviour, Vec<String>> {
        let mut faults = Vec::new();
        if self.format != FORMAT {
            faults.push(format!("format: {:?} is not {FORMAT}", self.format));
        }
        let mut ids = BTreeMap::new();
        for name in self.streams.iter().map(|s| &s.id).chain(self.connectors.iter().map(|c| &c.id)) {
            match new_id(name).map_or_else(|| Id::new(name), Ok) {
                Ok(id) if ids.insert(name.clone(), id.clone()).is_none() => {}
                Ok(_) => faults.push(format!("{name}: this id is used twice")),
                Err(reason) => faults.push(format!("{name}: {reason}")),
            }
        }
        let records = self.to_records(&ids, &mut faults);
        if faults.is_empty() { Ok(Behaviour { records }) } else { Err(faults) }
    }

    fn to_records(&self, ids: &BTreeMap<String, Id>, faults: &mut Vec<String>) -> BTreeMap<RecordId, Record> {
        let mut records = BTreeMap::new();
        let mut settings = Settings::named(&self.name);
        settings.robot = self.robot.clone().unwrap_or(settings.robot);
        settings.engine = self.engine.unwrap_or_default();
        records.insert(RecordId::settings(), Record::Settings(settings));
        for (order, (stream, id)) in (0..).zip(self.streams.iter().filter_map(|s| Some((s, ids.get(&s.id)?)))) {
            records.insert(RecordId::new(Kind::Stream, id), Record::Stream(stream.record(order)));
        }
        for (order, connector) in (0..).zip(&self.connectors) {
            match connector.record(order, ids) {
                Ok((id, record)) => {
                    drop(records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(record)))
                }
                Err(reason) => faults.push(format!("{}: {reason}", connector.id)),
            }
        }
        for (name, place) in &self.layout {
            if let Some(id) = ids.get(name) {
                records.insert(RecordId::new(Kind::Place, id), Record::Place(*place));
            }
        }
        records
    }

    /// The helpers as records of the library.
    #[must_use]
    pub fn library(&self) -> Vec<Helper> {
        let helper = |h: &FileHelper| Helper {
            name: h.name.clone(),
            params: h.params.clone(),
            body: h.body.clone(),
            says: h.says.clone(),
        };
        self.helpers.iter().map(helper).collect()
    }
}

impl FileStream {
    fn record(&self, order: i64) -> Stream {
        Stream {
            kind: self.kind,
            name: self.name.clone(),
            device: self.device.clone(),
            params: self.params.clone().unwrap_or_default(),
            order,
            resources: self.resources.clone(),
            priority: self.priority,
            hold_ms: self.hold_ms,
        }
    }
}

impl FileConnector {
    fn record(&self, order: i64, ids: &BTreeMap<String, Id>) -> Result<(Id, Connector), String> {
        let find = |name: &String| ids.get(name).cloned().ok_or_else(|| format!("there is no stream {name:?}"));
        let inputs = self.inputs.iter().map(find).collect::<Result<_, _>>()?;
        let connector = Connector { operation: self.operation()?, inputs, output: find(&self.output)?, order };
        Ok((find(&self.id)?, connector))
    }

    fn operation(&self) -> Result<Operation, String> {
        match self.operation.as_str() {
            "map" => self.procedure().map(Operation::Map),
            "filter" => self.procedure().map(Operation::Filter),
            "combineLatest" => self.procedure().map(Operation::CombineLatest),
            "timestamp" => Ok(Operation::Timestamp),
            "merge" => Ok(Operation::Merge),
            "subscribe" => Ok(Operation::Subscribe),
            "sample" => {
                let period_ms = self.period_ms.ok_or("sample needs periodMs")?;
                Ok(Operation::Sample { period_ms })
            }
            other => Err(format!("there is no connector {other:?}")),
        }
    }

    /// The procedural parameter; an absent body is an empty one.
    fn procedure(&self) -> Result<Procedure, String> {
        match (&self.body, &self.helper) {
            (Some(_), Some(_)) => Err("it has both a body and a helper".to_owned()),
            (None, Some(helper)) => Ok(Procedure::Helper(helper.clone())),
            (body, None) => Ok(Procedure::Body { body: body.clone().unwrap_or_default(), args: self.args.clone() }),
        }
    }
}

fn file_stream(id: &Id, stream: &Stream) -> FileStream {
    FileStream {
        id: id.to_string(),
        kind: stream.kind,
        name: stream.name.clone(),
        device: stream.device.clone(),
        params: Some(stream.params.clone()).filter(|params| !params.is_empty()),
        resources: stream.resources.clone(),
        priority: stream.priority,
        hold_ms: stream.hold_ms,
    }
}

fn file_connector(id: &Id, connector: &Connector) -> FileConnector {
    let (body, args, helper) = match connector.operation.procedure() {
        Some(Procedure::Body { body, args }) => (Some(body.clone()), args.clone(), None),
        Some(Procedure::Helper(name)) => (None, None, Some(name.clone())),
        None => (None, None, None),
    };
    let period_ms = if let Operation::Sample { period_ms } = connector.operation { Some(period_ms) } else { None };
    FileConnector {
        id: id.to_string(),
        operation: connector.operation.word().to_owned(),
        inputs: connector.inputs.iter().map(Id::to_string).collect(),
        output: connector.output.to_string(),
        body,
        args,
        helper,
        period_ms,
    }
}

fn layout_of(behaviour: &Behaviour) -> BTreeMap<String, Place> {
    let places = behaviour.records.iter().filter_map(|(key, record)| match record {
        Record::Place(place) => Some((key.id.to_string(), *place)),
        _ => None,
    });
    places.collect()
}

fn used_helpers(connectors: &[FileConnector], library: &[&Helper]) -> Vec<FileHelper> {
    let named = |helper: &Helper| connectors.iter().any(|connector| connector.helper.as_deref() == Some(&helper.name));
    let mut unread: Vec<&str> = connectors.iter().filter_map(|connector| connector.body.as_deref()).collect();
    let mut used: BTreeMap<&str, &Helper> = BTreeMap::new();
    for helper in library.iter().filter(|helper| named(helper)) {
        used.insert(&helper.name, helper);
        unread.push(&helper.body);
    }
    while let Some(text) = unread.pop() {
        for helper in library.iter().filter(|helper| calls_helper(text, &helper.name)) {
            if used.insert(&helper.name, helper).is_none() {
                unread.push(&helper.body);
            }
        }
    }
    used.into_values().map(file_helper).collect()
}

fn file_helper(helper: &Helper) -> FileHelper {
    FileHelper {
        name: helper.name.clone(),
        params: helper.params.clone(),
        body: helper.body.clone(),
        says: helper.says.clone(),
    }
}
