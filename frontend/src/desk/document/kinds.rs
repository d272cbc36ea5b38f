//! Small words of the document: what is selected, how saving goes, a record's signals, a new connector.

use crate::live::{LiveConnector, LiveStream};
use behaviour::{Connector, Id, Operation, Params, Place, Stream};
use leptos::prelude::ArcRwSignal;

/// How saving goes; the number counts changes that wait.
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Selected {
    Stream(Id),
    Connector(Id),
}

impl Selected {
    /// Its id.
    pub(crate) fn id(&self) -> &Id {
        match self {
            Self::Stream(id) | Self::Connector(id) => id,
        }
    }
}

/// What is marked on a part of the behaviour, as long as this tab has something of it that nobody else has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
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

/// A new connector.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ConnectPlan {
    pub(crate) operation: Operation,
    pub(crate) inputs: Vec<Id>,
    pub(crate) output: Output,
}

/// Where a new connector leads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Output {
    /// To a new stream: ordinary without a device, an actuator with one.
    New { name: String, device: Option<String>, params: Params },
    /// To a stream that is there.
    Existing(Id),
}
