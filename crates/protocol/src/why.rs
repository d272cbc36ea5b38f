//! Why a value came, and why another one did not.

use behaviour::Value;
use serde::{Deserialize, Serialize};

/// The way on which a value came.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Why {
    /// The id of its stream.
    pub stream: String,
    /// The time at which it came, in milliseconds since Start.
    pub t: u64,
    /// The value.
    pub value: Value,
    /// The value itself, then the one that triggered it, and so on back to a reading.
    pub steps: Vec<WhyStep>,
}

/// A value on the way to another one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyStep {
    /// The id of the connector that gave it; none of a reading.
    pub connector: Option<String>,
    /// The id of its stream.
    pub stream: String,
    /// The time at which it came, in milliseconds since Start.
    pub t: u64,
    /// The value.
    pub value: Value,
    /// The values that the connector used besides the one that triggered it.
    pub with: Vec<WhyWith>,
}

/// A value that a connector used besides the one that triggered it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum WhyWith {
    /// The newest value of another of its inputs.
    Value {
        /// The id of its stream.
        stream: String,
        /// The time at which it came, in milliseconds since Start.
        t: u64,
        /// The value.
        value: Value,
    },
    /// The result before.
    Memory {
        /// The previous result, or the value to start from.
        memory: Value,
        /// Since when it was that, in milliseconds since Start.
        t: u64,
    },
}

/// The reasons why nothing came on a stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyNot {
    /// The id of the stream.
    pub stream: String,
    /// The connectors that kept a value back, the nearest to the stream first, then those to which nothing came. Of a past that is
    /// looked back at the nearest miss is the first, and of each test that value is told which was nearest to passing.
    pub blocked: Vec<BlockedConnector>,
}

/// A connector that kept a value back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BlockedConnector {
    /// The id of the connector.
    pub connector: String,
    /// The id of the stream from which the value came to it, or should have come.
    pub stream: String,
    /// The time at which the last value came, in milliseconds since Start; none if none came.
    pub t: Option<u64>,
    /// The value that was kept back; null if none came.
    pub value: Value,
    /// The reason.
    pub because: Because,
}

/// The reasons why a connector gave nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Because {
    /// The value did not pass.
    Kept,
    /// The procedure failed.
    Fault,
    /// It waits, for its time or for a value of another input.
    Waits,
    /// Nothing came to it.
    Nothing,
}
