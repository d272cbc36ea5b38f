//! Sentences as the page shows them: phrases that mean parts of the graph, made of words and of what can be changed in place.

use behaviour::Id;
use protocol::ProgramSentence;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What one action does, and when.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Sentence {
    /// The stream of the action.
    pub action: Id,
    /// Its phrases in the order of reading; their texts in a row are the sentence.
    pub phrases: Vec<SentencePart>,
}

impl Sentence {
    /// Returns it as pages show it that do not make sentences: cut where it begins to say what is done.
    #[must_use]
    pub fn told(&self) -> ProgramSentence {
        let action = self.phrases.iter().rposition(|phrase| phrase.streams.contains(&self.action));
        let (lead, does) = self.phrases.split_at(action.unwrap_or(self.phrases.len().saturating_sub(1)));
        let text =
            |phrases: &[SentencePart]| phrases.iter().flat_map(|phrase| &phrase.pieces).map(Piece::text).collect();
        let connector = self.phrases.last().and_then(|phrase| phrase.connectors.first()).cloned();
        ProgramSentence { lead: text(lead), does: text(does), connector }
    }
}

/// The words that one part of the graph means.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SentencePart {
    /// Its words, with spaces and signs.
    pub pieces: Vec<Piece>,
    /// The streams of the part, none for words like “Otherwise”.
    pub streams: Vec<Id>,
    /// The connectors of the part.
    pub connectors: Vec<Id>,
}

/// Words, or something that can be changed in place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Piece {
    /// Words as they are.
    Text(String),
    /// A number with its unit.
    Number(Number),
    /// One of several words.
    Choice(SentenceChoice),
}

/// A number that can be changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Number {
    /// How it stands in the sentence, with its unit: `40 cm`, `second` for one second.
    pub text: String,
    /// The number, in `unit`.
    pub value: f64,
    /// Its unit as it is shown; empty if it has none.
    pub unit: String,
    /// The smallest that makes sense, in `unit`.
    pub min: f64,
    /// The largest that makes sense, in `unit`.
    pub max: f64,
    /// One press of plus or minus, in `unit`.
    pub step: f64,
    /// Where it is kept.
    pub at: LiteralPlace,
    /// What is kept is the value times this: 1000 for seconds that are kept as milliseconds.
    pub scale: f64,
}

/// A choice that can be changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SentenceChoice {
    /// How it stands in the sentence.
    pub text: String,
    /// What there is to choose.
    pub options: Vec<Choosable>,
    /// Which of them is chosen: its `value`.
    pub chosen: String,
    /// Where it is kept.
    pub at: LiteralPlace,
}

/// One that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Choosable {
    /// What is kept.
    pub value: String,
    /// What it is called.
    pub words: String,
}

/// Where something is kept that can be changed in a sentence.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum LiteralPlace {
    /// These bytes of the body of a connector.
    Body {
        /// The connector.
        connector: Id,
        /// The first byte.
        start: usize,
        /// The byte after the last one.
        end: usize,
    },
    /// The duration of a connector, in milliseconds.
    Period {
        /// The connector.
        connector: Id,
    },
    /// A parameter of a stream's device.
    Param {
        /// The stream.
        stream: Id,
        /// The parameter's name.
        param: String,
    },
}

impl Sentence {
    /// The plain sentence.
    #[must_use]
    pub fn text(&self) -> String {
        self.to_string()
    }
}

impl SentencePart {
    /// Its plain words.
    #[must_use]
    pub fn text(&self) -> String {
        self.pieces.iter().map(Piece::text).collect()
    }
}

impl Piece {
    /// How it stands in the sentence.
    #[must_use]
    pub fn text(&self) -> &str {
        match self {
            Self::Text(text) => text,
            Self::Number(number) => &number.text,
            Self::Choice(choice) => &choice.text,
        }
    }
}

impl fmt::Display for Sentence {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let mut pieces = self.phrases.iter().flat_map(|phrase| &phrase.pieces);
        pieces.try_for_each(|piece| to.write_str(piece.text()))
    }
}
