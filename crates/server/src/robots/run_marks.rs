//! The marks of a run: told to everybody who watches, and kept by its recording if it has one.

use super::mailbox::RunMailbox;
use crate::recordings::{NotRecorded, tidied};
use crate::support::lock;
use behaviour::Id;
use protocol::{LIVE_MARKS_MAX, MarkEdit, MarkSort, RECORDING_MARKS_MAX, RecordingMark, Refused, UNDO_MARK_MS};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The most changes of the marks of one run, new marks included.
const CHANGES_MAX: u64 = 4 * RECORDING_MARKS_MAX as u64;

/// A press: by whom, and when.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MarkPress<'a> {
    /// The name of the person.
    pub(crate) by: &'a str,
    /// The client of the person, which alone says who they are: two may have one name.
    pub(crate) client: &'a Id,
    /// The moment of the press.
    pub(crate) at: Instant,
}

/// The outcome of a press.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PressOutcome {
    /// The mark as it is now.
    pub(crate) mark: RecordingMark,
    /// True if a recording keeps it.
    pub(crate) kept: bool,
    /// The file of the recording beside which the mark has still to be written, as its run has ended.
    pub(crate) later: Option<String>,
}

/// The marks of one run.
#[derive(Debug)]
pub(crate) struct RunMarks {
    inner: Mutex<Inner>,
}

#[derive(Debug)]
struct Inner {
    /// The beginning of logical time.
    began: Instant,
    /// Every mark of the run, those that are gone included.
    marks: Vec<ToldMark>,
    /// The number of changes.
    version: u64,
    /// The time at which the run ended, in milliseconds since Start.
    ended_ms: Option<u64>,
}

/// A mark as it is told.
#[derive(Clone, Debug)]
pub(super) struct ToldMark {
    mark: RecordingMark,
    /// The client of who made it.
    client: Id,
    /// The last press of who made it: of its beginning, or of the end of the span.
    pressed: Instant,
    /// The change that made it as it is.
    version: u64,
}

impl Default for RunMarks {
    fn default() -> Self {
        Self { inner: Mutex::new(Inner { began: Instant::now(), marks: Vec::new(), version: 0, ended_ms: None }) }
    }
}

impl RunMarks {
    /// Logical time began then; `before` are the marks of the interrupted run that this one continues.
    pub(super) fn begin(&self, began: Instant, before: Vec<ToldMark>) {
        let mut inner = lock(&self.inner);
        inner.began = began;
        let known: Vec<Id> = inner.marks.iter().map(|told| told.mark.id.clone()).collect();
        for told in before.into_iter().filter(|told| !known.contains(&told.mark.id)) {
            inner.version += 1;
            let version = inner.version;
            inner.marks.push(ToldMark { version, ..told });
        }
    }

    /// Marks the moment of a press, or begins a span there. A mark of this id that is here already stays as it is.
    ///
    /// # Errors
    /// If a text of it is too long, if there are too many marks, or if the run had ended by then.
    pub(super) fn put(
        &self,
        mark: RecordingMark,
        press: MarkPress,
        mailbox: &RunMailbox,
    ) -> Result<RecordingMark, Refused> {
        let open = mark.open;
        let mark = RecordingMark { open, ..tidied(RecordingMark { until: None, ..mark })? };
        let mut inner = lock(&self.inner);
        if let Some(known) = inner.marks.iter().find(|told| told.mark.id == mark.id) {
            return Ok(known.mark.clone());
        }
        if inner.marks.len() >= RECORDING_MARKS_MAX {
            return Err(NotRecorded::TooManyMarks.into());
        }
        let mut mark = RecordingMark { t: inner.ms_at(press.at), by: press.by.to_owned(), ..mark };
        if let Some(ended_ms) = inner.ended_ms {
            if mark.t > ended_ms {
                return Err(Refused::NotRunning);
            }
            end(&mut mark, ended_ms);
        }
        let version = inner.next_version()?;
        inner.hand_on(&mark, mailbox)?;
        inner.version = version;
        inner.marks.push(ToldMark { mark: mark.clone(), client: press.client.clone(), pressed: press.at, version });
        Ok(mark)
    }

