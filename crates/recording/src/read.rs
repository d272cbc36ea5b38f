//! The lines of a recording as they are read again, whatever version wrote them.

use crate::header::Header;
use crate::lines::{EndLine, Hand, NoteLine, RefusedLine, RobotLine};
use crate::memory;
use behaviour::{BehaviourFile, Value};
use engine::Handover;
use robot::Scene;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A recording that was opened: its header, and its other lines with their numbers.
#[derive(Clone, Copy, Debug)]
pub struct OpenRecording<'t> {
    rest: &'t str,
    /// The number of lines before the rest.
    before: usize,
}

/// The text is no recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoRecording;

/// One line.
#[derive(Clone, Debug)]
pub enum Entry {
    /// A reading, or what an action was told.
    Value {
        /// The time of the value, in milliseconds since Start.
        at_ms: u64,
        /// The id of its stream.
        stream: String,
        /// The value.
        value: Value,
        /// The name of the person who pretended it, if it was not sensed.
        by: Option<String>,
    },
    /// A value that a procedure dropped.
    Fault {
        /// The time of the drop, in milliseconds since Start.
        at_ms: u64,
        /// The id of its connector.
        connector: String,
        /// The reason, in words.
        error: String,
    },
    /// A value that the robot did not do.
    Refused(RefusedLine),
    /// An action that somebody had it do by hand.
    Hand(Hand),
    /// An edited behaviour goes on.
    Applied {
        /// The last instant of what ran before.
        at_ms: u64,
        /// The revision that follows.
        revision: u64,
    },
    /// The behaviour that runs from here on.
    File {
        /// From when.
        at_ms: u64,
        /// The revision of the behaviour.
        revision: u64,
        /// All of it; none if this program cannot read it.
        file: Option<Box<BehaviourFile>>,
    },
    /// The memory of the run at this point.
    Memory {
        /// The time of this point, in milliseconds since Start.
        at_ms: u64,
        /// The memory; none if it was too large to be kept.
        memory: Option<Box<Handover>>,
    },
    /// The state of the robot.
    Robot(Box<RobotLine>),
    /// The simulated room.
    Room {
        /// The time of this state of the room, in milliseconds since Start.
        at_ms: u64,
        /// The things that stand in it.
        scene: Box<Scene>,
    },
    /// A moment that somebody marked.
    Note(NoteLine),
    /// Lines are missing here.
    Gap {
        /// The number of lines that are missing.
        lost: u64,
    },
    /// It has as many bytes as it may have, and ends here.
    Full,
    /// The last line.
    End(EndLine),
    /// Something that this program does not know.
    Unknown,
}

/// Opens the text of a recording.
///
/// # Errors
/// If its first line is not that of a recording.
pub fn open(text: &str) -> Result<(Header, OpenRecording<'_>), NoRecording> {
    let mut before = 0;
    let mut rest = text;
    while let Some((line, after)) = rest.split_once('\n') {
        before += 1;
        rest = after;
        if !line.trim().is_empty() {
            return header(line).map(|header| (header, OpenRecording { rest, before })).ok_or(NoRecording);
        }
    }
    header(rest).map(|header| (header, OpenRecording { rest: "", before })).ok_or(NoRecording)
}

fn header(line: &str) -> Option<Header> {
    serde_json::from_str::<Header>(line).ok().filter(Header::is_one)
}

impl<'t> OpenRecording<'t> {
    /// Returns its other lines, each with its number. A last line that is not whole is left out.
    pub fn lines(self) -> impl Iterator<Item = (usize, &'t str)> {
        let (whole, last) = self.rest.rsplit_once('\n').unwrap_or(("", self.rest));
        // A person who edited it may have left out the last end of a line.
        let last = Some(last).filter(|last| serde_json::from_str::<Value>(last).is_ok());
        let lines = whole.lines().chain(last);
        (self.before + 1..).zip(lines).filter(|(_, line)| !line.trim().is_empty())
    }

