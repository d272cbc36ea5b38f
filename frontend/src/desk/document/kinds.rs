//! Small words of the document: a record's signals, a new connector.

use super::rewire::Gap;
use crate::live::{LiveConnector, LiveStream};
use behaviour::{Connector, Group, Id, Note, Operation, Params, Place, Stream};
use leptos::prelude::{ArcMemo, ArcRwSignal};

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
