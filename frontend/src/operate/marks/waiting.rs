//! Marks and changes of marks that wait for the server, each with the moment of its press. They are kept in this tab, so that a
//! page that is loaded again sends them; the server knows each mark by its id, so that one that is sent twice counts once.

use super::Mark;
use crate::browser::{self, Drawer};
use crate::desk::Desk;
use crate::link::{self, NoAnswer};
use crate::operate::OperateShared;
use crate::operate::clock::time_of_day;
use crate::operate::hearing::hear_anew;
use crate::operate::words;
use behaviour::Id;
use leptos::prelude::*;
use protocol::{AGO_MAX_MS, MarkEdit, MarkSort, RecordingMark, Refused, answer, request};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The key under which this tab keeps what waits.
const KEPT_KEY: &str = "rrp.marks";
/// The most that waits to be sent: more than anybody presses within the minute that a mark may be late.
pub(in crate::operate) const WAITING_MAX: usize = 64;
/// So soon what could not be sent is tried again, in milliseconds.
const AGAIN_MS: i32 = 500;

type OnMarked = Box<dyn FnOnce(Result<answer::Marked, NoAnswer>)>;

/// Something that the server has to be told of a mark; it goes with the time of its press.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(in crate::operate) struct WaitingMark {
    /// The start of the server that its run is of: another one counts its runs anew.
    pub(in crate::operate) epoch: u64,
    pub(in crate::operate) run: u64,
    pub(in crate::operate) id: Id,
    /// The moment of the press, by this computer's clock.
    pub(in crate::operate) at: f64,
    pub(in crate::operate) what: WaitingWork,
    /// True once it may have come to the server, whatever was heard of it.
    #[serde(default)]
    pub(in crate::operate) tried: bool,
}

/// The kinds of what the server has to be told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(in crate::operate) enum WaitingWork {
    Mark { behaviour: Id, word: String, span: bool },
    Edit(MarkEdit),
}

impl WaitingMark {
    /// Shows on the marks of its run what the server was not told yet. Pure.
    pub(in crate::operate) fn show(&self, all: &mut Vec<Mark>, by: &str) {
        let known = all.iter().position(|mark| mark.id == self.id);
        match (&self.what, known) {
            (WaitingWork::Mark { word, span, .. }, None) => {
                let (id, word, note, by) = (self.id.clone(), word.clone(), String::new(), by.to_owned());
                let (at, until, sort) = (self.at, None, MarkSort::Note);
                let place = all.partition_point(|known| known.at <= at);
                all.insert(place, Mark { id, at, until, open: *span, word, sort, note, by, waits: true, told: None });
            }
            (WaitingWork::Edit(MarkEdit::Undo), Some(known)) => drop(all.remove(known)),
            (WaitingWork::Edit(edit), Some(known)) => {
                all[known].waits = true;
                all[known].change(edit, self.at);
            }
            (WaitingWork::Mark { .. }, Some(_)) | (WaitingWork::Edit(_), None) => {}
        }
    }

    /// True if the moment of it counts, which the server takes for a minute ago at most.
    fn is_moment(&self) -> bool {
        matches!(self.what, WaitingWork::Mark { .. } | WaitingWork::Edit(MarkEdit::End))
    }

    /// Tells the server of it.
    fn ask(self, desk: &Desk, ago_ms: u64, then: OnMarked) {
        let (id, run) = (self.id, self.run);
        match self.what {
            WaitingWork::Mark { behaviour, word, span } => {
                let (id, run, sort, note) = (Some(id), Some(run), MarkSort::Note, String::new());
                desk.look_up(request::Mark { behaviour, robot: None, run, id, word, sort, span, note, ago_ms }, then);
            }
            WaitingWork::Edit(edit) => desk.look_up(request::EditMark { run, id, edit, ago_ms }, then),
        }
    }
}

/// Takes what waits of a mark back, as the mark shall not be; whether the server was never told of it. What may have come to the
/// server already is taken back there too. Pure.
pub(in crate::operate) fn take_back(waiting: &mut VecDeque<WaitingMark>, id: &Id, goes: bool) -> bool {
    let made = waiting.iter().find(|one| one.id == *id && matches!(one.what, WaitingWork::Mark { .. }));
    let never = made.is_some_and(|made| !made.tried);
    // A mark that is on its way just now is answered first.
    let mut first = goes;
    waiting.retain(|one| std::mem::take(&mut first) || one.id != *id);
    never
}

/// Takes out what stands first, which was refused: a mark with all changes of it, or one change. Returns true if the mark is there and
/// has to be told anew as it is. Pure.
fn refused(waiting: &mut VecDeque<WaitingMark>, all: &mut Vec<Mark>) -> bool {
    let Some(WaitingMark { id, what, .. }) = waiting.pop_front() else { return false };
    if let WaitingWork::Mark { .. } = what {
        waiting.retain(|one| one.id != id);
        all.retain(|mark| mark.id != id || !mark.waits);
        return false;
    }
    let waits = waiting.iter().any(|one| one.id == id);
    all.iter_mut().filter(|mark| mark.id == id).for_each(|mark| mark.waits = waits);
    true
}

