//! Names of records that never change: an id, and what kind of record it names.

use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// The id of the behaviour that holds the helper library. It is edited like any other, but has no settings record, is
/// never listed and never goes to the bin.
pub const LIBRARY: &str = "library";

/// The longest id, in characters.
pub(crate) const ID_MAX_CHARS: usize = 64;

/// The reasons why a text is no id. [`std::fmt::Display`] says each in a few English words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BadId {
    /// This text is empty, longer than 64 characters or has a character outside the set.
    Id(String),
    /// This text is not written like the id of a record.
    RecordId(String),
    /// No kind of record has this word.
    Kind(String),
}

impl std::error::Error for BadId {}

/// A short text that names one thing for ever. 1 to 64 characters out of `A-Z a-z 0-9 _ -`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(Arc<str>);

impl Id {
    /// An id from a text.
    ///
    /// # Errors
    /// The text, if it is empty, longer than 64 characters or has a character outside the set.
    pub fn new(text: &str) -> Result<Self, BadId> {
        let fits = (1..=ID_MAX_CHARS).contains(&text.len())
            && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-');
        if fits { Ok(Self(Arc::from(text))) } else { Err(BadId::Id(text.to_owned())) }
    }

    /// The id of a UUID handed in by the caller.
    #[must_use]
    pub fn from_uuid(uuid: uuid::Uuid) -> Self {
        Self(Arc::from(uuid.simple().to_string()))
    }

    /// The text.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Id {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(&self.0)
    }
}

impl FromStr for Id {
    type Err = BadId;
    fn from_str(text: &str) -> Result<Self, BadId> {
        Self::new(text)
    }
}

impl Serialize for Id {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&self.0)
    }
}

impl<'de> Deserialize<'de> for Id {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let text = String::deserialize(from)?;
        Self::new(&text).map_err(serde::de::Error::custom)
    }
}

/// The kinds of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// The name and choices of the behaviour; there is one, with id `behaviour`.
    Settings,
    /// A helper of the shared library.
    Helper,
    /// A stream.
    Stream,
    /// A connector.
    Connector,
    /// The place of a stream, connector, note or folded group; it has the id of what it places.
    Place,
    /// A note on the canvas.
    Note,
    /// A titled frame around streams.
    Group,
    /// The tiles that people press beside a session; there is one at most, with id `pad`.
    Pad,
}

const WORDS: [(Kind, &str); 8] = [
    (Kind::Settings, "settings"),
    (Kind::Helper, "helper"),
    (Kind::Stream, "stream"),
    (Kind::Connector, "connector"),
    (Kind::Place, "place"),
    (Kind::Note, "note"),
    (Kind::Group, "group"),
    (Kind::Pad, "pad"),
];

impl Kind {
    /// The word used in ids: `stream`, `connector`, ...
    #[must_use]
    pub fn word(self) -> &'static str {
        WORDS[self as usize].1
    }

    /// Speaks of a record of this kind, in the middle of a sentence.
    pub(crate) fn this(self) -> Phrase {
        match self {
            Self::Settings => phrase!("this.settings", "the name or settings"),
            Self::Helper => phrase!("this.helper", "this helper"),
            Self::Stream => phrase!("this.stream", "this stream"),
            Self::Connector => phrase!("this.connector", "this connector"),
            Self::Place => phrase!("this.position", "this position"),
            Self::Note => phrase!("this.note", "this note"),
            Self::Group => phrase!("this.group", "this group"),
            Self::Pad => phrase!("this.tiles", "the tiles"),
        }
    }
}

/// The key of a record: its kind and its id, written `stream/3f2a`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RecordId {
    /// The kind of the record.
    pub kind: Kind,
    /// The id of the record, unique within its kind and behaviour.
    pub id: Id,
}

impl Phrased for RecordId {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.to_string())
    }
}

impl Phrased for Id {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.to_string())
    }
}

impl RecordId {
    /// The record `id` of kind `kind`.
    #[must_use]
    pub fn new(kind: Kind, id: &Id) -> Self {
        Self { kind, id: id.clone() }
    }

    /// The one settings record of a behaviour.
    #[must_use]
    pub fn settings() -> Self {
        Self { kind: Kind::Settings, id: Id(Arc::from("behaviour")) }
    }

    /// The one pad of a behaviour.
    #[must_use]
    pub fn pad() -> Self {
        Self { kind: Kind::Pad, id: Id(Arc::from("pad")) }
    }
}

impl fmt::Display for RecordId {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "{}/{}", self.kind.word(), self.id)
    }
}

impl FromStr for RecordId {
    type Err = BadId;
    fn from_str(text: &str) -> Result<Self, BadId> {
        let (word, id) = text.split_once('/').ok_or_else(|| BadId::RecordId(text.to_owned()))?;
        let kind = WORDS.iter().find(|(_, known)| *known == word).map(|(kind, _)| *kind);
        let kind = kind.ok_or_else(|| BadId::Kind(word.to_owned()))?;
        Ok(Self { kind, id: Id::new(id)? })
    }
}

impl Serialize for RecordId {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for RecordId {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        String::deserialize(from)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::{Id, Kind, RecordId};

    #[test]
    fn a_record_id_reads_as_it_is_written() {
        for text in [
            "stream/s0",
            "place/a-b_C",
            "settings/behaviour",
            "helper/x",
            "connector/c1",
            "note/9",
            "group/g",
            "pad/pad",
        ] {
            assert_eq!(text.parse::<RecordId>().unwrap().to_string(), text);
        }
        assert_eq!(RecordId::settings().kind, Kind::Settings);
    }

    #[test]
    fn ids_hold_nothing_that_needs_escaping() {
        for bad in ["", "a b", "ü", "a/b", &"x".repeat(65)] {
            assert!(Id::new(bad).is_err(), "{bad:?}");
        }
    }
}
