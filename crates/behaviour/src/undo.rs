//! One's own undo and redo, read from the log: they survive a reload, and go on at another device of the same person.
//!
//! Whose a value is follows from the log too: taking a change back makes a record again what it was, and again the value of
//! who made it so. So a change can be taken back exactly if everything it made is still there.

use crate::labels::undo_of;
use crate::{Change, Committed, Edit, Id, Lookup, RecordId, Refusal, Room};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Changes that one person can take back.
pub const UNDO_MAX: usize = 100;

/// The change that made a record what it is. Revision 0 is from before the log.
#[derive(Clone, Debug, PartialEq, Eq)]
struct RecordVersion {
    revision: u64,
    author: Arc<str>,
}

/// A change, and which version of each record it found and left.
#[derive(Clone, Debug)]
struct UndoStep {
    change: Change,
    found: BTreeMap<RecordId, RecordVersion>,
    left: BTreeMap<RecordId, RecordVersion>,
}

/// The changes that one person can take back and do again; the newest is last.
#[derive(Clone, Debug, Default)]
struct PersonSteps {
    done: Vec<UndoStep>,
    undone: Vec<UndoStep>,
}

/// The log as undo reads it. Made of all changes or of the newest ones, in order; what a person did before those stays done.
#[derive(Clone, Debug, Default)]
pub struct UndoLog {
    versions: BTreeMap<RecordId, RecordVersion>,
    people: Lookup<Id, PersonSteps>,
}

impl UndoLog {
    /// Reads the changes of a log, the oldest first.
    #[must_use]
    pub fn of<'a>(log: impl IntoIterator<Item = &'a Committed>) -> Self {
        let mut read = Self::default();
        log.into_iter().for_each(|committed| read.take(committed));
        read
    }

    /// Reads one more change.
    pub fn take(&mut self, committed: &Committed) {
        let Committed { revision, change } = committed;
        let taken_back = self.taken_back(change);
        let new = RecordVersion { revision: *revision, author: Arc::from(change.author.as_str()) };
        let mut step = UndoStep { change: change.clone(), found: BTreeMap::new(), left: BTreeMap::new() };
        for Edit { id, .. } in &change.edits {
            let earlier = taken_back.as_ref().and_then(|(_, step)| step.found.get(id));
            step.found.insert(id.clone(), self.version(id));
            step.left.insert(id.clone(), earlier.unwrap_or(&new).clone());
        }
        self.versions.extend(step.left.iter().map(|(id, left)| (id.clone(), left.clone())));
        let Some(steps) = change.by.as_ref().map(|by| self.people.entry(by.clone()).or_default()) else { return };
        match taken_back {
            Some((UndoSide::Done, _)) => steps.undone.push(step),
            Some((UndoSide::Undone, _)) => steps.done.push(step),
            None => {
                steps.undone.clear();
                steps.done.push(step);
            }
        }
        let many = steps.done.len().saturating_sub(UNDO_MAX);
        steps.done.drain(..many);
    }

    /// The change named `op` that takes back the last change of `by` which is not taken back yet, as a whole.
    ///
    /// # Errors
    /// Refuses if there is none, or if somebody changed something of it since; the refusal names them.
    pub fn undo(&self, by: &Id, op: Id, room: &Room) -> Result<Change, Refusal> {
        let last = self.people.get(by).and_then(|steps| steps.done.last());
        self.opposite(last, op, false, room)
    }

    /// The change named `op` that does again what `by` took back last and did nothing new since.
    ///
    /// # Errors
    /// Refuses if there is none, or if somebody changed something of it since; the refusal names them.
    pub fn redo(&self, by: &Id, op: Id, room: &Room) -> Result<Change, Refusal> {
        let last = self.people.get(by).and_then(|steps| steps.undone.last());
        self.opposite(last, op, true, room)
    }

    /// The last change of a person that is not taken back yet: what [`Self::undo`] would take back.
    #[must_use]
    pub fn last(&self, by: &Id) -> Option<&Change> {
        self.people.get(by)?.done.last().map(|step| &step.change)
    }

    fn opposite(&self, step: Option<&UndoStep>, op: Id, again: bool, room: &Room) -> Result<Change, Refusal> {
        let step = step.ok_or(Refusal::NothingToUndo)?;
        if let Some((id, version)) = self.changed_since(step) {
            let seen = step.change.edits.iter().find(|edit| edit.id == *id);
            let seen = seen.and_then(|edit| edit.after.as_ref().or(edit.before.as_ref()));
            return Err(Refusal::ChangedSince { what: room.call(id, seen), by: version.author.to_string() });
        }
        Ok(step.change.swapped(op, undo_of(again, &step.change.label)))
    }

    /// The first record that is not as this step left it, and what it is now.
    fn changed_since<'a>(&self, step: &'a UndoStep) -> Option<(&'a RecordId, RecordVersion)> {
        let now = step.left.iter().map(|(id, left)| (id, self.version(id), left));
        now.filter(|(_, now, left)| now != *left).map(|(id, now, _)| (id, now)).next()
    }

    fn version(&self, id: &RecordId) -> RecordVersion {
        self.versions.get(id).cloned().unwrap_or_else(|| RecordVersion { revision: 0, author: Arc::from("Somebody") })
    }

    /// The step that a change takes back, out of where it was. What a change says of itself counts only if it is true.
    fn taken_back(&mut self, change: &Change) -> Option<(UndoSide, UndoStep)> {
        let (by, undoes) = (change.by.as_ref()?, change.undoes.as_ref()?);
        let steps = self.people.get(by)?;
        let find = |steps: &[UndoStep]| steps.iter().position(|step| step.change.op == *undoes);
        let (side, at) = find(&steps.done)
            .map(|at| (UndoSide::Done, at))
            .or_else(|| find(&steps.undone).map(|at| (UndoSide::Undone, at)))?;
        let step = steps.of(side).get(at)?;
        let is_true = step.change.swapped(change.op.clone(), "").edits == change.edits;
        if !is_true || self.changed_since(step).is_some() {
            return None;
        }
        let steps = self.people.get_mut(by)?;
        Some((side, steps.of_mut(side).remove(at)))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum UndoSide {
    Done,
    Undone,
}

impl PersonSteps {
    fn of(&self, side: UndoSide) -> &Vec<UndoStep> {
        if side == UndoSide::Done { &self.done } else { &self.undone }
    }

    fn of_mut(&mut self, side: UndoSide) -> &mut Vec<UndoStep> {
        if side == UndoSide::Done { &mut self.done } else { &mut self.undone }
    }
}

#[cfg(test)]
mod tests;