    /// Returns its other lines as entries.
    pub fn entries(self) -> impl Iterator<Item = Entry> {
        self.lines().map(|(_, line)| read_line(line))
    }
}

/// Returns what a line says. A line of a writer that says more than this program knows is understood as far as it goes.
#[must_use]
pub fn read_line(text: &str) -> Entry {
    read(text).unwrap_or(Entry::Unknown)
}

fn read(text: &str) -> Option<Entry> {
    let line: Value = serde_json::from_str(text).ok()?;
    let words = |name: &str| line.field(name).and_then(Value::as_text).map(str::to_owned);
    let at_ms = number(&line, "t");
    if let Some(mark) = line.field("mark") {
        return marked(mark.as_text()?, &line, text);
    }
    if line.field("hand").is_some() {
        return whole(text).map(Entry::Hand);
    }
    if line.field("refused").is_some() {
        return whole(text).map(Entry::Refused);
    }
    if let Some(connector) = words("connector") {
        return Some(Entry::Fault { at_ms: at_ms?, connector, error: words("error")? });
    }
    let (stream, value) = (words("stream")?, line.field("value")?.clone());
    Some(Entry::Value { at_ms: at_ms?, stream, value, by: words("by") })
}

fn marked(mark: &str, line: &Value, text: &str) -> Option<Entry> {
    let at_ms = number(line, "t");
    Some(match mark {
        "applied" => Entry::Applied { at_ms: at_ms?, revision: number(line, "revision")? },
        "file" => {
            let (revision, file) = (number(line, "revision").unwrap_or(0), file(text).map(Box::new));
            Entry::File { at_ms: at_ms.unwrap_or(0), revision, file }
        }
        "memory" => Entry::Memory { at_ms: at_ms.unwrap_or(0), memory: memory::read(text).map(Box::new) },
        "robot" => Entry::Robot(whole(text)?),
        "room" => Entry::Room { at_ms: at_ms?, scene: Box::new(scene(text)?) },
        "note" => Entry::Note(whole(text)?),
        "gap" => Entry::Gap { lost: number(line, "lost").unwrap_or(0) },
        "full" => Entry::Full,
        "end" => Entry::End(whole(text)?),
        _ => return None,
    })
}

fn whole<T: DeserializeOwned>(text: &str) -> Option<T> {
    serde_json::from_str(text).ok()
}

fn file(text: &str) -> Option<BehaviourFile> {
    #[derive(Deserialize)]
    struct FileLine {
        file: BehaviourFile,
    }
    whole::<FileLine>(text).map(|kept| kept.file)
}

fn scene(text: &str) -> Option<Scene> {
    #[derive(Deserialize)]
    struct RoomLine {
        scene: Scene,
    }
    whole::<RoomLine>(text).map(|kept| kept.scene)
}

fn number(line: &Value, name: &str) -> Option<u64> {
    let Some(&Value::Int(number)) = line.field(name) else { return None };
    u64::try_from(number).ok()
}

#[cfg(test)]
mod tests {
    use super::{Entry, Header, open};
    use crate::header::FORMAT;

    #[test]
    fn a_last_line_counts_if_it_is_whole() {
        let header = Header { format: FORMAT.to_owned(), ..Header::default() };
        let header = crate::json::json(&header);
        let read = |rest: &str| {
            let text = format!("{header}\n{rest}");
            let (_, rest) = open(&text).unwrap();
            rest.entries().collect::<Vec<_>>()
        };
        let full = r#"{"t":1,"mark":"full"}"#;
        assert!(matches!(read(full)[..], [Entry::Full]), "without its end");
        assert!(matches!(read(&format!("{full}\n"))[..], [Entry::Full]));
        assert!(matches!(read(&format!("{full}\n{{\"t\":2,\"ma"))[..], [Entry::Full]), "cut off");
        assert!(read("é").is_empty() && read("").is_empty(), "no line at all");
    }
}
