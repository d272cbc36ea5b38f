//! The marks of the run: those that everybody made, as the server tells them, and one's own that wait for it. The moment of a mark
//! is the press; it is sent with its age, so that a link that is lost for a while moves none.

pub(super) mod waiting;

use super::{OperateShared, clock};
use crate::browser;
use crate::operate::words;
use behaviour::Id;
use leptos::prelude::*;
use protocol::{MARK_WORD_MAX_CHARS, MarkEdit, MarkSort, RecordingMark, UNDO_MARK_MS};
use std::collections::VecDeque;
use waiting::{WAITING_MAX, WaitingMark, WaitingWork, take_back};

/// Marks that are kept here, at most.
const KEPT_MAX: usize = 400;
/// Words that were typed are offered again, so many.
const WORDS_MAX: usize = 8;

/// A mark as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mark {
    pub(super) id: Id,
    /// The moment, by this computer's clock; of a span its beginning.
    pub(super) at: f64,
    /// The end of a span.
    pub(super) until: Option<f64>,
    /// True of a span that goes on.
    pub(super) open: bool,
    pub(super) word: String,
    /// The verdict of the moment.
    pub(super) sort: MarkSort,
    pub(super) note: String,
    pub(super) by: String,
    /// True if the server does not have it yet.
    pub(super) waits: bool,
    /// These moments in milliseconds since Start, as the server tells them; none before it has.
    pub(super) told: Option<(u64, Option<u64>)>,
}

impl Mark {
    /// Takes a change of it, pressed then. Pure.
    pub(super) fn change(&mut self, edit: &MarkEdit, at: f64) {
        match edit {
            MarkEdit::End if self.open => (self.open, self.until) = (false, Some(at)),
            MarkEdit::Note(note) => self.note.clone_from(note),
            MarkEdit::Sort(sort) => self.sort = *sort,
            MarkEdit::End | MarkEdit::Undo => {}
        }
    }

    /// Moves it to where it was in its run, which began then by this computer's clock. What waits to be told is where it was
    /// pressed here. Pure.
    fn place(&mut self, began: f64) {
        if let Some((t, until)) = self.told.filter(|_| !self.waits) {
            (self.at, self.until) = (began + t as f64, until.map(|until| began + until as f64));
        }
    }
}

/// The marks.
#[derive(Clone, Copy)]
pub(super) struct SessionMarks {
    /// The run that they are of; 0 before any.
    run: RwSignal<u64>,
    /// By time.
    pub(super) all: RwSignal<Vec<Mark>>,
    /// The marks that the server was not told yet, oldest first; kept over a reload of the page.
    pub(super) waiting: RwSignal<VecDeque<WaitingMark>>,
    /// True while one is on its way: they go one after the other.
    pub(super) goes: RwSignal<bool>,
    /// The newest one of one's own, which can be taken back and have a note.
    pub(super) mine: RwSignal<Option<Id>>,
    /// True if the newest one is another one, perhaps somebody else's, of which only the note is written here.
    lent: RwSignal<bool>,
    /// True while its note is written.
    pub(super) writes: RwSignal<bool>,
    /// The note as far as it is typed.
    pub(super) typed: RwSignal<String>,
    /// Words that were typed here, newest first.
    pub(super) words: RwSignal<Vec<String>>,
}

impl SessionMarks {
    /// None yet but what this tab kept.
    pub(super) fn new() -> Self {
        let (run, all, waiting) = (RwSignal::new(0), RwSignal::default(), RwSignal::new(waiting::kept()));
        let (goes, mine, writes) = (RwSignal::new(false), RwSignal::new(None), RwSignal::new(false));
        let (lent, typed) = (RwSignal::new(false), RwSignal::default());
        Self { run, all, waiting, goes, mine, lent, writes, typed, words: RwSignal::default() }
    }

    /// The span of a word that goes on. Not reactive.
    pub(super) fn open_span(self, word: &str) -> Option<Id> {
        self.all
            .with_untracked(|all| all.iter().rfind(|mark| mark.open && mark.word == word).map(|mark| mark.id.clone()))
    }
}

impl OperateShared {
    /// Marks a moment, with a word or without. Not reactive.
    pub(super) fn mark(self, word: &str, at: f64) {
        self.begin(word, false, at);
    }

    /// Presses a word: marks, or ends the span of it that goes on. Not reactive.
    pub(super) fn mark_word(self, word: &str, span: bool, at: f64) {
        match self.marks.open_span(word).filter(|_| span) {
            Some(id) => self.edit(&id, MarkEdit::End),
            None => self.begin(word, span, at),
        }
    }

    /// A word that was typed: it marks now, and is offered from now on.
    pub(super) fn mark_typed(self, typed: &str) {
        let word: String = typed.trim().chars().take(MARK_WORD_MAX_CHARS).collect();
        if word.is_empty() {
            return;
        }
        self.marks.words.update(|words| {
            words.retain(|known| *known != word);
            words.insert(0, word.clone());
            words.truncate(WORDS_MAX);
        });
        self.mark(&word, browser::today_ms());
    }