/// The marks that this tab kept before its page was loaded again.
pub(in crate::operate) fn kept() -> VecDeque<WaitingMark> {
    let kept = Drawer::Tab.get(KEPT_KEY).and_then(|text| crate::json::read::<VecDeque<WaitingMark>>(&text).ok());
    kept.unwrap_or_default().into_iter().take(WAITING_MAX).collect()
}

impl OperateShared {
    /// Shows it, keeps it, and sends it as soon as it can.
    pub(in crate::operate) fn wait(self, waiting: WaitingMark) {
        let by = self.my_name();
        self.marks.all.update(|all| waiting.show(all, &by));
        self.marks.waiting.update(|all| all.push_back(waiting));
        self.keep_waiting();
        self.send_marks();
    }

    /// Shows on the marks of this run what waits for it. Not reactive.
    pub(in crate::operate) fn show_waiting(self, run: u64) {
        let (epoch, by) = (self.desk.desk().epoch.get_untracked(), self.my_name());
        let waiting = self.marks.waiting.get_untracked();
        self.marks.all.update(|all| {
            waiting.iter().filter(|one| (one.epoch, one.run) == (epoch, run)).for_each(|one| one.show(all, &by));
        });
    }

    /// The name of this person. Not reactive.
    pub(in crate::operate) fn my_name(self) -> String {
        self.desk.desk().me.with_untracked(|me| me.as_ref().map(|me| me.name.clone()).unwrap_or_default())
    }

    /// Changes what waits, and keeps it so.
    pub(in crate::operate) fn keep_waiting(self) {
        let kept = self.marks.waiting.try_with_untracked(|waiting| {
            (!waiting.is_empty()).then(|| serde_json::to_string(waiting).unwrap_or_default())
        });
        match kept.flatten() {
            Some(text) => Drawer::Tab.put(KEPT_KEY, &text),
            None => Drawer::Tab.drop(KEPT_KEY),
        }
    }

    /// Drops what waits for runs of an earlier start of the server, and says so; whether all that is left is of this one.
    fn drop_of_earlier_starts(self) {
        let epoch = self.desk.desk().epoch.get_untracked();
        let lost = self.marks.waiting.with_untracked(|waiting| {
            let lost = |one: &&WaitingMark| one.epoch != epoch;
            waiting.iter().find(lost).map(|one| one.at)
        });
        let Some(at) = lost else { return };
        self.marks.waiting.update(|waiting| waiting.retain(|one| one.epoch == epoch));
        self.marks.all.update(|all| all.retain(|mark| !mark.waits));
        self.keep_waiting();
        self.desk.desk().say(&words::mark_of_earlier_start(&time_of_day(at)), true);
    }

    /// Sends what waits, one after the other, each with the age of its press; what finds no link waits on.
    pub(in crate::operate) fn send_marks(self) {
        // Nothing of it is there any more once the page has ended.
        let some = self.marks.waiting.try_with_untracked(|waiting| !waiting.is_empty());
        if some != Some(true) || self.marks.goes.get_untracked() || self.desk.desk().epoch.get_untracked() == 0 {
            return;
        }
        self.drop_of_earlier_starts();
        let Some(first) = self.marks.waiting.with_untracked(|waiting| waiting.front().cloned()) else { return };
        self.marks.goes.set(true);
        if link::is_up() {
            self.marks.waiting.update(|waiting| waiting.iter_mut().take(1).for_each(|one| one.tried = true));
            self.keep_waiting();
        }
        let ago_ms = (browser::today_ms() - first.at).max(0.0) as u64;
        // The server moves it to a minute ago.
        let too_old = (ago_ms > AGO_MAX_MS && first.is_moment()).then(|| time_of_day(first.at));
        let then: OnMarked = Box::new(move |answer| {
            if self.marks.goes.try_set(false).is_some() {
                return;
            }
            match answer {
                Err(NoAnswer::Unreachable | NoAnswer::Refused(Refused::TooFast)) => {
                    return browser::after(AGAIN_MS, move || self.send_marks());
                }
                Err(NoAnswer::Refused(no)) => {
                    self.desk.desk().say_no(&no);
                    let mut waiting = self.marks.waiting.get_untracked();
                    let is_told_anew = self.marks.all.try_update(|all| refused(&mut waiting, all)) == Some(true);
                    self.marks.waiting.set(waiting);
                    if is_told_anew {
                        hear_anew(self);
                    }
                }
                Ok(answer::Marked { mark, .. }) => self.was_sent(&mark, too_old),
            }
            self.keep_waiting();
            self.send_marks();
        });
        first.ask(&self.desk.desk(), ago_ms, then);
    }

    /// The server has what stood first.
    fn was_sent(self, sent: &RecordingMark, too_old: Option<String>) {
        if let Some(at) = too_old {
            self.desk.desk().say(&words::mark_too_old(&at), true);
        }
        self.marks.waiting.update(|waiting| drop(waiting.pop_front()));
        let waits = self.marks.waiting.with_untracked(|waiting| waiting.iter().any(|one| one.id == sent.id));
        self.marks.all.update(|all| {
            all.iter_mut().filter(|mark| mark.id == sent.id).for_each(|mark| mark.waits = waits);
            all.retain(|mark| mark.id != sent.id || !sent.gone);
        });
    }
}

