//! One's own undo and redo. The server's log says what is taken back, so that it survives a reload; what the server was not
//! asked for yet is only taken out of the queue.
//! Everything else is asked in its turn, under one name until it is answered, and goes with the change it was for if that is
//! refused.

use crate::Editor;
use crate::queue::{SendMode, WaitingChange};
use crate::steps::{EditStep, Steps};
use behaviour::labels::undo_of;
use behaviour::{Change, Id};
use std::collections::VecDeque;

/// Of so many own changes it is remembered what they changed, to show at once what taking them back makes of it.
const REMEMBERED_MAX: usize = 200;

/// The knowledge of this page about its own changes beside the history.
#[derive(Debug, Default)]
pub(crate) struct Mine {
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
    pub(crate) fn made(&mut self, change: &Change) {
        if self.made.len() >= REMEMBERED_MAX {
            self.made.pop_front();
        }
        self.made.push_back(change.clone());
    }

    /// Something new was done: what was taken back before cannot be done again.
    pub(crate) fn begin_anew(&mut self) {
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

impl Editor {
    /// Takes back this person's last change.
    pub fn undo(&mut self) {
        let Some(open) = (*self.open).clone() else { return };
        let above = self.steps(&open).undone.len();
        match self.queue.withdraw(&open, |newest| newest.way != SendMode::TakeBack) {
            Some(waiting) => {
                self.withdrawn(&waiting);
                if waiting.way != SendMode::DoAgain {
                    self.mine.withdrawn.push(Withdrawn { waiting, above });
                }
            }
            None => self.ask_step(open, false),
        }
        self.show_steps();
    }

    /// Does again what was taken back last.
    pub fn redo(&mut self) {
        let Some(open) = (*self.open).clone() else { return };
        let undone = self.steps(&open).undone.len();
        if let Some(waiting) = self.queue.withdraw(&open, |newest| newest.way == SendMode::TakeBack) {
            self.withdrawn(&waiting);
        } else if !self.put_again(&open, undone) {
            self.ask_step(open, true);
        }
        self.show_steps();
    }

    /// Forgets a change that was taken out of the queue: it is not shown and not waited for any more.
    fn withdrawn(&mut self, waiting: &WaitingChange) {
        self.settle(&waiting.change);
        self.tell(&waiting.change.op, Ok(()));
        self.pump();
    }

    /// Puts what was withdrawn last into the queue again, if that comes next.
    fn put_again(&mut self, open: &Id, undone: usize) -> bool {
        let Some(again) = self.mine.next(undone).cloned() else { return false };
        let made = (again.revision, again.made_ms, again.offline);
        self.queue_made(open.clone(), (again.change, again.way), made);
        self.mine.withdrawn.pop();
        true
    }

    /// Asks for one step. What it will make is shown as far as it is known; the log decides.
    fn ask_step(&mut self, open: Id, again: bool) {
        let steps = self.steps(&open);
        let step = if again { steps.undone.last() } else { steps.done.last() };
        let Some(step) = step else { return };
        let change = self.opposite(&open, step, again);
        self.queue_up(open, (change, if again { SendMode::DoAgain } else { SendMode::TakeBack }));
    }

    fn opposite(&mut self, open: &Id, step: &EditStep, again: bool) -> Change {
        let (op, label) = (self.next_id(), undo_of(again, &step.label));
        let waiting = self.queue.waiting_for(open).map(|waiting| &waiting.change).find(|change| change.op == step.op);
        match waiting.or_else(|| self.mine.change(&step.op)) {
            Some(change) => change.swapped(op, label),
            None => Change { undoes: Some(step.op.clone()), ..Change::of(op, &self.me.name, label) },
        }
    }

    fn steps(&self, open: &Id) -> Steps {
        let waiting = self.queue.waiting_for(open);
        self.me.client.as_ref().map_or_else(Steps::default, |me| Steps::of(&self.history, me, waiting))
    }

    /// Shows what can be taken back and done again.
    pub fn show_steps(&mut self) {
        let (mut undo, mut redo) = (None, None);
        if let Some(open) = &*self.open {
            let steps = self.steps(open);
            let withdrawn = self.mine.next(steps.undone.len()).map(|waiting| waiting.change.label.clone());
            undo = steps.done.last().map(|step| step.label.clone());
            redo = withdrawn.or_else(|| steps.undone.last().map(|step| step.label.clone()));
        }
        self.undoable.set(undo);
        self.redoable.set(redo);
        self.seek_own_change();
    }
}

#[cfg(test)]
mod tests {
    use super::{Mine, REMEMBERED_MAX, Withdrawn};
    use crate::queue::{Queue, SendMode};
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
