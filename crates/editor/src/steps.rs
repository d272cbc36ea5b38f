//! One's own steps: what undo would take back and redo would do again, as the server's log has it and what waits adds to it.

use crate::history::{HistoryPanel, is_mine};
use crate::queue::{SendMode, WaitingChange};
use behaviour::Id;
use behaviour::labels::{bare, taken_back};
use phrase::Phrase;

/// One step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct EditStep {
    pub(crate) op: Id,
    /// The label of the change, without the word of undo or redo.
    pub(crate) label: Phrase,
}

/// The changes that can be taken back and done again; the newest is last.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Steps {
    pub(crate) done: Vec<EditStep>,
    pub(crate) undone: Vec<EditStep>,
}

/// The role of a change among steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StepRole {
    Do,
    Undo,
    Redo,
}

impl Steps {
    /// The steps of somebody, from what is known of the history and what waits to be sent.
    pub(crate) fn of<'a>(history: &HistoryPanel, me: &Id, waiting: impl Iterator<Item = &'a WaitingChange>) -> Self {
        let mut steps = Self::default();
        for line in history.oldest_first().filter(|line| is_mine(line, me)) {
            let role = line.undoes.as_ref().map_or(StepRole::Do, |of| steps.role(of, &line.label));
            steps.take(role, &line.op, &line.label, line.undoes.as_ref());
        }
        for WaitingChange { change, way, .. } in waiting {
            let role = match way {
                SendMode::Propose | SendMode::GoBack { .. } | SendMode::BringBack { .. } => StepRole::Do,
                SendMode::TakeBack => StepRole::Undo,
                SendMode::DoAgain => StepRole::Redo,
            };
            steps.take(role, &change.op, &change.label, change.undoes.as_ref());
        }
        steps
    }

    /// Returns the role of a change that takes another one back; of one that is not known any more only the label
    /// tells.
    fn role(&self, of: &Id, label: &Phrase) -> StepRole {
        let has = |steps: &[EditStep]| steps.iter().any(|step| step.op == *of);
        match (has(&self.done), has(&self.undone)) {
            (true, _) => StepRole::Undo,
            (false, true) => StepRole::Redo,
            (false, false) => match taken_back(label) {
                Some(false) => StepRole::Undo,
                Some(true) => StepRole::Redo,
                None => StepRole::Do,
            },
        }
    }

    fn take(&mut self, role: StepRole, op: &Id, label: &Phrase, of: Option<&Id>) {
        let step = EditStep { op: op.clone(), label: bare(label) };
        let other = |other: &EditStep| Some(&other.op) != of;
        match role {
            StepRole::Do => {
                self.undone.clear();
                self.done.push(step);
            }
            StepRole::Undo => {
                self.done.retain(other);
                self.undone.push(step);
            }
            StepRole::Redo => {
                self.undone.retain(other);
                self.done.push(step);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{HistoryPanel, SendMode, Steps, WaitingChange};
    use crate::queue::Queue;
    use behaviour::labels::undo_of;
    use behaviour::{Change, Id};
    use protocol::HistoryLine;

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    /// A history of lines, oldest first: who, the op, the label, what it takes back.
    fn history(lines: &[(&str, &str, &str, &str)]) -> HistoryPanel {
        let mut history = HistoryPanel::default();
        let line = |(revision, (by, op, label, undoes)): (u64, &(&str, &str, &str, &str))| HistoryLine {
            revision,
            op: id(op),
            author: (*by).to_owned(),
            by: Some(id(by)),
            label: (*label).into(),
            at_ms: 0,
            undoes: Id::new(undoes).ok(),
            removes: false,
            edits: Vec::new(),
        };
        let lines: Vec<HistoryLine> = (1..).zip(lines).map(line).collect();
        history.read(&lines, false);
        history
    }

    fn of(history: &HistoryPanel, waiting: &[WaitingChange]) -> [Vec<String>; 2] {
        let steps = Steps::of(history, &id("me"), waiting.iter());
        [steps.done, steps.undone].map(|steps| steps.into_iter().map(|step| step.label.to_string()).collect())
    }

    fn waiting(changes: Vec<(Change, SendMode)>) -> Vec<WaitingChange> {
        let mut queue = Queue::default();
        changes.into_iter().for_each(|(change, way)| assert!(queue.push(id("b"), change, way)));
        queue.waiting_for(&id("b")).cloned().collect()
    }

    #[test]
    fn only_ones_own_changes_are_steps() {
        let history = history(&[("me", "a", "Add A", ""), ("yuki", "b", "Add B", ""), ("me", "c", "Move", "")]);
        assert_eq!(of(&history, &[]), [vec!["Add A", "Move"], vec![]]);
    }

    #[test]
    fn undo_and_redo_walk_between_done_and_undone() {
        let mut lines = vec![("me", "a", "Add A", ""), ("me", "b", "Add B", ""), ("me", "u", "Undo: Add B", "b")];
        assert_eq!(of(&history(&lines), &[]), [vec!["Add A"], vec!["Add B"]]);
        lines.push(("me", "v", "Undo: Add A", "a"));
        assert_eq!(of(&history(&lines), &[]), [vec![], vec!["Add B", "Add A"]]);
        lines.push(("me", "r", "Redo: Add A", "v"));
        assert_eq!(of(&history(&lines), &[]), [vec!["Add A"], vec!["Add B"]]);
        lines.push(("me", "n", "Move", ""));
        assert_eq!(of(&history(&lines), &[]), [vec!["Add A", "Move"], vec![]]);
    }

    #[test]
    fn what_took_back_something_that_is_not_known_any_more_is_told_by_its_label() {
        let older = [("me", "u", "Undo: Move", "long-ago"), ("me", "r", "Redo: Tidy", "also-long-ago")];
        assert_eq!(of(&history(&older), &[]), [vec!["Tidy"], vec!["Move"]]);
    }

    #[test]
    fn what_waits_counts_as_done() {
        let history = history(&[("me", "a", "Add A", "")]);
        let added = Change::of(id("b"), "me", "Add B");
        let undo = added.swapped(id("u"), undo_of(false, &"Add B".into()));
        let all = waiting(vec![(added, SendMode::Propose), (undo, SendMode::TakeBack)]);
        assert_eq!(of(&history, &all[..1]), [vec!["Add A", "Add B"], vec![]]);
        assert_eq!(of(&history, &all), [vec!["Add A"], vec!["Add B"]]);
    }
}