/// Tries at once when the server greets again.
pub(in crate::operate) fn when_back(op: OperateShared) {
    Effect::new(move |_| {
        let greeted = op.desk.desk().epoch.get() > 0;
        if greeted && op.desk.desk().online.get() == crate::desk::LinkState::Online && link::is_up() {
            op.send_marks();
        }
    });
}

#[cfg(test)]
mod tests {
    use super::{WaitingMark, WaitingWork, refused, take_back};
    use crate::operate::marks::Mark;
    use behaviour::Id;
    use protocol::{MarkEdit, MarkSort};
    use std::collections::VecDeque;

    fn waits(id: &str, at: f64, what: WaitingWork) -> WaitingMark {
        WaitingMark { epoch: 3, run: 7, id: Id::new(id).unwrap(), at, what, tried: false }
    }

    fn mark(span: bool) -> WaitingWork {
        WaitingWork::Mark { behaviour: Id::new("game").unwrap(), word: "laughs".to_owned(), span }
    }

    fn edit(edit: MarkEdit) -> WaitingWork {
        WaitingWork::Edit(edit)
    }

    #[test]
    fn what_waited_before_a_reload_is_shown_as_it_was_and_only_once() {
        let waiting: VecDeque<WaitingMark> = [
            waits("a", 2_000.0, mark(true)),
            waits("b", 1_000.0, mark(false)),
            waits("a", 5_000.0, edit(MarkEdit::End)),
            waits("b", 6_000.0, edit(MarkEdit::Note("he laughs".to_owned()))),
            waits("b", 6_500.0, edit(MarkEdit::Sort(MarkSort::Good))),
            waits("c", 7_000.0, mark(false)),
            waits("c", 8_000.0, edit(MarkEdit::Undo)),
        ]
        .into();
        let kept = serde_json::to_string(&waiting).unwrap();
        let again: VecDeque<WaitingMark> = crate::json::read(&kept).unwrap();
        assert_eq!(again, waiting);
        let mut all: Vec<Mark> = Vec::new();
        for one in again.iter().chain(&waiting) {
            one.show(&mut all, "Aiko");
        }
        let told: Vec<_> = all.iter().map(|mark| (mark.id.as_str(), mark.at, mark.until, mark.note.as_str())).collect();
        assert_eq!(told, [("b", 1_000.0, None, "he laughs"), ("a", 2_000.0, Some(5_000.0), "")]);
        assert!(all.iter().all(|mark| mark.waits && !mark.open && mark.by == "Aiko"), "{all:?}");
        assert_eq!(all[0].sort, MarkSort::Good);
    }

    #[test]
    fn a_mark_that_may_have_come_to_the_server_is_taken_back_there_too() {
        let left = |mut all: VecDeque<WaitingMark>, goes| {
            let never = take_back(&mut all, &Id::new("a").unwrap(), goes);
            (never, all.iter().map(|one| one.id.to_string()).collect::<Vec<_>>())
        };
        let waiting = |id: &str, what, tried| WaitingMark { tried, ..waits(id, 0.0, what) };
        let (none, b) = (Vec::<String>::new(), || waiting("b", mark(false), true));
        // Without a link nothing was tried.
        assert_eq!(left([waiting("a", mark(false), false)].into(), false), (true, none.clone()));
        assert_eq!(left([b(), waiting("a", mark(false), false)].into(), true), (true, vec!["b".to_owned()]));
        // It was sent, and the link broke before the answer: nobody knows.
        assert_eq!(left([waiting("a", mark(false), true)].into(), false), (false, none));
        // On its way just now, and its note behind it.
        let note = waiting("a", edit(MarkEdit::Note(String::new())), false);
        assert_eq!(left([waiting("a", mark(false), true), note].into(), true), (false, vec!["a".to_owned()]));
    }

    #[test]
    fn a_refused_change_leaves_its_mark_and_a_refused_mark_takes_its_changes_along() {
        let mut waiting: VecDeque<WaitingMark> = [
            waits("a", 1.0, edit(MarkEdit::Sort(MarkSort::Good))),
            waits("b", 2.0, mark(false)),
            waits("b", 3.0, edit(MarkEdit::Note("he laughs".to_owned()))),
        ]
        .into();
        let mut all: Vec<Mark> = Vec::new();
        for one in [waits("a", 0.0, mark(false)), waiting[1].clone()] {
            one.show(&mut all, "Aiko");
        }
        assert!(refused(&mut waiting, &mut all), "it is told anew");
        assert_eq!(
            all.iter().map(|mark| (mark.id.as_str(), mark.waits)).collect::<Vec<_>>(),
            [("a", false), ("b", true)]
        );
        assert!(!refused(&mut waiting, &mut all) && waiting.is_empty());
        assert_eq!(all.iter().map(|mark| mark.id.as_str()).collect::<Vec<_>>(), ["a"]);
    }
}
