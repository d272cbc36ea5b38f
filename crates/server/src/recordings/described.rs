//! The description of a recording in a list: read from its first and its last line alone, however long it is.

use super::titles::title;
use protocol::{RecordedSession, Recording};
use recording::{Entry, read_line};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// The longest first line that is read, in bytes.
const HEADER_MAX_BYTES: u64 = 16 << 10;
/// The most bytes that are read of its end.
const END_MAX_BYTES: u64 = 16 << 10;

/// A recording for the list; none if the file is none.
pub(super) fn described(path: &Path, bytes: u64) -> Option<Recording> {
    let mut file = File::open(path).ok()?;
    let mut line = String::new();
    BufReader::new((&mut file).take(HEADER_MAX_BYTES)).read_line(&mut line).ok()?;
    let (header, _) = recording::open(&line).ok()?;
    let end = end(&mut file, bytes);
    let (old_form, marks) = (header.is_first_form(), end.marks);
    let session = RecordedSession { participant: header.participant, session: header.session, records: header.records };
    Some(Recording {
        file: path.file_name()?.to_str()?.to_owned(),
        robot: header.robot,
        name: header.name,
        revision: header.revision,
        began: header.began,
        bytes,
        by: header.by,
        session,
        length_ms: end.at_ms,
        marks,
        old_form,
        title: title(path),
        goes_on: false,
        cut_off: !end.is_whole,
    })
}

/// The end of a recording, as far as its last bytes say so.
#[derive(Default)]
struct RecordingEnd {
    is_whole: bool,
    at_ms: Option<u64>,
    marks: Option<u64>,
}

fn end(file: &mut File, bytes: u64) -> RecordingEnd {
    let mut tail = Vec::new();
    let from = SeekFrom::Start(bytes.saturating_sub(END_MAX_BYTES));
    if file.seek(from).and_then(|_| file.take(END_MAX_BYTES).read_to_end(&mut tail)).is_err() {
        return RecordingEnd::default();
    }
    let tail = String::from_utf8_lossy(&tail);
    let Some((whole, torn)) = tail.rsplit_once('\n') else { return RecordingEnd::default() };
    let last = whole.lines().next_back().map(read_line);
    let at_ms = whole.lines().rev().find_map(|line| time(&read_line(line)));
    match last {
        Some(Entry::End(end)) if torn.is_empty() => RecordingEnd { is_whole: true, at_ms, marks: end.marks },
        last => RecordingEnd { is_whole: torn.is_empty() && matches!(last, Some(Entry::Full)), at_ms, marks: None },
    }
}

/// The time of a line in the order of logical time.
fn time(entry: &Entry) -> Option<u64> {
    match entry {
        Entry::Value { at_ms, .. } | Entry::Fault { at_ms, .. } | Entry::Applied { at_ms, .. } => Some(*at_ms),
        Entry::End(end) => Some(end.at_ms),
        Entry::File { .. }
        | Entry::Refused(_)
        | Entry::Hand(_)
        | Entry::Memory { .. }
        | Entry::Robot(_)
        | Entry::Room { .. }
        | Entry::Note(_)
        | Entry::Gap { .. }
        | Entry::Full
        | Entry::Unknown => None,
    }
}