    /// Changes a mark. One that is taken back before it comes, as the link of who made it broke, stays gone when it does.
    ///
    /// # Errors
    /// If there is no such mark, if the note is too long, or if it cannot be taken back any more.
    pub(super) fn edit(
        &self,
        id: &Id,
        edit: MarkEdit,
        press: MarkPress,
        mailbox: &RunMailbox,
    ) -> Result<RecordingMark, Refused> {
        let mut inner = lock(&self.inner);
        let at_ms = inner.ms_at(press.at);
        let version = inner.next_version()?;
        let Some(at) = inner.marks.iter().position(|told| told.mark.id == *id) else {
            let is_undo = edit == MarkEdit::Undo && inner.marks.len() < RECORDING_MARKS_MAX;
            return if is_undo { Ok(inner.never(id, press)) } else { Err(NotRecorded::NoMark.into()) };
        };
        let known = &inner.marks[at];
        let mut mark = known.mark.clone();
        match edit {
            MarkEdit::End => end(&mut mark, at_ms),
            MarkEdit::Note(note) => mark.note = tidied(RecordingMark { note, until: None, ..mark.clone() })?.note,
            MarkEdit::Sort(sort) => mark.sort = sort,
            MarkEdit::Undo => {
                let late = press.at.saturating_duration_since(known.pressed) > Duration::from_millis(UNDO_MARK_MS);
                if !mark.gone && (late || known.client != *press.client) {
                    return Err(NotRecorded::NotUndone.into());
                }
                (mark.gone, mark.open) = (true, false);
            }
        }
        if mark == known.mark {
            return Ok(mark);
        }
        inner.hand_on(&mark, mailbox)?;
        let pressed = if mark.until == known.mark.until { known.pressed } else { press.at };
        let client = inner.marks[at].client.clone();
        inner.marks[at] = ToldMark { mark: mark.clone(), client, pressed, version };
        inner.version = version;
        Ok(mark)
    }

    /// Ends every span that is open, as the run ends at this time; answers with those. From now on nothing waits for the run.
    pub(super) fn close(&self, at_ms: u64) -> Vec<RecordingMark> {
        let mut inner = lock(&self.inner);
        inner.ended_ms = Some(at_ms);
        let mut version = inner.version;
        let ended: Vec<_> = inner
            .marks
            .iter_mut()
            .filter(|told| told.mark.open)
            .map(|told| {
                version += 1;
                end(&mut told.mark, at_ms);
                told.version = version;
                told.mark.clone()
            })
            .collect();
        inner.version = version;
        ended
    }

    /// True if the run has ended.
    pub(super) fn is_closed(&self) -> bool {
        lock(&self.inner).ended_ms.is_some()
    }

    /// All marks that are there, oldest first.
    pub(super) fn all(&self) -> Vec<RecordingMark> {
        let inner = lock(&self.inner);
        inner.marks.iter().map(|told| told.mark.clone()).filter(|mark| !mark.gone).collect()
    }

    /// All marks that are there with who made them, oldest first.
    pub(super) fn kept(&self) -> Vec<ToldMark> {
        lock(&self.inner).marks.iter().filter(|told| !told.mark.gone).cloned().collect()
    }

    /// The time now, in milliseconds since Start, also once the run has ended.
    pub(crate) fn now_ms(&self) -> u64 {
        lock(&self.inner).ms_at(Instant::now())
    }

    /// The marks that changed since, as many as one message tells; `seen` then counts them.
    pub(crate) fn since(&self, seen: &mut u64) -> Vec<RecordingMark> {
        let inner = lock(&self.inner);
        if inner.version <= *seen {
            return Vec::new();
        }
        let from = *seen;
        let mut newer: Vec<&ToldMark> = inner.marks.iter().filter(|told| told.version > from).collect();
        newer.sort_by_key(|told| told.version);
        newer.truncate(LIVE_MARKS_MAX);
        *seen = newer.last().map_or(inner.version, |told| told.version);
        newer.into_iter().map(|told| told.mark.clone()).collect()
    }
}

impl Inner {
    /// Hands a mark to the recording, while the run takes what waits for it.
    fn hand_on(&self, mark: &RecordingMark, mailbox: &RunMailbox) -> Result<(), Refused> {
        let is_taken = self.ended_ms.is_some() || mailbox.mark(mark.clone());
        if is_taken { Ok(()) } else { Err(Refused::TooFast) }
    }

    /// Remembers a mark that is gone before it came. No recording needs to know of it.
    fn never(&mut self, id: &Id, press: MarkPress) -> RecordingMark {
        let (t, sort, [word, note, at]) = (self.ms_at(press.at), MarkSort::Note, [const { String::new() }; 3]);
        let (id, by) = (id.clone(), press.by.to_owned());
        let mark = RecordingMark { id, t, until: None, word, sort, note, by, at, open: false, gone: true };
        self.marks.push(ToldMark { mark: mark.clone(), client: press.client.clone(), pressed: press.at, version: 0 });
        mark
    }

