//! Recordings of runs, as the page sees them.

use behaviour::Id;
use phrase::Phrase;
use serde::{Deserialize, Serialize};

/// A recording under way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Recorded {
    /// The name of the recording's file.
    pub file: String,
    /// Lines that could not be written in time and are missing.
    pub lost: u64,
    /// Why nothing more is written, if so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trouble: Option<Phrase>,
    /// The number of the oldest recordings that were removed to make room for it.
    #[serde(default, skip_serializing_if = "is_none")]
    pub gave_way: u64,
    /// The code of who takes part, if one was said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub participant: Option<String>,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference; on 32 bits it is the smaller one")]
fn is_none(count: &u64) -> bool {
    *count == 0
}

/// A recording that is kept, at [`crate::RECORDINGS_PATH`] under its file's name.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Recording {
    /// The name of the recording's file.
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
    /// The size of the file, in bytes.
    pub bytes: u64,
    /// The name of who started the run, or the recording of it; empty if that is not known.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub by: String,
    /// The session that it is part of, and what it has.
    #[serde(default, skip_serializing_if = "RecordedSession::is_plain")]
    pub session: RecordedSession,
    /// The time of its last line, in milliseconds since Start; none if that is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_ms: Option<u64>,
    /// The number of moments that were marked while it ran; none if that is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marks: Option<u64>,
    /// True if it is of the older form, which lacks the program that ran and what was pretended, refused or done by
    /// hand.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub old_form: bool,
    /// The name that somebody gave it, if somebody did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// True if it is still being written.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub goes_on: bool,
    /// True if its last lines are missing: the disk was full, or the server ended in the middle.
    #[serde(default)]
    pub cut_off: bool,
}

/// The session that a recorded run is part of, and what of it is recorded.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct RecordedSession {
    /// The code of who takes part, never a name: letters, digits, `-`, `_` and `.`, at most [`crate::CODE_MAX_CHARS`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub participant: Option<String>,
    /// Which session it is, at most [`crate::SESSION_MAX_CHARS`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub session: Option<String>,
    /// The kinds of lines that are recorded.
    #[serde(skip_serializing_if = "Records::is_all")]
    pub records: Records,
}

impl RecordedSession {
    /// True if nothing of the session was said.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }
}

/// The kinds of lines that a recording has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Records {
    /// Readings, actions and marks.
    #[default]
    All,
    /// Actions and marks, and nothing of what was sensed.
    Marks,
}

impl MarkSort {
    /// True if something only happened.
    #[must_use]
    pub fn is_note(&self) -> bool {
        *self == Self::Note
    }

    /// The word for it in exports; empty if something only happened.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Note => "",
            Self::Good => "good",
            Self::Bad => "not good",
            Self::Now => "should have",
        }
    }
}

impl Records {
    /// True if the recording has everything.
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference")]
    fn is_all(&self) -> bool {
        *self == Self::All
    }
}

/// A mark of a recording: a moment, or a span.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingMark {
    /// The id of the mark: chosen by who adds it, or `note-1`, `note-2`, … for those that were made while it ran.
    pub id: Id,
    /// The time of the moment, or of the beginning of the span, in milliseconds since Start.
    pub t: u64,
    /// The time of the end of the span, in milliseconds since Start; none for a moment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<u64>,
    /// The word of the mark, at most [`crate::MARK_WORD_MAX_CHARS`]; may be empty.
    #[serde(default)]
    pub word: String,
    /// The verdict of the mark on the moment.
    #[serde(default)]
    pub sort: MarkSort,
    /// A note of what happened, at most [`crate::MARK_MAX_CHARS`]; may be empty.
    #[serde(default)]
    pub note: String,
    /// The name of the person who wrote it.
    #[serde(default)]
    pub by: String,
    /// The time at which it was written: `2026-11-21T18:34:06Z`; empty for one that was made while it ran.
    #[serde(default)]
    pub at: String,
    /// True if it is a span of a running session that nobody ended yet.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub open: bool,
    /// True if it was removed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub gone: bool,
}

/// A change of a mark of a running session.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum MarkEdit {
    /// A span ends at the press. One that has ended stays as it is.
    End,
    /// A note joins the mark, in the place of what it had; at most [`crate::MARK_MAX_CHARS`].
    Note(String),
    /// The verdict on its moment becomes this one.
    Sort(MarkSort),
    /// The mark is taken back by the client that made it, within [`crate::UNDO_MARK_MS`] of their last press. One that has
    /// not come yet stays gone when it does.
    Undo,
}

/// The verdict of a mark on its moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum MarkSort {
    /// Something happened.
    #[default]
    Note,
    /// The robot did something, and that was good.
    Good,
    /// The robot did something, and that was not good.
    Bad,
    /// It should have done something.
    Now,
}
