//! The questions and answers of the library page: pages of behaviours, their pictures, and what they have to do with
//! each other.

use behaviour::library::{Cursor, SearchPlace, Sort};
use behaviour::{Id, StreamKind};
use phrase::Phrase;
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
    pub place: SearchPlace,
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
    /// The most lines that come, at most [`LIST_MAX_LINES`].
    pub most: u32,
}

impl Default for ListQuery {
    fn default() -> Self {
        Self {
            place: SearchPlace::Here,
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
    /// The id of the behaviour; for a template its name in files.
    pub id: String,
    /// The name of the behaviour or template.
    pub name: String,
    /// The number of changes ever made; 0 for a template.
    pub revision: u64,
    /// When it was changed last (in the bin: removed), in milliseconds since 1970.
    pub changed_ms: u64,
    /// The name of who changed or removed it last; for a template what it does, in a sentence.
    pub by: String,
    /// The name of who made it; empty for a template.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub owner: String,
    /// The number of its streams.
    pub streams: u32,
    /// The tags of the behaviour.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// The picture of its graph: for a template.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<GraphOutline>,
}

/// A behaviour to learn with: what one begins with, and what it shall become.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Exercise {
    /// The behaviour with which one begins, as a template of which the id says which exercise it is.
    pub start: Summary,
    /// Says what it shall become, in a sentence.
    pub goal: Phrase,
    /// The questions about what it does; where there are some, it is explained and not changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub asks: Vec<ExerciseQuestion>,
}

/// A question about what a behaviour will do, of which one answer is right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ExerciseQuestion {
    /// In a sentence.
    pub ask: Phrase,
    /// The answers to choose from.
    pub answers: Vec<Phrase>,
}

impl Exercise {
    /// The text of the note by which behaviours said of which exercise they are, before their settings did.
    #[must_use]
    pub fn note(&self) -> String {
        format!("Task: {}", self.start.id)
    }
}

/// The result of a rehearsal of an exercise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum RehearsalResult {
    /// The goal is reached; with a sentence that says so.
    Reached(Phrase),
    /// Something is not as it shall be.
    Missed {
        /// Says what was missed, in a sentence.
        says: Phrase,
        /// The first fault of a procedure, if there was one.
        fault: Option<Phrase>,
    },
    /// There is nothing in the behaviour yet.
    Empty,
    /// It has more parts than are rehearsed.
    TooLarge,
    /// It cannot run; with the reason.
    CannotRun(Phrase),
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
pub struct GraphOutline {
    /// The streams of the graph, at most [`GraphOutline::STREAMS_MAX`].
    pub streams: Vec<PictureStream>,
    /// From which stream to which values flow, as places in `streams`.
    pub lines: Vec<[u16; 2]>,
}

impl GraphOutline {
    /// The most streams that a picture shows.
    pub const STREAMS_MAX: usize = 200;
}

/// One stream in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PictureStream {
    /// The middle of its top edge, to the right, in canvas units.
    pub x: f32,
    /// The top edge of the stream, downwards.
    pub y: f32,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
}