    fn next_version(&self) -> Result<u64, Refused> {
        if self.version < CHANGES_MAX { Ok(self.version + 1) } else { Err(NotRecorded::TooManyMarks.into()) }
    }

    fn ms_at(&self, at: Instant) -> u64 {
        u64::try_from(at.saturating_duration_since(self.began).as_millis()).unwrap_or(u64::MAX)
    }
}

/// Ends an open span, at least a millisecond after its beginning.
fn end(mark: &mut RecordingMark, at_ms: u64) {
    if mark.open {
        (mark.open, mark.until) = (false, Some(at_ms.max(mark.t + 1)));
    }
}

#[cfg(test)]
mod tests {
    use super::{LIVE_MARKS_MAX, MarkPress, RecordingMark, RunMailbox, RunMarks};
    use behaviour::Id;
    use protocol::{MarkEdit, MarkSort};
    use std::time::{Duration, Instant};

    /// A press of the only client of that name.
    fn press<'a>(by: &'a str, client: &'a Id, at: Instant) -> MarkPress<'a> {
        MarkPress { by, client, at }
    }

    fn id(name: &str) -> Id {
        Id::new(name).unwrap()
    }

    fn mark(name: &str, open: bool) -> RecordingMark {
        let [note, by, at] = [const { String::new() }; 3];
        let (word, sort) = ("smiles".to_owned(), MarkSort::Good);
        RecordingMark { id: id(name), t: 0, until: None, word, sort, note, by, at, open, gone: false }
    }

    /// Takes what waits, as the run does.
    fn empty(mailbox: &RunMailbox) -> usize {
        mailbox.take(Some(Instant::now())).marks.len()
    }

