//! The marks of a recording: those of the run itself, and those of the file beside it that only grows.

use crate::lines::NoteLine;
use crate::read::{Entry, read_line};
use behaviour::Id;
use protocol::RecordingMark;
use std::collections::BTreeMap;

/// The marks that were made while it ran, among its lines: of each id the last line counts. Those of older versions are called
/// `note-1`, `note-2` and so on.
pub fn run_marks<'t>(lines: impl Iterator<Item = &'t str>) -> impl Iterator<Item = RecordingMark> {
    lines.filter_map(run_note).enumerate().filter_map(|(at, note)| mark(at + 1, note))
}

/// The mark that a line of a run is, if it is one. Most are none, and are not read.
#[must_use]
pub fn run_note(line: &str) -> Option<NoteLine> {
    let may_be = line.contains("\"mark\":\"note\"");
    if let Entry::Note(note) = may_be.then(|| read_line(line))? { Some(note) } else { None }
}

/// The mark that a note of a run is, by its number from 1.
#[must_use]
pub fn mark(number: usize, note: NoteLine) -> Option<RecordingMark> {
    let NoteLine { at_ms, id, until, word, sort, by, note, open, gone } = note;
    let id = id.or_else(|| Id::new(&format!("note-{number}")).ok())?;
    Some(RecordingMark { id, t: at_ms, until, word, sort, note, by, at: String::new(), open, gone })
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
