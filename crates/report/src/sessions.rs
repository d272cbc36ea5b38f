//! The counts of a session, to be compared with those of others of the same participant.

use protocol::{Recording, RecordingMark};
use recording::{Entry, read_line};
use std::collections::BTreeMap;

/// A session in numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SessionNumbers {
    /// The time at which it began: `2026-11-21T18:34:06Z`.
    pub(crate) began: String,
    /// True for the one that the report is about.
    pub(crate) is_this: bool,
    /// The length in milliseconds, if it is known.
    pub(crate) length_ms: Option<u64>,
    /// By word how often and how long it was marked.
    pub(crate) words: BTreeMap<String, (u64, u64)>,
    /// The number of actions by hand.
    pub(crate) by_hand: u64,
}

impl SessionNumbers {
    /// Begins to count a session; its marks are as they are by now.
    #[must_use]
    pub fn of(recording: &Recording, marks: &[RecordingMark], is_this: bool) -> Self {
        let (began, length_ms) = (recording.began.clone(), recording.length_ms);
        Self { began, is_this, length_ms, words: words(marks), by_hand: 0 }
    }

    /// Counts a line of it. Most say nothing here, and are not read.
    pub fn count(&mut self, line: &str) {
        let is_hand =
            line.contains("\"hand\":") && matches!(read_line(line), Entry::Hand(recording::Hand { why: None, .. }));
        self.by_hand += u64::from(is_hand);
    }
}

/// By word how often and how long that was marked; a mark without a word is left out.
pub(crate) fn words(marks: &[RecordingMark]) -> BTreeMap<String, (u64, u64)> {
    let mut words: BTreeMap<String, (u64, u64)> = BTreeMap::new();
    for mark in marks.iter().filter(|mark| !mark.word.is_empty()) {
        let (count, ms) = words.entry(mark.word.clone()).or_default();
        *count += 1;
        *ms += mark.until.map_or(0, |until| until.saturating_sub(mark.t));
    }
    words
}
