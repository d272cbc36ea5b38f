//! One's own undo and redo: the last changes of this tab, taken back by their opposite.

use super::Document;
use crate::desk::tab::new_id;
use behaviour::{Change, Id};
use leptos::prelude::Set;
use std::collections::BTreeMap;

/// How many changes can be taken back.
const UNDO_MAX: usize = 100;

/// What a proposed change is for the history.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Something new.
    Do,
    /// Takes the newest of `undone` back.
    Undo,
    /// Does the newest of `done` again.
    Redo,
}

/// Changes of this tab in the open behaviour. A step counts from when it is proposed, so that steps pressed quickly one
/// after the other keep their order; one that is refused is taken out again.
#[derive(Debug, Default)]
pub(super) struct History {
    done: Vec<Change>,
    undone: Vec<Change>,
    /// What is proposed and not answered: for the history, and of which change.
    under_way: BTreeMap<Id, (Role, Id)>,
}

impl History {
    /// A change was proposed; what can be undone grows unless it is an undo or a redo itself.
    pub(super) fn proposed(&mut self, change: &Change) {
        if self.under_way.contains_key(&change.op) {
            return;
        }
        self.under_way.insert(change.op.clone(), (Role::Do, change.op.clone()));
        self.undone.clear();
        self.done.push(change.clone());
        let many = self.done.len().saturating_sub(UNDO_MAX);
        self.done.drain(..many);
    }

    /// It was accepted.
    pub(super) fn accepted(&mut self, op: &Id) {
        self.under_way.remove(op);
    }

    /// It was refused: whoever changed it since, taking it back is no longer ours.
    pub(super) fn refused(&mut self, op: &Id) {
        match self.under_way.remove(op) {
            Some((Role::Do | Role::Redo, of)) => self.done.retain(|change| change.op != of),
            Some((Role::Undo, of)) => self.undone.retain(|change| change.op != of),
            None => {}
        }
    }

    /// It could not even be queued: everything is as before, to be tried again.
    pub(super) fn not_queued(&mut self, op: &Id) {
        match self.under_way.remove(op) {
            Some((Role::Do, of)) => self.done.retain(|change| change.op != of),
            Some((Role::Undo, of)) => put_back(&mut self.undone, &mut self.done, &of),
            Some((Role::Redo, of)) => put_back(&mut self.done, &mut self.undone, &of),
            None => {}
        }
    }

    fn undo(&mut self, op: Id) -> Option<Change> {
        let last = self.done.pop()?;
        let back = last.swapped(op.clone(), &label("Undo", &last.label));
        self.under_way.insert(op, (Role::Undo, last.op.clone()));
        self.undone.push(last);
        Some(back)
    }

    fn redo(&mut self, op: Id) -> Option<Change> {
        let last = self.undone.pop()?;
        let again = Change { op: op.clone(), at_ms: 0, label: label("Redo", &last.label), ..last.clone() };
        self.under_way.insert(op, (Role::Redo, last.op.clone()));
        self.done.push(last);
        Some(again)
    }
}

/// Moves the newest change back to where it came from, if it is this one.
fn put_back(from: &mut Vec<Change>, to: &mut Vec<Change>, op: &Id) {
    to.extend(from.pop_if(|change| change.op == *op));
}

fn label(word: &str, of: &str) -> String {
    let short: String = of.chars().take(behaviour::NAME_MAX_CHARS - 10).collect();
    format!("{word}: {short}")
}

impl Document {
    /// Takes back this person's last change.
    pub(crate) fn undo(&self) {
        let change = self.state().history.undo(new_id());
        self.propose_step(change);
    }

    /// Does again what was taken back last.
    pub(crate) fn redo(&self) {
        let change = self.state().history.redo(new_id());
        self.propose_step(change);
    }

    fn propose_step(&self, change: Option<Change>) {
        if let Some(change) = change {
            self.propose(change);
        }
        self.show_history();
    }

    pub(super) fn show_history(&self) {
        let (undo, redo) = {
            let history = &self.state().history;
            (!history.done.is_empty(), !history.undone.is_empty())
        };
        self.can_undo.set(undo);
        self.can_redo.set(redo);
    }
}

#[cfg(test)]
mod tests {
    use super::History;
    use behaviour::{Behaviour, Change, Id, Kind, Note, Record, RecordId};

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn noted(op: &str, behaviour: &Behaviour) -> Change {
        let note = Record::Note(Note { text: op.into() });
        Change::of(id(op), "Aiko", op).put(behaviour, RecordId::new(Kind::Note, &id("n")), note)
    }

    #[test]
    fn undo_then_redo_ends_where_it_began() {
        let mut behaviour = Behaviour::default();
        let change = noted("a", &behaviour);
        let mut history = History::default();
        history.proposed(&change);
        history.accepted(&id("a"));
        behaviour.apply(&change);
        let with_note = behaviour.clone();
        let back = history.undo(id("b")).unwrap();
        history.accepted(&back.op);
        behaviour.apply(&back);
        assert!(behaviour.records.is_empty());
        let again = history.redo(id("c")).unwrap();
        history.accepted(&again.op);
        behaviour.apply(&again);
        assert_eq!(behaviour, with_note);
        assert!(history.undo(id("d")).is_some() && history.undo(id("e")).is_none());
    }

    #[test]
    fn undos_faster_than_the_answers_keep_their_order() {
        let mut history = History::default();
        for op in ["a", "b"] {
            history.proposed(&noted(op, &Behaviour::default()));
        }
        let labels = ["c", "d"].map(|op| history.undo(id(op)).unwrap().label);
        assert_eq!(labels, ["Undo: b", "Undo: a"]);
        assert_eq!(history.redo(id("e")).unwrap().label, "Redo: a");
    }

    #[test]
    fn an_undo_that_could_not_be_queued_is_the_next_again() {
        let mut history = History::default();
        for op in ["a", "b"] {
            history.proposed(&noted(op, &Behaviour::default()));
        }
        history.undo(id("c")).unwrap();
        history.not_queued(&id("c"));
        assert_eq!(history.undo(id("d")).unwrap().label, "Undo: b");
    }

    #[test]
    fn what_was_refused_cannot_be_undone() {
        let mut history = History::default();
        for op in ["a", "b"] {
            history.proposed(&noted(op, &Behaviour::default()));
        }
        history.refused(&id("b"));
        assert_eq!(history.undo(id("c")).unwrap().label, "Undo: a");
        history.refused(&id("c"));
        assert!(history.redo(id("d")).is_none());
    }
}
