//! Small words of the desk: what is selected, which dialog is open, how saving goes.

use crate::live::{LiveConnector, LiveStream};
use behaviour::connectors::Spec;
use behaviour::{Connector, Id, Operation, Params, Place, Stream};
use leptos::prelude::ArcRwSignal;

/// How the link to the server is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum LinkState {
    #[default]
    Connecting,
    Online,
    Offline,
}

/// How saving goes; the number counts changes that wait.
#[expect(clippy::enum_variant_names, reason = "saving is saved, saving, offline or away")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Saving {
    #[default]
    Saved,
    Saving,
    Offline(usize),
    /// The server is there, but its store is not.
    Away(usize),
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

/// The open dialog.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dialog {
    /// The thesis's Operation dialog: a new connector out of `input`, or the existing `connector`. `kind` is the one
    /// that is chosen at first.
    Operation { input: Id, connector: Option<Id>, kind: &'static Spec },
    /// Name and parameters of a stream.
    EditStream(Id),
    /// Choosing a sense.
    AddSensor,
    /// A helper of the library, or a new one.
    Helper(Option<Id>),
    /// Choosing which helper to edit.
    Helpers,
    /// Load program.
    Programs,
    /// Save as file.
    SaveFile,
    /// Add a program.
    AddProgram,
    /// Remove the open program.
    RemoveProgram,
    /// Rename the open program.
    RenameProgram,
    /// Sending a value to a sensor stream by hand.
    Stimulate(Id),
    /// All problems.
    Problems,
    /// Adding a simulated robot.
    AddRobot,
    /// Removing the robot that this tab looks at.
    RemoveRobot,
    /// What others see as one's name.
    MyName,
    /// Keys and gestures.
    Help,
}

/// One sentence for the person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Notice {
    /// Grows with every notice, so that the same sentence twice is two notices.
    pub(crate) number: u32,
    pub(crate) text: String,
    /// True for refusals and faults.
    pub(crate) bad: bool,
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
