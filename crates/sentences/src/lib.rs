//! What a behaviour does, as sentences, and a typed sentence as a graph, in English and Japanese.
//!
//! Both directions go by one grammar: lists of what can be said (`clauses`) and of the words for it (`words`).
#![warn(missing_docs)]

mod body;
mod carried;
mod clauses;
mod does;
mod explain;
mod fits;
mod language;
mod limits;
mod numbers;
mod pattern;
mod read;
mod sentence;
mod speech;
mod test;
mod token;
mod words;

pub use explain::{AnswerSentence, Answers, TestMeasure, explain};
pub use language::{Language, NoLanguage};
pub use limits::{TestedNumber, tested_numbers};
pub use read::{
    Doubt, Draft, DraftConnector, DraftStream, TEXT_MAX_CHARS, TextReading, Understood, VagueNumber, language_of,
    looks_like_sentence, read, read_speech,
};
pub use sentence::{Choosable, LiteralPlace, Number, Piece, Sentence, SentenceChoice, SentencePart};
pub use speech::Lexicon;
pub use words::device_label;
