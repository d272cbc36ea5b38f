//! What was read, as a graph that can be added to a behaviour.

use behaviour::{Id, Operation, Params, StreamKind};
use serde::Serialize;
use std::ops::Range;

/// What a text was read as.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Reading {
    /// The graph; with doubts, the best guess.
    pub draft: Draft,
    /// Which words mean which part of it, in the order of the text.
    pub understood: Vec<Understood>,
    /// What was not understood; the graph can be added if there is nothing here.
    pub doubts: Vec<Doubt>,
}

/// A graph that is not in a behaviour yet.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Draft {
    /// Its streams, senses before what is made of them.
    pub streams: Vec<DraftStream>,
    /// Its connectors in the order in which values go.
    pub connectors: Vec<DraftConnector>,
}

/// A stream of a draft.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct DraftStream {
    /// The stream of the behaviour that it is; none if it is new.
    pub existing: Option<Id>,
    /// Sensor, ordinary or actuator.
    pub kind: StreamKind,
    /// Its name, which no other stream of the draft or the behaviour has.
    pub name: String,
    /// Its sense or action, by its name in the catalogue.
    pub device: Option<String>,
    /// All parameters of its device.
    pub params: Params,
    /// Whether it comes of words that were not understood.
    pub doubtful: bool,
}

/// A connector of a draft.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct DraftConnector {
    /// What it does.
    pub operation: Operation,
    /// The streams it takes from, by their numbers in the draft.
    pub inputs: Vec<usize>,
    /// The stream it gives to, by its number in the draft.
    pub output: usize,
    /// Whether it comes of words that were not understood.
    pub doubtful: bool,
}

/// Words that mean a part of a draft.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Understood {
    /// Their bytes in the text.
    pub range: Range<usize>,
    /// The streams that they mean, by their numbers.
    pub streams: Vec<usize>,
    /// The connectors that they mean, by their numbers.
    pub connectors: Vec<usize>,
}

/// Words that were not understood.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Doubt {
    /// Their bytes in the text; empty where something is missing.
    pub range: Range<usize>,
    /// What could stand there instead, at most three, the best one first; the draft has that one.
    pub suggestions: Vec<String>,
}
