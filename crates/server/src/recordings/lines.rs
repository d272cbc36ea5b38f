//! The lines of a recording: readings and outputs exactly as `rrp replay` reads and prints them, and marks between.

use super::About;
use behaviour::{BehaviourFile, Engine, Value};
use engine::{ConnectorIx, IndexVec, StreamIx};
use serde::Serialize;
use std::fmt::Write;

/// The format's name and version, in the first line.
const FORMAT: &str = "rrp-recording/1";

/// The first line.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Header<'a> {
    format: &'static str,
    behaviour: &'a str,
    name: &'a str,
    revision: u64,
    mode: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    frame_ms: Option<u64>,
    by: &'a str,
    began: &'a str,
    run: u64,
    robot: &'a str,
}

impl<'a> Header<'a> {
    pub(super) fn of(about: &About<'a>, began: &'a str) -> Self {
        let (mode, frame_ms) = match about.file.engine.unwrap_or_default() {
            Engine::Event => ("event", None),
            Engine::Frame { frame_ms } => ("frame", Some(frame_ms)),
        };
        let (behaviour, name) = (about.behaviour.as_str(), about.file.name.as_str());
        Self {
            format: FORMAT,
            behaviour,
            name,
            revision: about.revision,
            mode,
            frame_ms,
            by: about.by,
            began,
            run: about.run,
            robot: about.robot,
        }
    }
}

/// One line to be, small enough to wait.
#[derive(Clone, Debug)]
pub(super) enum Line {
    /// A reading or an output.
    Value { at_ms: u64, stream: StreamIx, value: Value },
    /// A value that a procedure dropped.
    Fault { at_ms: u64, connector: ConnectorIx, error: String },
    /// An edited behaviour goes on from here.
    Applied { at_ms: u64, revision: u64 },
    /// Somebody marked a moment.
    Note(Note),
    /// The last line.
    End(End),
}

/// A moment that somebody marked.
#[derive(Clone, Debug)]
pub(crate) struct Note {
    /// When.
    pub(crate) at_ms: u64,
    /// Who.
    pub(crate) by: String,
    /// What happened; may be empty.
    pub(crate) note: String,
}

/// How a recording ends.
#[derive(Clone, Debug, Default)]
pub(super) struct End {
    /// The time of the last line.
    pub(super) at_ms: u64,
    /// The last instant whose ticks ran; none if none did.
    pub(super) closed: Option<u64>,
    /// Values that the clock dropped because a procedure took too long: a replay has no clock.
    pub(super) late: u64,
    /// Why.
    pub(super) why: String,
}

/// The ids of streams and connectors as JSON texts.
#[derive(Debug)]
pub(super) struct Names {
    streams: IndexVec<StreamIx, String>,
    connectors: IndexVec<ConnectorIx, String>,
}

impl Names {
    pub(super) fn of(file: &BehaviourFile) -> Self {
        Self {
            streams: file.streams.iter().map(|stream| json(&stream.id)).collect(),
            connectors: file.connectors.iter().map(|connector| json(&connector.id)).collect(),
        }
    }

    /// Appends a line.
    pub(super) fn write(&self, line: &Line, to: &mut String) {
        let written = match line {
            Line::Value { at_ms, stream, value } => {
                writeln!(to, r#"{{"t":{at_ms},"stream":{},"value":{}}}"#, self.streams[*stream], json(value))
            }
            Line::Fault { at_ms, connector, error } => {
                writeln!(to, r#"{{"t":{at_ms},"connector":{},"error":{}}}"#, self.connectors[*connector], json(error))
            }
            Line::Applied { at_ms, revision } => {
                writeln!(to, r#"{{"t":{at_ms},"mark":"applied","revision":{revision}}}"#)
            }
            Line::Note(Note { at_ms, by, note }) => {
                writeln!(to, r#"{{"t":{at_ms},"mark":"note","by":{},"note":{}}}"#, json(by), json(note))
            }
            Line::End(End { at_ms, closed, late, why }) => {
                let (closed, why) = (json(closed), json(why));
                writeln!(to, r#"{{"t":{at_ms},"mark":"end","closed":{closed},"late":{late},"why":{why}}}"#)
            }
        };
        debug_assert!(written.is_ok(), "a text takes whatever is written");
    }
}

/// As JSON: floats bit for bit, whole numbers without a point.
pub(super) fn json<T: Serialize + ?Sized>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
