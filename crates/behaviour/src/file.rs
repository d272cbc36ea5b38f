//! `rrp-behaviour/1`: one behaviour with its helpers as one file, what `rrp replay` reads and a run is pinned to.

mod fingerprint;
mod of;
mod records;

pub use records::{Flaw, FlawKind};

use crate::{Declared, Engine, FillFrom, Lookup, Params, Place, StreamKind, Value, argument_names, as_meant};
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
    /// The behaviour's own id, for who wants the same one back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// The behaviour's name.
    pub name: String,
    /// The kind of robot, `nao` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    /// The way in which time runs, `event` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub engine: Option<Engine>,
    /// The exercise it was begun as.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exercise: Option<String>,
    /// Short words by which it is found in a library.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// The helpers it uses.
    pub helpers: Vec<FileHelper>,
    /// The streams of the behaviour.
    pub streams: Vec<FileStream>,
    /// The connectors of the behaviour; their order is part of the meaning.
    pub connectors: Vec<FileConnector>,
    /// The notes on the canvas.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<FileNote>,
    /// The titled frames around streams.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<FileGroup>,
    /// The tiles of the pad, if somebody made one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pad: Option<Vec<FileTile>>,
    /// The creation numbers of streams and connectors, by id, where they are not their position in the file.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub order: BTreeMap<String, i64>,
    /// The places of things on the canvas, by id.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub layout: BTreeMap<String, Place>,
}

impl BehaviourFile {
    /// Reads procedures as they are meant in which signs only look right, as word processors and wide keyboards write them;
    /// those in which a number may be read in two ways stay.
    pub fn read_as_meant(&mut self) {
        let looks_right = |body: &str| !body.is_ascii() || body.contains(',');
        for helper in self.helpers.iter_mut().filter(|helper| looks_right(&helper.body)) {
            mean(&mut helper.body, &helper.params);
        }
        let names: Lookup<&str, &str> = self.streams.iter().map(|stream| (&*stream.id, &*stream.name)).filled();
        for connector in &mut self.connectors {
            if !connector.body.as_deref().is_some_and(looks_right) {
                continue;
            }
            let inputs = connector.inputs.iter().map(|id| names.get(&**id).copied().unwrap_or_default());
            let arguments = connector.args.clone().unwrap_or_else(|| argument_names(inputs));
            connector.body.iter_mut().for_each(|body| mean(body, &arguments));
        }
    }
}

fn mean(body: &mut String, arguments: &[String]) {
    if let [meant] = &as_meant(body, arguments)[..] {
        body.clone_from(&meant.body);
    }
}

/// A helper in a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileHelper {
    /// The name of the helper.
    pub name: String,
    /// The names of the helper's parameters.
    pub params: Vec<String>,
    /// The procedure of the helper, as text.
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

/// A stream in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct FileStream {
    /// The id of the stream.
    pub id: String,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// The name of the stream.
    pub name: String,
    /// The name of the stream's device, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The device's parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub params: Option<Params>,
    /// The parts of the body it uses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resources: Option<Vec<String>>,
    /// The priority of an action when two want one part of the body: the higher one wins.
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
    /// The id of the connector.
    pub id: String,
    /// The connector's word.
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
    /// A duration, in milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_ms: Option<u64>,
    /// A value to start from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Value>,
}

/// A note in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileNote {
    /// The id of the note.
    pub id: String,
    /// The text of the note.
    pub text: String,
    /// The name of the person who wrote it last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// The time when it was written last, in milliseconds since 1970.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
}

/// A titled frame around streams in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileGroup {
    /// The id of the group.
    pub id: String,
    /// The title of the group.
    pub title: String,
    /// The streams in it, by id. Some may be gone.
    pub streams: Vec<String>,
    /// Drawn as one box; no if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub folded: Option<bool>,
}

/// A tile of the pad in a file: an action of the robot, a sense that is pretended, or a word.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileTile {
    /// The key of the tile, 1 to 9.
    pub key: u8,
    /// The words on it.
    pub label: String,
    /// The action that the robot does by hand.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The parameters of the action.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub params: Option<Params>,
    /// The stream whose sense is pretended, by id. It may be gone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    /// The value that the action or the sense is told; null if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// The word by which a moment is marked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub word: Option<String>,
    /// True if the word marks a span; no if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub span: Option<bool>,
    /// True if a press asks first; no if absent. A word never asks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asks: Option<bool>,
}
