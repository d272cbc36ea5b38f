//! The marks of a recording: those of the run itself, and those of the file beside it that only grows.

use crate::lines::Note;
use crate::read::{Entry, Open};
use behaviour::Id;
use protocol::{MarkSort, RecordingMark};
use std::collections::BTreeMap;

/// The marks that were made while it ran, called `note-1`, `note-2` and so on.
pub fn run_marks(lines: Open<'_>) -> impl Iterator<Item = RecordingMark> {
    // Most lines are none, and are not read.
    let notes = lines
        .lines()
        .filter(|(_, line)| line.contains("\"note\""))
        .filter_map(|(_, line)| if let Entry::Note(note) = crate::read_line(line) { Some(note) } else { None });
    notes.enumerate().filter_map(|(at, note)| mark(at + 1, note))
}

fn mark(number: usize, Note { at_ms, by, note }: Note) -> Option<RecordingMark> {
    let id = Id::new(&format!("note-{number}")).ok()?;
    let (until, word, sort, at, gone) = (None, String::new(), MarkSort::Note, String::new(), false);
    Some(RecordingMark { id, t: at_ms, until, word, sort, note, by, at, gone })
}

/// All marks by id as they are by now, those that are gone included: the last line of each counts. A line that is none, such as
/// one that a power cut tore, is left out.
#[must_use]
pub fn all_marks(of_run: impl IntoIterator<Item = RecordingMark>, later: &str) -> BTreeMap<Id, RecordingMark> {
    let later = later.lines().filter_map(|line| serde_json::from_str::<RecordingMark>(line).ok());
    of_run.into_iter().chain(later).map(|mark| (mark.id.clone(), mark)).collect()
}

/// The marks that are there, by time.
#[must_use]
pub fn marks(of_run: impl IntoIterator<Item = RecordingMark>, later: &str) -> Vec<RecordingMark> {
    let mut marks: Vec<_> = all_marks(of_run, later).into_values().filter(|mark| !mark.gone).collect();
    marks.sort_by(|one, other| (one.t, &one.id).cmp(&(other.t, &other.id)));
    marks
}
