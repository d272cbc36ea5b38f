//! What the library page asks and gets: pages of behaviours, their pictures, and what they have to do with each other.

use behaviour::{Id, RecordId, StreamKind};
use serde::{Deserialize, Serialize};

/// The most lines of one page of the list.
pub const LIST_MAX_LINES: u32 = 50;
/// The most pictures in one answer.
pub const PICTURES_MAX: usize = 50;
/// The most characters that are searched for.
pub const WORDS_MAX_CHARS: usize = 200;
/// The most lines of an answer about uses, drivers or likeness; the answer says how many there are altogether.
pub const FOUND_MAX: usize = 200;

/// Which behaviours, in which order, from where on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
pub struct ListQuery {
    /// Where to look.
    pub place: Place,
    /// Words that must all occur, in any case, in names, streams, notes or procedures; empty for everything.
    pub words: String,
    /// Only those that this person made.
    pub owner: Option<String>,
    /// The order.
    pub sort: Sort,
    /// After which line the page begins.
    pub after: Option<Cursor>,
    /// How many lines, at most [`LIST_MAX_LINES`].
    pub most: u32,
}

impl Default for ListQuery {
    fn default() -> Self {
        Self {
            place: Place::Here,
            words: String::new(),
            owner: None,
            sort: Sort::Changed,
            after: None,
            most: LIST_MAX_LINES,
        }
    }
}

/// Where to look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Place {
    /// Everything that is not in the bin.
    #[default]
    Here,
    /// The bin.
    Bin,
}

/// The order of the lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Sort {
    /// Last changed (in the bin: removed) first.
    #[default]
    Changed,
    /// By name.
    Name,
}

/// Where the next page begins; given back as it came.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Cursor {
    /// When the line before it was changed, in milliseconds since 1970.
    pub changed_ms: u64,
    /// The name of the line before it, as names are ordered.
    pub name_key: String,
    /// Its id.
    pub id: Id,
}

/// A behaviour or template in a list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Summary {
    /// Its id; for a template its name in files.
    pub id: String,
    /// Its name.
    pub name: String,
    /// The number of changes ever made; 0 for a template.
    pub revision: u64,
    /// When it was changed last (in the bin: removed), in milliseconds since 1970.
    pub changed_ms: u64,
    /// Who changed or removed it last; for a template what it does, in a sentence.
    pub by: String,
    /// Who made it; nobody for a template.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub owner: String,
    /// How many streams it has.
    pub streams: u32,
    /// What its graph looks like: for a template.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<Picture>,
}

/// Whose picture is wanted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PictureOf {
    /// Which behaviour.
    pub behaviour: Id,
    /// At least as new as this revision.
    pub revision: u64,
}

/// The outlines of a graph: where its streams stand and which lead to which.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Picture {
    /// Its streams, at most [`Picture::STREAMS_MAX`].
    pub streams: Vec<PictureStream>,
    /// From which stream to which values flow, as places in `streams`.
    pub lines: Vec<[u16; 2]>,
}

impl Picture {
    /// The most streams that a picture shows.
    pub const STREAMS_MAX: usize = 200;
}

/// One stream in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PictureStream {
    /// The middle of its top edge, to the right, in canvas units.
    pub x: f32,
    /// Its top edge, downwards.
    pub y: f32,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
}

/// One use of a helper.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Used {
    /// The behaviour with the connector, or [`crate::LIBRARY`].
    pub behaviour: Id,
    /// The behaviour's name, or in the library the other helper's name.
    pub name: String,
    /// The connector, or the other helper.
    pub record: RecordId,
    /// Through which other helper; none if it uses the helper itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub through: Option<String>,
}

/// A behaviour that drives an action.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Driver {
    /// Which.
    pub behaviour: Id,
    /// Its name.
    pub name: String,
    /// The names of the sensor streams that lead to the action.
    pub sensors: Vec<String>,
}

/// An action that several behaviours drive.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Contested {
    /// The action, by its name in the catalogue.
    pub actuator: String,
    /// Some of the behaviours, id and name.
    pub behaviours: Vec<(Id, String)>,
    /// How many there are altogether.
    pub count: u64,
}

/// A behaviour that uses the same senses and actions as another.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Similar {
    /// Which.
    pub behaviour: Id,
    /// Its name.
    pub name: String,
    /// How many different senses and actions both use.
    pub shared: u32,
}
