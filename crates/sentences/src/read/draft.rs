//! What was read, as a graph that can be added to a behaviour.

use crate::Language;
use behaviour::{Behaviour, Connector, Id, Kind, Operation, Params, Record, RecordId, Stream, StreamKind};
use serde::Serialize;
use std::ops::Range;

/// What a text was read as.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct TextReading {
    /// The graph; with doubts, the best guess.
    pub draft: Draft,
    /// Which words mean which part of it, in the order of the text.
    pub understood: Vec<Understood>,
    /// What was not understood; the graph can be added if there is nothing here.
    pub doubts: Vec<Doubt>,
    /// Words that were taken as a text though nobody quoted them, by their bytes.
    pub texts: Vec<Range<usize>>,
    /// Words that got a number because nobody said one: *near*.
    pub vague: Vec<VagueNumber>,
}

/// A word that got a number because nobody said one, and what says that number.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct VagueNumber {
    /// The range of the word in the text, in bytes.
    pub range: Range<usize>,
    /// The number that it got.
    pub value: f64,
    /// In `cm`, `m` or `%`.
    pub unit: &'static str,
    /// The text before the number and its unit, in words that say it.
    before: String,
    /// The text behind the number and its unit.
    after: String,
}

impl VagueNumber {
    /// A word that got a number, in the words of a text; `near` says that it is less, `moves` that it comes to be so.
    pub(super) fn of(
        text: &str,
        range: Range<usize>,
        number: (f64, &'static str),
        near: bool,
        moves: bool,
        language: Language,
    ) -> Self {
        let (value, unit) = number;
        let word = text.get(range.clone()).unwrap_or_default();
        let (before, after) = match language {
            Language::Japanese => (String::new(), format!("より{word}")),
            Language::English if unit == "%" => ("below ".to_owned(), String::new()),
            Language::English if moves => {
                let first = word.split_whitespace().next().unwrap_or_default();
                let verb = match first.to_lowercase().as_str() {
                    "approach" => "come",
                    "approaches" => "comes",
                    "approached" => "came",
                    "approaching" => "coming",
                    _ => first,
                };
                (format!("{verb} closer than "), String::new())
            }
            Language::English => ((if near { "closer than " } else { "farther than " }).to_owned(), String::new()),
        };
        Self { range, value, unit, before, after }
    }

    /// Words with another number, to stand in the place of the word.
    #[must_use]
    pub fn said(&self, value: f64) -> String {
        format!("{}{value} {}{}", self.before, self.unit, self.after)
    }
}

impl TextReading {
    /// Whether it can be added: nothing is in doubt, and something happens.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.doubts.is_empty() && !self.draft.connectors.is_empty()
    }
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

impl Draft {
    /// The graph as a behaviour of its own, with ids in the order of its parts. What is called by its name only, and is of
    /// no sense or action, is there as a stream without one.
    #[must_use]
    pub fn behaviour(&self) -> Behaviour {
        let mut behaviour = Behaviour::default();
        let ids: Vec<Id> = (1..=self.streams.len()).filter_map(|at| Id::new(&format!("s{at}")).ok()).collect();
        for ((order, stream), id) in (1..).zip(&self.streams).zip(&ids) {
            let (name, device, params) = (stream.name.clone(), stream.device.clone(), stream.params.clone());
            let (kind, resources, priority, hold_ms) = (stream.kind, None, None, None);
            let stream = Stream { kind, name, device, params, order, resources, priority, hold_ms };
            behaviour.records.insert(RecordId::new(Kind::Stream, id), Record::Stream(stream));
        }
        for (order, connector) in (1..).zip(&self.connectors) {
            let (Ok(id), Some(output)) = (Id::new(&format!("c{order}")), ids.get(connector.output)) else { continue };
            let inputs = connector.inputs.iter().filter_map(|input| ids.get(*input).cloned()).collect();
            let (operation, output) = (connector.operation.clone(), output.clone());
            let connector = Connector { operation, inputs, output, order };
            behaviour.records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(connector));
        }
        behaviour
    }
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
    /// Why it cannot be done, and what can be; none if nobody knows what it means.
    pub why: Option<String>,
}
