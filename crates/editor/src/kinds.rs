//! Small words of an open program: what is selected, how saving goes, what is not saved yet.

use behaviour::{Id, Kind, RecordId};
use phrase::Phrase;

/// The state of saving; the number counts changes that wait.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Saving {
    #[default]
    Saved,
    Saving,
    Offline(usize),
    /// The server is there, but its store is not; why, if the server said so.
    Away(usize, Option<Phrase>),
}

/// The one thing a person has chosen.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Selected {
    Stream(Id),
    Connector(Id),
    Note(Id),
    Group(Id),
}

impl Selected {
    /// Returns the id of what is selected.
    pub fn id(&self) -> &Id {
        match self {
            Self::Stream(id) | Self::Connector(id) | Self::Note(id) | Self::Group(id) => id,
        }
    }

    /// The record that it is.
    pub fn record(&self) -> RecordId {
        let kind = match self {
            Self::Stream(_) => Kind::Stream,
            Self::Connector(_) => Kind::Connector,
            Self::Note(_) => Kind::Note,
            Self::Group(_) => Kind::Group,
        };
        RecordId::new(kind, self.id())
    }
}

/// The part that gets the keyboard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FocusTarget {
    /// To a part of the graph, as soon as it is drawn.
    Part(Selected),
    /// To the graph, in which nothing is left.
    Graph,
}

/// The parts of the graph that some words mean, while somebody points at them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lit {
    pub streams: Vec<Id>,
    pub connectors: Vec<Id>,
}

/// The mark of a part of the behaviour, as long as this tab has something of it that nobody else has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnsavedMark {
    /// A change waits to be sent.
    Waits,
    /// A change was refused, as somebody was first; its author has not decided yet.
    Undecided,
}
