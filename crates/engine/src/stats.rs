//! What a run counts about itself, for the live view: plain arrays by index, read at any moment.

use behaviour::Value;
use robot::Millis;

/// Counts and last values of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// By stream.
    pub streams: Vec<StreamStats>,
    /// By connector.
    pub connectors: Vec<ConnectorStats>,
}

/// What one stream carried.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StreamStats {
    /// How many values.
    pub count: u64,
    /// The last one, and when.
    pub last: Option<(Millis, Value)>,
}

/// What one connector did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConnectorStats {
    /// How many values it gave.
    pub fired: u64,
    /// The last one it gave.
    pub last_output: Option<Value>,
    /// How many values it dropped by a fault.
    pub faults: u64,
    /// How many of the last calls in a row the caller's interrupt ended.
    pub deadlines_in_a_row: u32,
    /// The last fault.
    pub last_fault: Option<LastFault>,
}

/// A fault and what caused it.
#[derive(Clone, Debug, PartialEq)]
pub struct LastFault {
    /// When.
    pub at: Millis,
    /// In plain words.
    pub error: String,
    /// The values the procedure got, in the order of the inputs.
    pub inputs: Vec<Value>,
}
