//! The marks of the run: those that everybody made, as the server tells them, and one's own that wait for it. The moment of a mark
//! is the press; it is sent with its age, so that a link that is lost for a while moves none.

use super::OperateShared;
use crate::link::{self, NoAnswer};
use crate::{browser, words};
use behaviour::Id;
use leptos::prelude::*;
use protocol::{AGO_MAX_MS, MARK_WORD_MAX_CHARS, MarkEdit, MarkSort, RecordingMark, Reply, Request, UNDO_MARK_MS};
use std::collections::VecDeque;

/// The most that waits to be sent: more than anybody presses within the minute that a mark may be late.
const WAITING_MAX: usize = 64;
/// Marks that are kept here, at most.
const KEPT_MAX: usize = 400;
/// Words that were typed are offered again, so many.
const WORDS_MAX: usize = 8;
/// So soon what could not be sent is tried again, in milliseconds.
const AGAIN_MS: i32 = 500;

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
    pub(super) note: String,
    pub(super) by: String,
    /// True if the server does not have it yet.
    pub(super) waits: bool,
}

/// Something that the server has to be told of a mark; it goes with the time of its press.
#[derive(Clone, Debug, PartialEq)]
struct WaitingMark {
    run: u64,
    id: Id,
    at: f64,
    what: What,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    Mark { behaviour: Id, word: String, sort: MarkSort, span: bool },
    Edit(MarkEdit),
}

/// The marks.
#[derive(Clone, Copy)]
pub(super) struct SessionMarks {
    /// The run that they are of; 0 before any.
    run: RwSignal<u64>,
    /// By time.
    pub(super) all: RwSignal<Vec<Mark>>,
    waiting: RwSignal<VecDeque<WaitingMark>>,
    /// True while one is on its way: they go one after the other.
    goes: RwSignal<bool>,
    /// The newest one of one's own, which can be taken back and have a note.
    pub(super) mine: RwSignal<Option<Id>>,
    /// True while its note is written.
    pub(super) writes: RwSignal<bool>,
    /// The note as far as it is typed.
    pub(super) typed: RwSignal<String>,
    /// Words that were typed here, newest first.
    pub(super) words: RwSignal<Vec<String>>,
}

impl SessionMarks {
    /// None yet.
    pub(super) fn new() -> Self {
        let (run, all, waiting) = (RwSignal::new(0), RwSignal::default(), RwSignal::default());
        let (goes, mine, writes) = (RwSignal::new(false), RwSignal::new(None), RwSignal::new(false));
        let typed = RwSignal::default();
        Self { run, all, waiting, goes, mine, writes, typed, words: RwSignal::default() }
    }
}

impl OperateShared {
    /// Marks this moment, with a word or without. Not reactive.
    pub(super) fn mark(self, word: &str) {
        self.begin(word, false);
    }

