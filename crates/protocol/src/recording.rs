//! What is recorded of runs.

use serde::{Deserialize, Serialize};

/// A recording under way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Recorded {
    /// Its file.
    pub file: String,
    /// Lines that could not be written in time and are missing.
    pub lost: u64,
    /// Why nothing more is written, if so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trouble: Option<String>,
}

/// A recording that is kept, at [`crate::RECORDINGS_PATH`] under its file's name.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Recording {
    /// Its file.
    pub file: String,
    /// The name of the robot; empty if it is not known.
    #[serde(default)]
    pub robot: String,
    /// The name of the behaviour.
    pub name: String,
    /// The revision that ran at Start.
    pub revision: u64,
    /// When it began: `2026-11-21T18:34:06Z`.
    pub began: String,
    /// Its size.
    pub bytes: u64,
    /// Whether its last lines are missing: the disk was full, or the server ended in the middle.
    #[serde(default)]
    pub cut_off: bool,
}