    #[test]
    fn a_mark_that_is_sent_twice_counts_once_and_has_the_time_of_the_press() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        marks.begin(began, Vec::new());
        let (aiko, ben) = (id("aiko"), id("ben"));
        let pressed = press("Aiko", &aiko, began + Duration::from_millis(700));
        let first = marks.put(mark("a", false), pressed, &mailbox).unwrap();
        assert_eq!((first.t, first.by.as_str()), (700, "Aiko"));
        let late = press("Ben", &ben, began + Duration::from_secs(9));
        assert_eq!(marks.put(mark("a", false), late, &mailbox).unwrap(), first);
        assert_eq!((marks.all(), empty(&mailbox)), (vec![first], 1));
    }

    #[test]
    fn a_span_ends_once_and_what_is_open_ends_with_the_run() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        marks.begin(began, Vec::new());
        let aiko = id("aiko");
        let at = |ms| press("Aiko", &aiko, began + Duration::from_millis(ms));
        for name in ["a", "b"] {
            assert!(marks.put(mark(name, true), at(100), &mailbox).unwrap().open);
        }
        let ended = marks.edit(&id("a"), MarkEdit::End, at(300), &mailbox).unwrap();
        assert_eq!((ended.until, ended.open), (Some(300), false));
        assert_eq!(marks.edit(&id("a"), MarkEdit::End, at(900), &mailbox).unwrap(), ended);
        let ended = marks.close(50);
        assert_eq!(ended.iter().map(|mark| (mark.id.as_str(), mark.until)).collect::<Vec<_>>(), [("b", Some(101))]);
        assert!(marks.close(60).is_empty());
        let late = marks.put(mark("c", true), at(40), &mailbox).unwrap();
        assert_eq!((late.t, late.until), (40, Some(60)), "a press that came late by a bad link");
        assert!(marks.put(mark("d", true), at(61), &mailbox).is_err());
        assert!(marks.is_closed() && empty(&mailbox) == 3, "{:?}", marks.all());
    }

    #[test]
    fn who_made_a_mark_takes_it_back_for_ten_seconds() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        marks.begin(began, Vec::new());
        // Two people of one name, who work at two tablets.
        let (aiko, other) = (id("aiko"), id("another-aiko"));
        let by = |client, ms| press("Aiko", client, began + Duration::from_millis(ms));
        for name in ["a", "b"] {
            marks.put(mark(name, name == "b"), by(&aiko, 1_000), &mailbox).unwrap();
        }
        let undo = |name: &str, press| marks.edit(&id(name), MarkEdit::Undo, press, &mailbox);
        assert!(undo("a", by(&other, 2_000)).unwrap_err().to_string().contains("by who made it"));
        assert!(undo("a", by(&aiko, 11_001)).is_err(), "too late");
        assert!(undo("a", by(&aiko, 11_000)).unwrap().gone);
        assert!(undo("a", by(&aiko, 60_000)).unwrap().gone, "sent again, it is as it was");
        marks.edit(&id("b"), MarkEdit::End, by(&aiko, 30_000), &mailbox).unwrap();
        assert!(undo("b", by(&aiko, 35_000)).unwrap().gone, "the end of a span is a press too");
        let no_mark = marks.edit(&id("c"), MarkEdit::End, by(&aiko, 1), &mailbox).unwrap_err();
        assert!(no_mark.to_string().contains("no such mark"));
    }

    #[test]
    fn a_mark_that_is_taken_back_before_it_came_stays_gone() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        marks.begin(began, Vec::new());
        let aiko = id("aiko");
        let pressed = press("Aiko", &aiko, began);
        // The link broke between the two, and the bytes of the old one come last, twice.
        for _ in 0..2 {
            assert!(marks.edit(&id("a"), MarkEdit::Undo, pressed, &mailbox).unwrap().gone);
            assert!(marks.put(mark("a", false), pressed, &mailbox).unwrap().gone);
        }
        assert!(marks.all().is_empty() && empty(&mailbox) == 0, "no recording has it");
        assert!(marks.since(&mut 0).is_empty(), "nobody is told of it");
    }

    #[test]
    fn marks_of_an_interrupted_run_stay_with_who_made_them_and_when() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        marks.begin(began, Vec::new());
        let (aiko, other) = (id("aiko"), id("another-aiko"));
        let by = |client, ms| press("Aiko", client, began + Duration::from_millis(ms));
        for (name, ms) in [("old", 1_000), ("new", 30_000)] {
            marks.put(mark(name, false), by(&aiko, ms), &mailbox).unwrap();
        }
        let goes_on = RunMarks::default();
        goes_on.begin(began, marks.kept());
        let undo = |name: &str, press| goes_on.edit(&id(name), MarkEdit::Undo, press, &mailbox);
        assert!(undo("old", by(&aiko, 31_000)).is_err(), "too late");
        assert!(undo("new", by(&other, 31_000)).is_err(), "not theirs");
        assert!(undo("new", by(&aiko, 31_000)).unwrap().gone);
    }

    #[test]
    fn a_verdict_joins_a_mark_also_after_the_run() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        let aiko = id("aiko");
        let press = press("Aiko", &aiko, began);
        marks.begin(began, Vec::new());
        let first = marks.put(mark("a", false), press, &mailbox).unwrap();
        let judged = marks.edit(&id("a"), MarkEdit::Sort(MarkSort::Bad), press, &mailbox).unwrap();
        assert_eq!(judged, RecordingMark { sort: MarkSort::Bad, ..first });
        assert_eq!(marks.edit(&id("a"), MarkEdit::Sort(MarkSort::Bad), press, &mailbox).unwrap(), judged);
        assert_eq!(empty(&mailbox), 2, "said twice, it is written once");
        marks.close(10);
        let later = marks.edit(&id("a"), MarkEdit::Sort(MarkSort::Now), press, &mailbox).unwrap();
        assert_eq!((later.sort, marks.all()), (MarkSort::Now, vec![later.clone()]));
    }

    #[test]
    fn whoever_comes_later_hears_all_in_parts_and_then_what_is_new() {
        let (marks, mailbox, began) = (RunMarks::default(), RunMailbox::default(), Instant::now());
        let aiko = id("aiko");
        let press = press("Aiko", &aiko, began);
        for number in 0..=LIVE_MARKS_MAX {
            marks.put(mark(&format!("m{number}"), false), press, &mailbox).unwrap();
            empty(&mailbox);
        }
        let mut seen = 0;
        assert_eq!([marks.since(&mut seen).len(), marks.since(&mut seen).len()], [LIVE_MARKS_MAX, 1]);
        assert!(marks.since(&mut seen).is_empty());
        let note = || MarkEdit::Note(" he laughs ".to_owned());
        marks.edit(&id("m3"), note(), press, &mailbox).unwrap();
        marks.edit(&id("m3"), note(), press, &mailbox).unwrap();
        let told = marks.since(&mut seen);
        assert_eq!(
            told.iter().map(|mark| (mark.id.as_str(), mark.note.as_str())).collect::<Vec<_>>(),
            [("m3", "he laughs")]
        );
        assert!(marks.edit(&id("m3"), MarkEdit::Note("n".repeat(201)), press, &mailbox).is_err());
    }
}
