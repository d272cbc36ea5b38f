//! What the library page asks and gets: pages of behaviours, their pictures, and what they have to do with each other.

use behaviour::library::{Cursor, Place, Sort};
use behaviour::{Id, StreamKind};
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
    /// Words that must all occur, in any case, in names, tags, streams, notes or procedures; empty for everything.
    pub words: String,
    /// Only those that this person made.
    pub owner: Option<String>,
    /// Only those that have this tag.
    pub tag: Option<String>,
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
            tag: None,
            sort: Sort::Changed,
            after: None,
            most: LIST_MAX_LINES,
        }
    }
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
    /// Its tags.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// What its graph looks like: for a template.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<Picture>,
}

/// A behaviour to learn with: what one begins with, and what it shall become.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Exercise {
    /// What one begins with, as a template of which the id says which exercise it is.
    pub start: Summary,
    /// What it shall become, in a sentence.
    pub goal: String,
    /// What one is asked about what it does; where there is something, it is explained and not changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub asks: Vec<ExerciseQuestion>,
}

/// A question about what a behaviour will do, of which one answer is right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ExerciseQuestion {
    /// In a sentence.
    pub ask: String,
    /// What can be answered.
    pub answers: Vec<String>,
}

impl Exercise {
    /// The text of the note by which behaviours said of which exercise they are, before their settings did.
    #[must_use]
    pub fn note(&self) -> String {
        format!("Task: {}", self.start.id)
    }
}

/// What a rehearsal of an exercise shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Tried {
    /// The goal is reached; with a sentence that says so.
    Reached(String),
    /// Something is not as it shall be.
    Missed {
        /// What, in a sentence.
        says: String,
        /// What went wrong first in a procedure, if anything did.
        fault: Option<String>,
    },
    /// There is nothing in the behaviour yet.
    Empty,
    /// It has more parts than are rehearsed.
    TooLarge,
    /// It cannot run; with the reason.
    CannotRun(String),
    /// It takes more time than a rehearsal may.
    TooLong,
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
