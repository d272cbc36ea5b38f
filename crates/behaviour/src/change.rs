//! A change: one gesture of one person. It adds, edits, removes, undoes, is broadcast, saved and shown as history.

use crate::{Behaviour, Id, Record, RecordId};
use phrase::Phrase;
use serde::{Deserialize, Serialize};

/// One record before and after; absent means it was, or is, not there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// The id of the record that changes.
    pub id: RecordId,
    /// The record before the change; none if it was not there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<Record>,
    /// The record after the change; none if it is gone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after: Option<Record>,
}

/// One gesture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// Names this change for ever: sent twice, it is applied once.
    pub op: Id,
    /// The name of the person who made it.
    pub author: String,
    /// Says the effect in a few words: "Rename Red Ball". Older versions wrote a text, which stays as it is.
    pub label: Phrase,
    /// The time when it was made, in milliseconds since 1970, as the server's clock had it on arrival.
    pub at_ms: u64,
    /// The id of the person, which stays when their name does not. The server says it, whatever its sender wrote; none in
    /// changes that nobody can take back as their own, such as those of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<Id>,
    /// The change that this one takes back; if that took one back itself, this one does it again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undoes: Option<Id>,
    /// The edits of this change; each record occurs at most once.
    pub edits: Vec<Edit>,
}

impl Change {
    /// A change without edits yet.
    #[must_use]
    pub fn of(op: Id, author: &str, label: impl Into<Phrase>) -> Self {
        let (author, label) = (author.to_owned(), label.into());
        Self { op, author, label, at_ms: 0, by: None, undoes: None, edits: Vec::new() }
    }

    /// Also puts `after` where `behaviour` has what it has now. Touching a record again replaces what this change
    /// says of it and keeps what it was at first.
    #[must_use]
    pub fn put(self, behaviour: &Behaviour, id: RecordId, after: Record) -> Self {
        self.with(behaviour, id, Some(after))
    }

    /// Also takes a record away.
    #[must_use]
    pub fn take(self, behaviour: &Behaviour, id: RecordId) -> Self {
        self.with(behaviour, id, None)
    }

    fn with(mut self, behaviour: &Behaviour, id: RecordId, after: Option<Record>) -> Self {
        if let Some(edit) = self.edits.iter_mut().find(|edit| edit.id == id) {
            edit.after = after;
            return self;
        }
        let before = behaviour.records.get(&id).cloned();
        if before != after {
            self.edits.push(Edit { id, before, after });
        }
        self
    }

    /// True if both make the same edits and take back the same change. Author, time and label are not compared, as the
    /// server sets some of them.
    #[must_use]
    pub fn does_as(&self, other: &Self) -> bool {
        self.edits == other.edits && self.undoes == other.undoes
    }

    /// The change that undoes this one, under a new name.
    #[must_use]
    pub fn swapped(&self, op: Id, label: impl Into<Phrase>) -> Self {
        let edits = self.edits.iter().rev();
        let edits =
            edits.map(|edit| Edit { id: edit.id.clone(), before: edit.after.clone(), after: edit.before.clone() });
        let (by, undoes) = (self.by.clone(), Some(self.op.clone()));
        Self { by, undoes, edits: edits.collect(), ..Self::of(op, &self.author, label) }
    }
}

impl Behaviour {
    /// Applies a change without asking any rule. Use [`crate::Room`] where people's edits arrive.
    pub fn apply(&mut self, change: &Change) {
        for edit in &change.edits {
            match &edit.after {
                Some(record) => self.records.insert(edit.id.clone(), record.clone()),
                None => self.records.remove(&edit.id),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Change;
    use crate::{Behaviour, Id, Kind, Note, Record, RecordId};

    fn note(text: &str) -> Record {
        Record::Note(Note::new(text.into()))
    }

    #[test]
    fn whatever_is_done_can_be_undone_the_same_way() {
        let id = |name: &str| RecordId::new(Kind::Note, &Id::new(name).unwrap());
        let mut behaviour = Behaviour::default();
        behaviour.records.insert(id("a"), note("one"));
        let start = behaviour.clone();
        let change = Change::of(Id::new("op1").unwrap(), "Aiko", "Tidy notes");
        let change = change.put(&behaviour, id("b"), note("new")).take(&behaviour, id("a"));
        behaviour.apply(&change);
        assert_eq!(behaviour.records.len(), 1);
        behaviour.apply(&change.swapped(Id::new("op2").unwrap(), "Undo"));
        assert_eq!(behaviour, start);
    }

    #[test]
    fn a_change_of_an_older_version_is_read_and_written_as_it_was() {
        let old = r#"{"op":"a","author":"Aiko","label":"x","at_ms":1,"edits":[]}"#;
        let change: Change = serde_json::from_str(old).unwrap();
        assert_eq!((&change.by, &change.undoes), (&None, &None));
        assert_eq!(serde_json::to_string(&change).unwrap(), old);
    }

    #[test]
    fn an_edit_that_changes_nothing_is_no_edit() {
        let mut behaviour = Behaviour::default();
        let id = RecordId::new(Kind::Note, &Id::new("a").unwrap());
        behaviour.records.insert(id.clone(), note("same"));
        let change = Change::of(Id::new("op").unwrap(), "", "").put(&behaviour, id, note("same"));
        assert!(change.edits.is_empty());
    }
}