    fn begin(self, word: &str, span: bool, at: f64) {
        let desk = self.desk.desk();
        let (Some(run), true) = (untrack(|| self.run()), untrack(|| self.may())) else {
            return self.whisper(words::marks_begin_with_run());
        };
        if self.marks.waiting.with_untracked(VecDeque::len) >= WAITING_MAX {
            return desk.say(words::too_many_marks_wait(), true);
        }
        let id = crate::desk::new_id();
        self.keep_typed();
        self.belong_to(run.run);
        self.marks.mine.set(Some(id.clone()));
        self.marks.lent.set(false);
        self.marks.writes.set(false);
        self.verdict.of.set(None);
        self.whisper(&words::marked_as(word));
        let what = WaitingWork::Mark { behaviour: run.behaviour, word: word.to_owned(), span };
        self.wait(WaitingMark { epoch: desk.epoch.get_untracked(), run: run.run, id, at, what, tried: false });
    }

    fn edit(self, id: &Id, edit: MarkEdit) {
        // The run that the mark is of, whatever runs by now.
        let (run, epoch) = (self.marks.run.get_untracked(), self.desk.desk().epoch.get_untracked());
        let (id, at, what) = (id.clone(), browser::today_ms(), WaitingWork::Edit(edit));
        self.wait(WaitingMark { epoch, run, id, at, what, tried: false });
    }

    /// The mark that a press makes, if it makes one. Not reactive.
    pub(super) fn made_by(self, press: impl FnOnce()) -> Option<Id> {
        let before = self.marks.mine.get_untracked();
        press();
        self.marks.mine.get_untracked().filter(|now| before.as_ref() != Some(now))
    }

    /// Takes the newest one of one's own back.
    pub(super) fn undo_mark(self) {
        if let Some(id) = self.marks.mine.get_untracked().filter(|_| !self.marks.lent.get_untracked()) {
            self.marks.mine.set(None);
            self.marks.writes.set(false);
            self.whisper(words::mark_taken_back());
            let goes = self.marks.goes.get_untracked();
            let never = self.marks.waiting.try_update(|waiting| take_back(waiting, &id, goes));
            self.keep_waiting();
            if never == Some(true) {
                self.marks.all.update(|all| all.retain(|mark| mark.id != id));
            } else {
                self.edit(&id, MarkEdit::Undo);
            }
        }
    }

    /// The note of the newest one of one's own.
    pub(super) fn note_mark(self, note: &str) {
        if let Some(id) = self.marks.mine.get_untracked() {
            self.marks.writes.set(false);
            if !note.trim().is_empty() {
                self.edit(&id, MarkEdit::Note(note.trim().to_owned()));
            }
        }
    }

    /// Says if the moment of a mark was good.
    pub(super) fn judge_mark(self, id: &Id, sort: MarkSort) {
        self.edit(id, MarkEdit::Sort(sort));
    }

    /// Opens the note of a mark, which is the newest one from now on; it cannot be taken back if it was not before.
    pub(super) fn open_note_of(self, id: &Id) {
        self.keep_typed();
        let was = self.marks.mine.with_untracked(|mine| mine.as_ref() == Some(id));
        self.marks.lent.set(!was || self.marks.lent.get_untracked());
        self.marks.mine.set(Some(id.clone()));
        self.open_note();
    }

    /// Opens the note of the newest mark; whether there is one. Not reactive.
    pub(super) fn open_note(self) -> bool {
        let some = self.marks.mine.with_untracked(Option::is_some);
        self.marks.writes.set(some);
        some
    }

    /// The newest one of one's own, with how many seconds it can still be taken back. Reactive.
    pub(super) fn newest_mark(self) -> Option<(Mark, u64)> {
        let id = self.marks.mine.get()?;
        let mark = self.marks.all.with(|all| all.iter().find(|mark| mark.id == id).cloned())?;
        let pressed = mark.until.unwrap_or(mark.at);
        let left = (UNDO_MARK_MS as f64 - (self.now.get() - pressed)) / 1_000.0;
        let left = if self.marks.lent.get() { 0.0 } else { left };
        Some((mark, left.ceil().max(0.0) as u64))
    }

    /// Since when the span of a word goes on, by this computer's clock. Reactive.
    pub(super) fn span_since(self, word: &str) -> Option<f64> {
        self.run()?;
        self.marks.all.with(|all| all.iter().rfind(|mark| mark.open && mark.word == word).map(|mark| mark.at))
    }

    /// Takes what the server tells of marks.
    pub(super) fn hear_marks(self, (run, at_ms): (u64, u64), marks: &[RecordingMark]) {
        let newest = self.desk.desk().robots.runs.with_untracked(|runs| runs.iter().map(|run| run.run).max());
        if !is_of_here(run, untrack(|| self.last()).map(|last| last.run), newest) {
            return;
        }
        self.belong_to(run);
        let began = self.hear_time(run, at_ms);
        marks.iter().for_each(|told| self.hear_mark(told, began));
    }

