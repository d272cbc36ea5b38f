//! The lines of a recording as they are written: small enough to wait until somebody has time to write them.

use crate::json::json;
use crate::memory;
use behaviour::{BehaviourFile, Id, Params, Value};
use engine::{ConnectorIx, Handover, IndexVec, StreamIx};
use protocol::{MarkSort, RecordingMark};
use robot::{Condition, Scene};
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::sync::Arc;

/// One line to be.
#[derive(Clone, Debug)]
pub enum Line {
    /// A reading, or what an action was told.
    Value {
        /// The time of the value, in milliseconds since Start.
        at_ms: u64,
        /// Of which stream.
        stream: StreamIx,
        /// The value.
        value: Value,
    },
    /// A reading that somebody pretended.
    Pretended {
        /// The time of the reading, in milliseconds since Start.
        at_ms: u64,
        /// Of which stream.
        stream: StreamIx,
        /// The value.
        value: Value,
        /// The name of the person who pretended it.
        by: Arc<str>,
    },
    /// A value that a procedure dropped.
    Fault {
        /// The time of the drop, in milliseconds since Start.
        at_ms: u64,
        /// Of which connector.
        connector: ConnectorIx,
        /// The reason, in words.
        error: String,
    },
    /// A value that an action was told and that the robot did not do.
    Refused(Box<RefusedLine>),
    /// An action that somebody had the robot do by hand.
    Hand(Box<Hand>),
    /// An edited behaviour goes on from here.
    Applied {
        /// The last instant of what ran before.
        at_ms: u64,
        /// The revision that follows.
        revision: u64,
    },
    /// The behaviour that runs from here on, with its helpers.
    File {
        /// From when.
        at_ms: u64,
        /// The revision of the behaviour.
        revision: u64,
        /// All of it.
        file: Arc<BehaviourFile>,
    },
    /// The memory, at this point, of a run that is continued or recorded from its middle on.
    Memory {
        /// The time of this point, in milliseconds since Start.
        at_ms: u64,
        /// By places in the file before it.
        memory: Box<Handover>,
    },
    /// The state of the robot, as that is new.
    Robot(Box<RobotLine>),
    /// The simulated room, as something in it moved.
    Room {
        /// The time of this state of the room, in milliseconds since Start.
        at_ms: u64,
        /// All that stands in it; of the robot only where it is.
        scene: Box<Scene>,
    },
    /// Somebody marked a moment.
    Note(NoteLine),
    /// The last line.
    End(EndLine),
}

/// A value that an action was told and that the robot did not do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RefusedLine {
    /// The time at which the robot said so, in milliseconds since Start.
    #[serde(rename = "t")]
    pub at_ms: u64,
    /// The action's stream.
    pub refused: Id,
    /// The reason, in words.
    pub why: String,
    /// The one who keeps the part of the robot that it uses, if somebody does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
    /// The number of times, if that was more than once by then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u64>,
}

/// An action that somebody had the robot do by hand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hand {
    /// The time of the press, in milliseconds since Start.
    #[serde(rename = "t")]
    pub at_ms: u64,
    /// With which action of the catalogue.
    pub hand: String,
    /// The parameters of the action.
    #[serde(default)]
    pub params: Params,
    /// The value that it was told.
    pub value: Value,
    /// The name of the person who pressed.
    pub by: String,
    /// The reason why the robot did not do it; none if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// A moment that somebody marked. Its time is that of the press, so that it may be earlier than that of the line before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoteLine {
    /// The time of the moment, in milliseconds since Start.
    #[serde(rename = "t")]
    pub at_ms: u64,
    /// The id of the mark, of which the last line counts; none in a line of an older version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<Id>,
    /// The time of the end of a span, in milliseconds since Start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<u64>,
    /// The word of the mark; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub word: String,
    /// The verdict of the mark on the moment.
    #[serde(default, skip_serializing_if = "MarkSort::is_note")]
    pub sort: MarkSort,
    /// The name of the person who marked it.
    pub by: String,
    /// A note of what happened; may be empty.
    pub note: String,
    /// True if it is a span that had not ended by then.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub open: bool,
    /// True if it was taken back.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub gone: bool,
}

impl From<RecordingMark> for NoteLine {
    fn from(mark: RecordingMark) -> Self {
        let RecordingMark { id, t, until, word, sort, note, by, at: _, open, gone } = mark;
        Self { at_ms: t, id: Some(id), until, word, sort, by, note, open, gone }
    }
}

