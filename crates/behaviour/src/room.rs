//! The room of one open behaviour: the only writer, and pure. It decides; the server saves and tells.
//!
//! A change goes through in two steps, because nobody may see an edit that can still vanish: [`Room::propose`] decides
//! and changes nothing; once the store has the change, [`Room::commit`] makes it the room's truth.

use crate::size::Size;
use crate::{Behaviour, Change, EDITS_MAX, Id, Knowledge, Record, RecordId, Refusal, rules, without_unseen};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, VecDeque};

/// How many answered changes a room remembers, to answer one sent twice; the store remembers all.
const ANSWERED_MAX: usize = 1_024;

/// A behaviour, its revision and what was answered lately.
#[derive(Clone, Debug)]
pub struct Room {
    behaviour: Behaviour,
    revision: u64,
    /// Of the behaviour, so that a change costs what it touches.
    size: Size,
    answered: BTreeMap<Id, u64>,
    answered_order: VecDeque<Id>,
}

/// What becomes of a proposed change.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Save it as this revision, then commit it.
    Save(Committed),
    /// It was already made, as this revision.
    Duplicate(u64),
    /// It is not made.
    Refuse(Refusal),
}

/// A change with the revision it makes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Committed {
    /// The revision of the behaviour after the change.
    pub revision: u64,
    /// The change.
    pub change: Change,
}

/// A change that was saved, with its revision, as it is told to everyone.
pub type Accepted = Committed;

impl Room {
    /// The room of a behaviour as the store has it.
    #[must_use]
    pub fn open(behaviour: Behaviour, revision: u64) -> Self {
        let size = Size::of(&behaviour);
        Self { behaviour, revision, size, answered: BTreeMap::new(), answered_order: VecDeque::new() }
    }

    /// Whether changes that make a behaviour from nothing, one after the other, keep the rules.
    ///
    /// # Errors
    /// The first refusal.
    pub fn rehearse(changes: &[Change], knowledge: &dyn Knowledge) -> Result<(), Refusal> {
        let mut room = Self::open(Behaviour::default(), 0);
        for change in changes {
            match room.propose(0, change.clone(), knowledge) {
                Decision::Save(committed) => room.commit(&committed),
                Decision::Duplicate(_) => {}
                Decision::Refuse(refusal) => return Err(refusal),
            }
        }
        Ok(())
    }

    /// The behaviour as everyone may see it.
    #[must_use]
    pub fn behaviour(&self) -> &Behaviour {
        &self.behaviour
    }

    /// How large its records are together, in bytes: at most 8 MiB unless an older version made it, and never less than
    /// they take in a message or file.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.size.bytes()
    }

    /// Its revision: the number of changes ever made.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Decides about a change that arrived at `now_ms` (since 1970). Checks in order: sent twice, whole, every
    /// touched record as its sender saw it, the rules.
    #[must_use]
    pub fn propose(&self, now_ms: u64, change: Change, knowledge: &dyn Knowledge) -> Decision {
        if let Some(revision) = self.answered.get(&change.op) {
            return Decision::Duplicate(*revision);
        }
        match self.judge(&change, knowledge) {
            Ok(()) => {
                let (label, author) = (without_unseen(&change.label), without_unseen(&change.author));
                let change = Change { at_ms: now_ms, label, author, ..change };
                Decision::Save(Committed { revision: self.revision + 1, change })
            }
            Err(refusal) => Decision::Refuse(refusal),
        }
    }

    fn judge(&self, change: &Change, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
        check_whole(change)?;
        for edit in &change.edits {
            let current = self.behaviour.records.get(&edit.id);
            if current != edit.before.as_ref() {
                return Err(Refusal::Stale(self.call(&edit.id, edit.before.as_ref())));
            }
        }
        if change.edits.iter().any(|edit| edit.id == RecordId::settings() && edit.after.is_none()) {
            return Err(Refusal::Malformed("the settings cannot be removed".into()));
        }
        let mut after = self.behaviour.clone();
        after.apply(change);
        rules::check(&after, change, &self.size, knowledge)
    }

    /// What a person calls a record, as it is now or as they saw it.
    fn call(&self, id: &RecordId, seen: Option<&Record>) -> String {
        let record = self.behaviour.records.get(id).or(seen);
        match record {
            Some(Record::Stream(stream)) => format!("“{}”", stream.name),
            Some(Record::Helper(helper)) => format!("the helper “{}”", helper.name),
            Some(Record::Connector(connector)) => format!("this {}", connector.operation.word()),
            Some(Record::Settings(_)) => "the name or settings".to_owned(),
            Some(Record::Place(_)) => "this position".to_owned(),
            Some(Record::Note(_)) => "this note".to_owned(),
            None => "this".to_owned(),
        }
    }

    /// Makes a saved change the truth. The caller saved it first; revisions come in order.
    pub fn commit(&mut self, saved: &Committed) {
        debug_assert_eq!(saved.revision, self.revision + 1, "revisions come in order");
        self.behaviour.apply(&saved.change);
        self.size = self.size.after(&saved.change);
        self.revision = saved.revision;
        self.remember(saved.change.op.clone(), saved.revision);
    }

    fn remember(&mut self, op: Id, revision: u64) {
        self.answered.insert(op.clone(), revision);
        self.answered_order.push_back(op);
        if self.answered_order.len() > ANSWERED_MAX
            && let Some(oldest) = self.answered_order.pop_front()
        {
            self.answered.remove(&oldest);
        }
    }
}

fn check_whole(change: &Change) -> Result<(), Refusal> {
    if change.edits.is_empty() || change.edits.len() > EDITS_MAX {
        return Err(Refusal::Edits(change.edits.len()));
    }
    let mut seen = std::collections::BTreeSet::new();
    for edit in &change.edits {
        let kinds = [&edit.before, &edit.after].into_iter().flatten();
        if !seen.insert(&edit.id) || kinds.into_iter().any(|record| record.kind() != edit.id.kind) {
            return Err(Refusal::Malformed(edit.id.to_string()));
        }
    }
    let too_long = [&change.label, &change.author].into_iter().any(|text| text.chars().count() > rules::NAME_MAX_CHARS);
    if too_long { Err(Refusal::TooLong("The label".into(), rules::NAME_MAX_CHARS)) } else { Ok(()) }
}