    /// Hears how long ago the run began; answers with when that was, by this computer's clock. What is shown of its marks goes by
    /// it too.
    pub(super) fn hear_time(self, run: u64, at_ms: u64) -> f64 {
        let known = self.began.get_untracked();
        let told = clock::began(known, run, at_ms, browser::today_ms());
        if known != Some(told) {
            self.began.set(Some(told));
            if self.marks.run.get_untracked() == run {
                self.marks.all.update(|all| all.iter_mut().for_each(|mark| mark.place(told.1)));
            }
        }
        told.1
    }

    fn hear_mark(self, told: &RecordingMark, began: f64) {
        if told.gone {
            return self.marks.all.update(|all| all.retain(|mark| mark.id != told.id));
        }
        let waiting: Vec<WaitingMark> = self
            .marks
            .waiting
            .with_untracked(|waiting| waiting.iter().filter(|one| one.id == told.id).cloned().collect());
        // A mark that waits here is newer than what is told.
        if !waiting.is_empty() && self.marks.all.with_untracked(|all| all.iter().any(|mark| mark.id == told.id)) {
            return;
        }
        let mut mark = Mark {
            id: told.id.clone(),
            at: 0.0,
            until: None,
            open: told.open,
            word: told.word.clone(),
            sort: told.sort,
            note: told.note.clone(),
            by: told.by.clone(),
            waits: false,
            told: Some((told.t, told.until)),
        };
        mark.place(began);
        self.put_mark(mark);
        let by = self.my_name();
        self.marks.all.update(|all| waiting.iter().for_each(|one| one.show(all, &by)));
    }

    fn put_mark(self, mark: Mark) {
        self.marks.all.update(|all| {
            all.retain(|known| known.id != mark.id);
            let at = all.partition_point(|known| known.at <= mark.at);
            all.insert(at, mark);
            let many = all.len().saturating_sub(KEPT_MAX);
            all.drain(..many);
        });
    }

    /// Keeps a note that is half typed with the mark that it is of, before another mark or run comes in its place.
    fn keep_typed(self) {
        if self.marks.writes.get_untracked() {
            self.note_mark(&self.marks.typed.get_untracked());
        }
        self.marks.typed.set(String::new());
    }

    /// Another run has marks of its own. Not reactive.
    pub(super) fn belong_to(self, run: u64) {
        if self.marks.run.get_untracked() != run {
            self.keep_typed();
            self.marks.run.set(run);
            self.marks.all.set(Vec::new());
            self.marks.mine.set(None);
            self.show_waiting(run);
        }
    }

    /// True if a moment can be marked. Reactive.
    pub(super) fn can_mark(self) -> bool {
        self.run().is_some() && self.may()
    }
}

/// True if what is told of a run is of the one that this page shows: the last one of the open program on this robot, or one that
/// began after all that were heard of. Of a run that was left, marks may come late. Pure.
fn is_of_here(run: u64, last: Option<u64>, newest: Option<u64>) -> bool {
    last == Some(run) || newest.is_none_or(|newest| run > newest)
}

#[cfg(test)]
mod tests {
    use super::{Mark, is_of_here};
    use behaviour::Id;
    use protocol::MarkSort;

    #[test]
    fn marks_that_come_late_of_another_run_change_nothing_here() {
        assert!(is_of_here(7, Some(7), Some(9)), "another robot has newer runs");
        assert!(is_of_here(10, Some(7), Some(9)), "it begins, and is told of before that");
        assert!(!is_of_here(6, Some(7), Some(7)), "the run before");
        assert!(!is_of_here(9, Some(7), Some(9)), "that of a robot, or a program, that was looked at before");
        assert!(!is_of_here(9, None, Some(9)) && is_of_here(1, None, None));
    }

    #[test]
    fn marks_are_where_they_were_in_their_run_by_whatever_clock() {
        let [word, note, by] = [const { String::new() }; 3];
        let (id, at, told, sort) = (Id::new("a").unwrap(), 0.0, Some((60_000, Some(65_000))), MarkSort::Note);
        let mut mark = Mark { id, at, until: None, open: false, word, sort, note, by, waits: false, told };
        mark.place(1_000_000.0);
        assert_eq!((mark.at, mark.until), (1_060_000.0, Some(1_065_000.0)));
        mark.place(4_600_000.0);
        assert_eq!((mark.at, mark.until), (4_660_000.0, Some(4_665_000.0)), "the clock was set an hour ahead");
        (mark.waits, mark.until) = (true, Some(4_670_000.0));
        mark.place(1_000_000.0);
        assert_eq!(mark.until, Some(4_670_000.0), "its end was pressed here and is not told yet");
    }
}
