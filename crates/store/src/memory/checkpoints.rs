//! Revisions with a name, as the store in memory and the one in a folder have them at hand.

use super::MemoryStore;
use behaviour::{Checkpoint, Id};

impl MemoryStore {
    /// Returns the answer that [`crate::Store::keep_checkpoint`] would give, and whether it would be new.
    pub(crate) fn judge_checkpoint(&self, behaviour: &Id, wanted: &Checkpoint) -> (bool, bool) {
        let kept = self.kept();
        let Some(shelf) = kept.behaviours.get(behaviour) else { return (false, false) };
        match shelf.checkpoints.get(&wanted.name) {
            Some(there) => (there == wanted, false),
            None => ((1..=shelf.head()).contains(&wanted.revision), true),
        }
    }

    /// Keeps a named revision that was judged to be new.
    pub(crate) fn put_checkpoint(&self, behaviour: &Id, new: &Checkpoint) {
        if let Some(shelf) = self.kept().behaviours.get_mut(behaviour) {
            shelf.checkpoints.insert(new.name.clone(), new.clone());
        }
    }

    /// Lets a name go. False if there is none.
    pub(crate) fn take_checkpoint(&self, behaviour: &Id, name: &str) -> bool {
        self.kept().behaviours.get_mut(behaviour).is_some_and(|shelf| shelf.checkpoints.remove(name).is_some())
    }

    /// True if there is such a name.
    pub(crate) fn has_checkpoint(&self, behaviour: &Id, name: &str) -> bool {
        self.kept().behaviours.get(behaviour).is_some_and(|shelf| shelf.checkpoints.contains_key(name))
    }
}
