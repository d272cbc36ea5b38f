//! The first line of a recording: what is recorded, of which run.

use protocol::Records;
use serde::{Deserialize, Serialize};

/// The format's name and version, in the first line of what is written now.
pub const FORMAT: &str = "rrp-recording/2";
/// The beginning of the format's name in every version.
const FAMILY: &str = "rrp-recording/";

/// The first line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Header {
    /// The format, with its version.
    pub format: String,
    /// The id of the behaviour.
    pub behaviour: String,
    /// The name of the behaviour.
    pub name: String,
    /// The revision that ran at first.
    pub revision: u64,
    /// The way in which time ran: `event` or `frame`.
    pub mode: String,
    /// The length of a frame in milliseconds, in frame mode.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_ms: Option<u64>,
    /// The name of the person who started the run, or the recording of it.
    pub by: String,
    /// The time at which it began: `2026-11-21T18:34:06Z`.
    pub began: String,
    /// The number of the run.
    pub run: u64,
    /// The name of the robot.
    pub robot: String,
    /// The code of who takes part, if one was given. Never a name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub participant: Option<String>,
    /// Which session it is, if that was said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub session: Option<String>,
    /// The kinds of lines that it has.
    pub records: Records,
}

/// Something that a recording would need to give its own actions again, and does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// It is of the first form, which had neither the program nor what a continued run remembered.
    Program,
    /// Everything, as it is cut off before it said what runs.
    Everything,
    /// The readings of senses, as only marks and actions were recorded.
    Readings,
    /// The memory of a continued run, which was too large.
    Memory,
}

impl Header {
    /// True if the format is one of a recording, of any version.
    #[must_use]
    pub fn is_one(&self) -> bool {
        self.format.starts_with(FAMILY)
    }

    /// True if the recording is of the first form.
    #[must_use]
    pub fn is_first_form(&self) -> bool {
        self.format == "rrp-recording/1"
    }

    /// Returns what the recording lacks from the beginning, if anything.
    #[must_use]
    pub fn lacks(&self) -> Option<Lack> {
        if self.is_first_form() {
            Some(Lack::Program)
        } else {
            (self.records == Records::Marks).then_some(Lack::Readings)
        }
    }
}
