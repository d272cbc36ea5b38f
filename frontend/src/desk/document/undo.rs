//! One's own undo and redo. The server's log says what is taken back, so that it survives a reload; what the server was not
//! asked for yet is only taken out of the queue.
//! Everything else is asked in its turn, under one name until it is answered, and goes with the change it was for if that is
//! refused.

use super::Document;
use super::queue::{SendMode, WaitingChange};
use super::steps::{EditStep, Steps, label_of};
use crate::desk::tab::{new_id, set_if_new};
use behaviour::{Change, Id};
use leptos::prelude::*;
use protocol::Role;
use std::collections::VecDeque;

/// Of so many own changes it is remembered what they changed, to show at once what taking them back makes of it.
const REMEMBERED_MAX: usize = 200;

/// The knowledge of this page about its own changes beside the history.
#[derive(Debug, Default)]
pub(super) struct Mine {
    made: VecDeque<Change>,
    withdrawn: Vec<Withdrawn>,
}

/// A change that the server was never asked for, as it was taken back before.
#[derive(Debug)]
struct Withdrawn {
    waiting: WaitingChange,
    /// The number of steps that had been taken back in the log by then; a step that was taken back later is done again
    /// earlier.
    above: usize,
}

impl Mine {
    /// A change of one's own was made.
    pub(super) fn made(&mut self, change: &Change) {
        if self.made.len() >= REMEMBERED_MAX {
            self.made.pop_front();
        }
        self.made.push_back(change.clone());
    }

    /// Something new was done: what was taken back before cannot be done again.
    pub(super) fn begin_anew(&mut self) {
        self.withdrawn.clear();
    }

    fn change(&self, op: &Id) -> Option<&Change> {
        self.made.iter().rfind(|change| change.op == *op)
    }

    /// Returns what is to be done again before anything that the log has, if so many steps are taken back there.
    fn next(&self, undone: usize) -> Option<&WaitingChange> {
        self.withdrawn.last().filter(|withdrawn| withdrawn.above >= undone).map(|withdrawn| &withdrawn.waiting)
    }
}

impl Document {
    /// Takes back this person's last change.
    pub(crate) fn undo(&self) {
        let Some(open) = self.open.get_untracked().filter(|_| !self.tab.refuses(Role::Editor)) else { return };
        let above = self.steps(&open).undone.len();
        let withdrawn = self.state().queue.withdraw(&open, |newest| newest.way != SendMode::TakeBack);
        match withdrawn {
            Some(waiting) => {
                self.withdrawn(&waiting);
                if waiting.way != SendMode::DoAgain {
                    self.state().mine.withdrawn.push(Withdrawn { waiting, above });
                }
            }
            None => self.step(open, false),
        }
        self.show_steps();
    }

    /// Does again what was taken back last.
    pub(crate) fn redo(&self) {
        let Some(open) = self.open.get_untracked().filter(|_| !self.tab.refuses(Role::Editor)) else { return };
        let undone = self.steps(&open).undone.len();
        let withdrawn = self.state().queue.withdraw(&open, |newest| newest.way == SendMode::TakeBack);
        if let Some(waiting) = withdrawn {
            self.withdrawn(&waiting);
        } else if !self.put_again(&open, undone) {
            self.step(open, true);
        }
        self.show_steps();
    }

    /// Forgets a change that was taken out of the queue: it is not shown and not waited for any more.
    fn withdrawn(&self, waiting: &WaitingChange) {
        self.settle(&waiting.change)(Ok(()));
        self.pump();
    }

    /// Puts what was withdrawn last into the queue again, if that comes next.
    fn put_again(&self, open: &Id, undone: usize) -> bool {
        let next = self.state().mine.next(undone).cloned();
        let Some(WaitingChange { change, way, .. }) = next else { return false };
        let tab = self.tab.clone();
        self.queue_up(open.clone(), (change, way), move |answer| tab.say_refusal(answer));
        self.state().mine.withdrawn.pop();
        true
    }

    /// Asks for one step. What it will make is shown as far as it is known; the log decides.
    fn step(&self, open: Id, again: bool) {
        let steps = self.steps(&open);
        let step = if again { steps.undone.last() } else { steps.done.last() };
        let Some(step) = step else { return };
        let change = self.opposite(&open, step, again);
        let way = if again { SendMode::DoAgain } else { SendMode::TakeBack };
        let tab = self.tab.clone();
        self.queue_up(open, (change, way), move |answer| tab.say_refusal(answer));
    }

    fn opposite(&self, open: &Id, step: &EditStep, again: bool) -> Change {
        let (op, label) = (new_id(), label_of(again, &step.label));
        let state = self.state();
        let waiting = state.queue.waiting_for(open).map(|waiting| &waiting.change).find(|change| change.op == step.op);
        match waiting.or_else(|| state.mine.change(&step.op)) {
            Some(change) => change.swapped(op, &label),
            None => Change { undoes: Some(step.op.clone()), ..Change::of(op, &self.tab.my_name(), &label) },
        }
    }

    pub(super) fn steps(&self, open: &Id) -> Steps {
        let Some(me) = self.tab.me.with_untracked(|me| me.as_ref().map(|me| me.client.clone())) else {
            return Steps::default();
        };
        let state = self.state();
        self.history.with_untracked(|history| Steps::of(history, &me, state.queue.waiting_for(open)))
    }

    /// Shows what can be taken back and done again.
    pub(super) fn show_steps(&self) {
        let (mut undo, mut redo) = (None, None);
        if let Some(open) = self.open.get_untracked() {
            let steps = self.steps(&open);
            let withdrawn = self.state().mine.next(steps.undone.len()).map(|waiting| waiting.change.label.clone());
            undo = steps.done.last().map(|step| step.label.clone());
            redo = withdrawn.or_else(|| steps.undone.last().map(|step| step.label.clone()));
        }
        set_if_new(&self.undoable, undo);
        set_if_new(&self.redoable, redo);
    }
}

#[cfg(test)]
mod tests {
    use super::{Mine, REMEMBERED_MAX, Withdrawn};
    use crate::desk::document::queue::{Queue, SendMode};
    use behaviour::{Change, Id};

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn withdrawn(op: &str, above: usize) -> Withdrawn {
        let mut queue = Queue::default();
        queue.push(id("b"), Change::of(id(op), "Aiko", op), SendMode::Propose);
        Withdrawn { waiting: queue.withdraw(&id("b"), |_| true).unwrap(), above }
    }

    #[test]
    fn what_was_withdrawn_comes_back_before_what_was_taken_back_earlier_and_after_what_was_later() {
        let mut mine = Mine { withdrawn: vec![withdrawn("b", 1), withdrawn("a", 1)], ..Mine::default() };
        let next = |mine: &Mine, undone| mine.next(undone).map(|waiting| waiting.change.op.to_string());
        assert_eq!(next(&mine, 2), None, "a step of the log was taken back later");
        assert_eq!(next(&mine, 1).as_deref(), Some("a"));
        mine.withdrawn.pop();
        assert_eq!(next(&mine, 0).as_deref(), Some("b"));
        mine.begin_anew();
        assert_eq!(next(&mine, 0), None);
    }

    #[test]
    fn what_is_remembered_is_bounded() {
        let mut mine = Mine::default();
        (0..=REMEMBERED_MAX).for_each(|at| mine.made(&Change::of(id(&format!("op{at}")), "Aiko", "Move")));
        assert_eq!((mine.made.len(), mine.change(&id("op0"))), (REMEMBERED_MAX, None));
        assert!(mine.change(&id("op200")).is_some());
    }
}
