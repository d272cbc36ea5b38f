//! A new connector before it is made: what it does, what it takes from, and where it leads.

use behaviour::{Id, Operation, Params, Place};

/// Between a stream and a connector that takes from it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gap {
    /// The connector below.
    pub connector: Id,
    /// The stream above.
    pub input: Id,
}

/// A new connector.
#[derive(Clone, Debug, PartialEq)]
pub struct ConnectPlan {
    /// The work that it does.
    pub operation: Operation,
    /// The streams that it takes from.
    pub inputs: Vec<Id>,
    /// The stream that it leads to.
    pub output: Output,
    /// The place of a new stream.
    pub spot: NewSpot,
}

/// The place of a new connector with its new stream.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum NewSpot {
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
pub enum Output {
    /// To a new stream: ordinary without a device, an actuator with one.
    New {
        /// The name of the stream.
        name: String,
        /// The device, if it is an action.
        device: Option<String>,
        /// The settings of the device.
        params: Params,
    },
    /// To a stream that is there.
    Existing(Id),
}
