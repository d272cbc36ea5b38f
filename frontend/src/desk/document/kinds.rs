//! Small words of the document: what is selected, how saving goes, a record's signals, a new connector.

use super::rewire::Gap;
use crate::live::{LiveConnector, LiveStream};
use behaviour::{Connector, Group, Id, Kind, Note, Operation, Params, Place, RecordId, Stream};
use leptos::prelude::{ArcMemo, ArcRwSignal};

/// The state of saving; the number counts changes that wait.
#[expect(clippy::enum_variant_names, reason = "saving is saved, saving, offline or away")]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Saving {
    #[default]
    Saved,
    Saving,
    Offline(usize),
    /// The server is there, but its store is not; why, if the server said so.
    Away(usize, Option<String>),
}

/// The one thing a person has chosen.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Selected {
    Stream(Id),
    Connector(Id),
    Note(Id),
    Group(Id),
}

impl Selected {
    /// Returns the id of what is selected.
    pub(crate) fn id(&self) -> &Id {
        match self {
            Self::Stream(id) | Self::Connector(id) | Self::Note(id) | Self::Group(id) => id,
        }
    }

    /// The record that it is.
    pub(crate) fn record(&self) -> RecordId {
        let kind = match self {
            Self::Stream(_) => Kind::Stream,
            Self::Connector(_) => Kind::Connector,
            Self::Note(_) => Kind::Note,
            Self::Group(_) => Kind::Group,
        };
        RecordId::new(kind, self.id())
    }
}

/// The parts of the graph that some words mean, while somebody points at them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Lit {
    pub(crate) streams: Vec<Id>,
    pub(crate) connectors: Vec<Id>,
}

/// The mark of a part of the behaviour, as long as this tab has something of it that nobody else has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UnsavedMark {
    /// A change waits to be sent.
    Waits,
    /// A change was refused, as somebody was first; its author has not decided yet.
    Undecided,
}

/// One stream.
#[derive(Clone)]
pub(crate) struct StreamSignals {
    pub(crate) record: ArcRwSignal<Stream>,
    /// The middle of its top edge; follows the pointer while it is dragged.
    pub(crate) place: ArcRwSignal<Place>,
    pub(crate) live: ArcRwSignal<LiveStream>,
}

/// One connector.
#[derive(Clone)]
pub(crate) struct ConnectorSignals {
    pub(crate) record: ArcRwSignal<Connector>,
    pub(crate) live: ArcRwSignal<LiveConnector>,
}

/// One note.
#[derive(Clone)]
pub(crate) struct NoteSignals {
    pub(crate) record: ArcRwSignal<Note>,
    /// The middle of its top edge.
    pub(crate) place: ArcRwSignal<Place>,
}

/// One group.
#[derive(Clone)]
pub(crate) struct GroupSignals {
    pub(crate) record: ArcRwSignal<Group>,
    /// The place where its box was put; nothing if it stands in the middle of its streams.
    pub(crate) place: ArcRwSignal<Option<Place>>,
    /// The place of its box, folded or not: the middle of its top edge. Nothing if its streams are gone.
    pub(crate) at: ArcMemo<Option<Place>>,
}

/// A new connector.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ConnectPlan {
    pub(crate) operation: Operation,
    pub(crate) inputs: Vec<Id>,
    pub(crate) output: Output,
    pub(crate) spot: NewSpot,
}

/// The place of a new connector with its new stream.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum NewSpot {
    /// Below what it takes from, where there is room.
    #[default]
    Below,
    /// The stream stands there.
    At(Place),
    /// Between a stream and a connector that takes from it.
    Into(Gap),
}

/// The stream to which a new connector leads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Output {
    /// To a new stream: ordinary without a device, an actuator with one.
    New { name: String, device: Option<String>, params: Params },
    /// To a stream that is there.
    Existing(Id),
}