    /// Presses a word: marks, or ends the span of it that goes on. Not reactive.
    pub(super) fn mark_word(self, word: &str, span: bool) {
        let open = self
            .marks
            .all
            .with_untracked(|all| all.iter().rfind(|mark| mark.open && mark.word == word).map(|mark| mark.id.clone()));
        match open.filter(|_| span) {
            Some(id) => self.edit(&id, MarkEdit::End),
            None => self.begin(word, span),
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
        self.mark(&word);
    }

    fn begin(self, word: &str, span: bool) {
        let desk = self.desk.desk();
        let (Some(run), true) = (untrack(|| self.run()), untrack(|| self.may())) else {
            return self.whisper(words::marks_begin_with_run());
        };
        if self.marks.waiting.with_untracked(VecDeque::len) >= WAITING_MAX {
            return desk.say(words::too_many_marks_wait(), true);
        }
        let (id, at) = (crate::desk::new_id(), browser::today_ms());
        let by = desk.me.with_untracked(|me| me.as_ref().map(|me| me.name.clone()).unwrap_or_default());
        self.keep_typed();
        self.belong_to(run.run);
        let (word_kept, note) = (word.to_owned(), String::new());
        self.put_mark(Mark { id: id.clone(), at, until: None, open: span, word: word_kept, note, by, waits: true });
        self.marks.mine.set(Some(id.clone()));
        self.marks.writes.set(false);
        self.whisper(&words::marked_as(word));
        let what = What::Mark { behaviour: run.behaviour, word: word.to_owned(), sort: MarkSort::Note, span };
        self.wait(WaitingMark { run: run.run, id, at, what });
    }

    fn edit(self, id: &Id, edit: MarkEdit) {
        let at = browser::today_ms();
        // The run that the mark is of, whatever runs by now.
        let run = self.marks.run.get_untracked();
        self.marks.all.update(|all| match &edit {
            MarkEdit::Undo => all.retain(|mark| mark.id != *id),
            MarkEdit::End => all.iter_mut().filter(|mark| mark.id == *id).for_each(|mark| {
                (mark.open, mark.until, mark.waits) = (false, Some(at), true);
            }),
            MarkEdit::Note(note) => all.iter_mut().filter(|mark| mark.id == *id).for_each(|mark| {
                mark.note.clone_from(note);
                mark.waits = true;
            }),
        });
        self.wait(WaitingMark { run, id: id.clone(), at, what: What::Edit(edit) });
    }

    /// Takes the newest one of one's own back.
    pub(super) fn undo_mark(self) {
        if let Some(id) = self.marks.mine.get_untracked() {
            self.marks.mine.set(None);
            self.marks.writes.set(false);
            self.whisper(words::mark_taken_back());
            // One that the server was never told of is never told.
            let never = self.marks.waiting.try_update(|waiting| {
                let first = waiting.iter().position(|one| one.id == id);
                let never = first.is_some_and(|at| at > 0 || !self.marks.goes.get_untracked())
                    && waiting.iter().any(|one| one.id == id && matches!(one.what, What::Mark { .. }));
                if never {
                    waiting.retain(|one| one.id != id);
                }
                never
            });
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
        Some((mark, left.ceil().max(0.0) as u64))
    }

    /// Since when the span of a word goes on, by this computer's clock. Reactive.
    pub(super) fn span_since(self, word: &str) -> Option<f64> {
        self.run()?;
        self.marks.all.with(|all| all.iter().rfind(|mark| mark.open && mark.word == word).map(|mark| mark.at))
    }

    /// Takes what the server tells of marks.
    pub(super) fn hear_marks(self, reply: &Reply) {
        let Reply::LiveMarks { run, marks } = reply else { return };
        self.belong_to(*run);
        let began = self.began.get_untracked().filter(|(known, _)| known == run).map(|(_, began)| began);
        for told in marks {
            // Before the time of the run is known, one that is told counts as pressed just now.
            let began = began.unwrap_or_else(|| browser::today_ms() - told.t as f64);
            self.hear_mark(told, began);
        }
    }

    fn hear_mark(self, told: &RecordingMark, began: f64) {
        if told.gone {
            return self.marks.all.update(|all| all.retain(|mark| mark.id != told.id));
        }
        // A mark that waits here is newer than what is told.
        if self.marks.waiting.with_untracked(|waiting| waiting.iter().any(|one| one.id == told.id)) {
            return;
        }
        self.put_mark(Mark {
            id: told.id.clone(),
            at: began + told.t as f64,
            until: told.until.map(|until| began + until as f64),
            open: told.open,
            word: told.word.clone(),
            note: told.note.clone(),
            by: told.by.clone(),
            waits: false,
        });
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
        }
    }

    fn wait(self, waiting: WaitingMark) {
        self.marks.waiting.update(|all| all.push_back(waiting));
        self.send_marks();
    }

    /// Sends what waits, one after the other, each with the age of its press; what finds no link waits on.
    fn send_marks(self) {
        // Nothing of it is there any more once the page has ended.
        let first = self.marks.waiting.try_with_untracked(|waiting| waiting.front().cloned()).flatten();
        let (Some(first), Some(false)) = (first, self.marks.goes.try_get_untracked()) else { return };
        self.marks.goes.set(true);
        let ago_ms = (browser::today_ms() - first.at).max(0.0) as u64;
        let id = first.id.clone();
        // The server moves it to a minute ago.
        let is_moment = matches!(first.what, What::Mark { .. } | What::Edit(MarkEdit::End));
        let too_old = (ago_ms > AGO_MAX_MS && is_moment).then(|| super::clock::time_of_day(first.at));
        let request = match first.what {
            What::Mark { behaviour, word, sort, span } => Request::Mark {
                behaviour,
                robot: None,
                run: Some(first.run),
                id: Some(first.id),
                word,
                sort,
                span,
                note: String::new(),
                ago_ms,
            },
            What::Edit(edit) => Request::EditMark { run: first.run, id: first.id, edit, ago_ms },
        };
        self.desk.desk().look_up(request, move |answer| {
            if self.marks.goes.try_set(false).is_some() {
                return;
            }
            match answer {
                Err(NoAnswer::Unreachable) => return browser::after(AGAIN_MS, move || self.send_marks()),
                Err(NoAnswer::Refused(protocol::Refused::TooFast)) => {
                    return browser::after(AGAIN_MS, move || self.send_marks());
                }
                Err(NoAnswer::Refused(no)) => {
                    self.desk.desk().say_no(&no);
                    self.marks.waiting.update(|waiting| waiting.retain(|one| one.id != id));
                    self.marks.all.update(|all| all.retain(|mark| mark.id != id || !mark.waits));
                }
                Ok(reply) => {
                    if let Some(at) = too_old {
                        self.desk.desk().say(&words::mark_too_old(&at), true);
                    }
                    self.marks.waiting.update(|waiting| drop(waiting.pop_front()));
                    let waits = self.marks.waiting.with_untracked(|waiting| waiting.iter().any(|one| one.id == id));
                    self.marks.all.update(|all| {
                        all.iter_mut().filter(|mark| mark.id == id).for_each(|mark| mark.waits = waits);
                    });
                    if let Reply::Marked { mark, .. } = reply
                        && mark.gone
                    {
                        self.marks.all.update(|all| all.retain(|known| known.id != mark.id));
                    }
                }
            }
            self.send_marks();
        });
    }

    /// True if a moment can be marked. Reactive.
    pub(super) fn can_mark(self) -> bool {
        self.run().is_some() && self.may()
    }
}

/// Tries at once when the server greets again.
pub(super) fn when_back(op: OperateShared) {
    Effect::new(move |_| {
        if op.desk.desk().online.get() == crate::desk::LinkState::Online && link::is_up() {
            op.send_marks();
        }
    });
}
