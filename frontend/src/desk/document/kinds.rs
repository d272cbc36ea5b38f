//! The signals of each record.

use crate::live::{LiveConnector, LiveStream};
use behaviour::{Connector, Group, Note, Place, Stream};
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