/// The state of the robot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct RobotLine {
    /// The time of this state, in milliseconds since Start.
    #[serde(rename = "t")]
    pub at_ms: u64,
    /// The state of the link, in a word: `ready`, `degraded`, `lost`.
    pub link: String,
    /// The reason why the link is not ready, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// The state of its body.
    #[serde(flatten)]
    pub condition: Condition,
    /// The reason why it interrupted what ran; none if it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub halt: Option<String>,
}

/// The last line: how a recording ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EndLine {
    /// The time of the last line.
    #[serde(rename = "t")]
    pub at_ms: u64,
    /// The last instant whose ticks ran; none if none did.
    pub closed: Option<u64>,
    /// Values that the clock dropped because a procedure took too long: a replay has no clock.
    pub late: u64,
    /// The number of moments that were marked while it ran.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub marks: Option<u64>,
    /// The reason of the end, in words.
    pub why: String,
    /// The name of the person who ended it, if a person did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
}

/// The ids of streams and connectors as JSON texts.
#[derive(Debug)]
pub struct LineNames {
    streams: IndexVec<StreamIx, String>,
    connectors: IndexVec<ConnectorIx, String>,
}

impl LineNames {
    /// Those of a behaviour.
    #[must_use]
    pub fn of(file: &BehaviourFile) -> Self {
        Self {
            streams: file.streams.iter().map(|stream| json(&stream.id)).collect(),
            connectors: file.connectors.iter().map(|connector| json(&connector.id)).collect(),
        }
    }

    /// Appends a line.
    pub fn write(&self, line: &Line, to: &mut String) {
        let written = match line {
            Line::Value { at_ms, stream, value } => {
                writeln!(to, r#"{{"t":{at_ms},"stream":{},"value":{}}}"#, self.streams[*stream], json(value))
            }
            Line::Pretended { at_ms, stream, value, by } => {
                let (stream, value, by) = (&self.streams[*stream], json(value), json(by));
                writeln!(to, r#"{{"t":{at_ms},"stream":{stream},"value":{value},"by":{by}}}"#)
            }
            Line::Fault { at_ms, connector, error } => {
                writeln!(to, r#"{{"t":{at_ms},"connector":{},"error":{}}}"#, self.connectors[*connector], json(error))
            }
            Line::Refused(refusal) => writeln!(to, "{}", json(refusal)),
            Line::Hand(hand) => writeln!(to, "{}", json(hand)),
            Line::Applied { at_ms, revision } => {
                writeln!(to, r#"{{"t":{at_ms},"mark":"applied","revision":{revision}}}"#)
            }
            Line::File { at_ms, revision, file } => {
                writeln!(to, r#"{{"t":{at_ms},"mark":"file","revision":{revision},"file":{}}}"#, json(file))
            }
            Line::Memory { at_ms, memory } => {
                let memory = memory::written(memory).unwrap_or_else(|| "null".to_owned());
                writeln!(to, r#"{{"t":{at_ms},"mark":"memory","memory":{memory}}}"#)
            }
            Line::Robot(robot) => writeln!(to, "{}", marked("robot", robot)),
            Line::Room { at_ms, scene } => writeln!(to, r#"{{"t":{at_ms},"mark":"room","scene":{}}}"#, json(scene)),
            Line::Note(note) => writeln!(to, "{}", marked("note", note)),
            Line::End(end) => writeln!(to, "{}", marked("end", end)),
        };
        debug_assert!(written.is_ok(), "a text takes whatever is written");
    }
}

impl Line {
    /// The time of a line that stands in the order of logical time; the others say when people and the robot did something.
    #[must_use]
    pub fn logical_ms(&self) -> Option<u64> {
        match self {
            Self::Value { at_ms, .. }
            | Self::Pretended { at_ms, .. }
            | Self::Fault { at_ms, .. }
            | Self::Applied { at_ms, .. } => Some(*at_ms),
            Self::Refused(_)
            | Self::Hand(_)
            | Self::File { .. }
            | Self::Memory { .. }
            | Self::Robot(_)
            | Self::Room { .. }
            | Self::Note(_)
            | Self::End(_) => None,
        }
    }
}

/// A line that is one of a kind, with its time first.
fn marked<T: Serialize>(kind: &'static str, line: &T) -> String {
    let text = json(line);
    // Every such line begins with its time.
    text.replacen(',', &format!(r#","mark":"{kind}","#), 1)
}
