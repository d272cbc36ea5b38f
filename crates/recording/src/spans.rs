//! Things that went on for a while, as bars on tracks: what is told again and again within a second is one bar.

use crate::timeline::{Happening, Timeline, TimelineEvent};

/// A pause shorter than this, in milliseconds, does not end a thing that goes on.
const JOINED_MS: u64 = 1_000;
/// The length at which something is shown that only began, in milliseconds.
const MOMENT_MS: u64 = 500;

/// The bars of one thing, by time; none overlaps another, and each lasts at least a millisecond.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpanTrack {
    /// The name of the thing that they are of: unique among the tracks.
    pub name: String,
    /// The kind of thing; none for marks.
    pub what: Option<Happening>,
    /// The bars.
    pub spans: Vec<Span>,
}

/// One bar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// From when.
    pub from_ms: u64,
    /// Until when; later than that.
    pub until_ms: u64,
    /// True if it had no length of its own.
    pub is_moment: bool,
    /// The words that were said or the value that was told.
    pub says: String,
    /// The name of the one who did it, or who kept it from being done.
    pub by: String,
}

/// The tracks of a recording: marks by their words, then what people did, what the program did, and what went wrong. What was
/// sensed is left out, as that goes on all the time.
#[must_use]
pub fn tracks(timeline: &Timeline) -> Vec<SpanTrack> {
    let mut tracks: Vec<SpanTrack> = Vec::new();
    for mark in &timeline.marks {
        let name = if mark.word.is_empty() { "marks".to_owned() } else { format!("mark: {}", mark.word) };
        let until = mark.until.filter(|until| *until > mark.t);
        let (until_ms, is_moment) = (until.unwrap_or(mark.t.saturating_add(MOMENT_MS)), until.is_none());
        let says = [&mark.note, &mark.word].into_iter().find(|text| !text.is_empty()).map_or("", String::as_str);
        let says = [mark.sort.word(), says].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(": ");
        let span = Span { from_ms: mark.t, until_ms, is_moment, says, by: mark.by.clone() };
        place(&mut tracks, &name, span);
    }
    let shown = [
        Happening::ByHand,
        Happening::Pretended,
        Happening::Action,
        Happening::NotDone,
        Happening::Failed,
        Happening::Changed,
        Happening::Robot,
    ];
    for what in shown {
        for event in timeline.events.iter().filter(|event| event.what == what) {
            let of = if event.subject.is_empty() { "" } else { ": " };
            push(&mut tracks, &format!("{}{of}{}", what.word(), event.subject), what, moment(event));
        }
    }
    tracks.iter_mut().filter(|track| track.what.is_some()).for_each(untangle);
    tracks
}

fn moment(event: &TimelineEvent) -> Span {
    let (from_ms, until_ms) = (event.at_ms, event.at_ms + MOMENT_MS);
    Span { from_ms, until_ms, is_moment: true, says: event.says.clone(), by: event.by.clone() }
}

/// Puts a mark on the first track of its word that is free then. A moment gives way to what comes after it.
fn place(tracks: &mut Vec<SpanTrack>, word: &str, span: Span) {
    for name in behaviour::numbered(word, " ") {
        let Some(track) = tracks.iter_mut().find(|track| track.name == name) else {
            tracks.push(SpanTrack { name, what: None, spans: vec![span] });
            return;
        };
        let last = track.spans.last_mut().filter(|last| last.until_ms > span.from_ms);
        match last {
            None => {}
            Some(last) if last.is_moment && last.from_ms < span.from_ms => last.until_ms = span.from_ms,
            Some(_) => continue,
        }
        track.spans.push(span);
        return;
    }
}

/// Adds a bar, or makes the one before it longer.
fn push(tracks: &mut Vec<SpanTrack>, name: &str, what: Happening, span: Span) {
    let at = tracks.iter().position(|track| track.name == name).unwrap_or_else(|| {
        tracks.push(SpanTrack { name: name.to_owned(), what: Some(what), spans: Vec::new() });
        tracks.len() - 1
    });
    let spans = &mut tracks[at].spans;
    let goes_on = |last: &Span| {
        let is_same = last.says == span.says || is_number(&last.says) && is_number(&span.says);
        let since_ms = span.from_ms.saturating_sub(last.until_ms - if last.is_moment { MOMENT_MS } else { 0 });
        is_same && last.by == span.by && since_ms < JOINED_MS
    };
    match spans.last_mut().filter(|last| goes_on(last)) {
        Some(last) => {
            (last.until_ms, last.is_moment) = (span.from_ms.max(last.from_ms + 1), span.from_ms == last.from_ms)
        }
        None => spans.push(span),
    }
}

/// True if a value is told all the time with other numbers.
fn is_number(says: &str) -> bool {
    says.starts_with(['{', '[', '-']) || says.starts_with(|letter: char| letter.is_ascii_digit())
}

/// Each bar ends where the next one begins at the latest, and none is without a length.
fn untangle(track: &mut SpanTrack) {
    track.spans.sort_by_key(|span| span.from_ms);
    let mut free_ms = 0;
    for span in &mut track.spans {
        span.from_ms = span.from_ms.max(free_ms);
        span.until_ms = span.until_ms.max(span.from_ms + 1);
        free_ms = span.from_ms + 1;
    }
    for at in 1..track.spans.len() {
        let next_ms = track.spans[at].from_ms;
        let before = &mut track.spans[at - 1];
        before.until_ms = before.until_ms.min(next_ms);
    }
}
