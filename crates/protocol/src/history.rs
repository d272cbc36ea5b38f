//! What a page of the history of a behaviour tells.

use behaviour::Id;
use serde::{Deserialize, Serialize};

/// The most changes of one page of a history.
pub const HISTORY_MAX_LINES: usize = 100;

/// One change in the history of a behaviour, without what it changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct HistoryLine {
    /// The revision that it made.
    pub revision: u64,
    /// The name of the change.
    pub op: Id,
    /// Who made it, as they were called then.
    pub author: String,
    /// The id of the person, as in the list of people; none in changes of older versions and of the server.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<Id>,
    /// What it does, in a few words.
    pub label: String,
    /// When it was made, in milliseconds since 1970.
    pub at_ms: u64,
    /// The change that it takes back; if that took one back itself, this one does it again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undoes: Option<Id>,
    /// Whether it took a stream or a connector away, which [`crate::Request::BringBack`] brings back.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub removes: bool,
}
