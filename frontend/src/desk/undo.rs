//! One's own undo and redo: the last changes of this tab, taken back by their opposite.

use super::{Desk, new_id};
use behaviour::{Change, Id};
use leptos::prelude::Set;
use std::collections::BTreeMap;

/// How many changes can be taken back.
const UNDO_MAX: usize = 100;

/// What a proposed change means for the history.
#[derive(Clone, Debug, PartialEq)]
enum Role {
    /// Something new.
    Do,
    /// Takes back this one.
    Undo(Change),
    /// Does this one again.
    Redo(Change),
}

/// Changes of this tab in the open behaviour.
#[derive(Debug, Default)]
pub(super) struct History {
    done: Vec<Change>,
    undone: Vec<Change>,
    under_way: BTreeMap<Id, Role>,
}

impl History {
    /// A new change was proposed.
    pub(super) fn proposed(&mut self, op: &Id) {
        self.under_way.entry(op.clone()).or_insert(Role::Do);
    }

    /// It was accepted.
    pub(super) fn accepted(&mut self, change: &Change) {
        match self.under_way.remove(&change.op) {
            Some(Role::Do) => {
                self.undone.clear();
                self.done.push(change.clone());
            }
            Some(Role::Undo(original)) => self.undone.push(original),
            Some(Role::Redo(original)) => self.done.push(original),
            None => {}
        }
        let many = self.done.len().saturating_sub(UNDO_MAX);
        self.done.drain(..many);
    }

    /// It was refused: whoever changed it since, taking it back is no longer ours.
    pub(super) fn refused(&mut self, op: &Id) {
        self.under_way.remove(op);
    }

    fn undo(&mut self, op: Id) -> Option<Change> {
        let last = self.done.pop()?;
        let back = last.swapped(op.clone(), &label("Undo", &last.label));
        self.under_way.insert(op, Role::Undo(last));
        Some(back)
    }

    fn redo(&mut self, op: Id) -> Option<Change> {
        let last = self.undone.pop()?;
        let again = Change { op: op.clone(), at_ms: 0, label: label("Redo", &last.label), ..last.clone() };
        self.under_way.insert(op, Role::Redo(last));
        Some(again)
    }
}

fn label(word: &str, of: &str) -> String {
    let short: String = of.chars().take(behaviour::NAME_MAX_CHARS - 10).collect();
    format!("{word}: {short}")
}

impl Desk {
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

    #[test]
    fn undo_then_redo_ends_where_it_began() {
        let id = |text: &str| Id::new(text).unwrap();
        let note = Record::Note(Note { text: "x".into() });
        let mut behaviour = Behaviour::default();
        let change = Change::of(id("a"), "Aiko", "Note").put(&behaviour, RecordId::new(Kind::Note, &id("n")), note);
        let mut history = History::default();
        history.proposed(&id("a"));
        history.accepted(&change);
        behaviour.apply(&change);
        let with_note = behaviour.clone();
        let back = history.undo(id("b")).unwrap();
        history.accepted(&back);
        behaviour.apply(&back);
        assert!(behaviour.records.is_empty());
        let again = history.redo(id("c")).unwrap();
        history.accepted(&again);
        behaviour.apply(&again);
        assert_eq!(behaviour, with_note);
        assert!(history.undo(id("d")).is_some() && history.undo(id("e")).is_none());
    }
}
