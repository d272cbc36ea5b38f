//! The room of one open behaviour: the only writer, and pure. It decides; the server saves and tells.
//!
//! A change goes through in two steps, because nobody may see an edit that can still vanish: [`Room::propose`] decides
//! and changes nothing; once the store has the change, [`Room::commit`] makes it the room's truth.

use crate::labels::LABEL_MAX_BYTES;
use crate::size::Size;
use crate::{
    Behaviour, Change, EDITS_MAX, Id, Knowledge, Locks, Lookup, LookupSet, Presented, Record, RecordId, Refusal, rules,
    without_unseen,
};
use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The number of answered changes that a room remembers, to answer one sent twice; the store remembers all.
const ANSWERED_MAX: usize = 1_024;

/// A behaviour, its revision and what was answered lately.
#[derive(Clone, Debug)]
pub struct Room {
    behaviour: Behaviour,
    revision: u64,
    /// The size of the behaviour, kept so that a change costs what it touches.
    size: Size,
    answered: Lookup<Id, ChangeAnswer>,
    answered_order: VecDeque<Id>,
}

/// The final answer to a change.
#[derive(Clone, Debug)]
enum ChangeAnswer {
    /// It is this revision.
    Made(u64),
    Refused(Refusal),
}

/// The decision of a room about a proposed change.
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
        Self { behaviour, revision, size, answered: Lookup::new(), answered_order: VecDeque::new() }
    }

    /// Checks that changes which make a behaviour from nothing, one after the other, keep the rules.
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

    /// Returns the size of all records in bytes: at most 8 MiB unless an older version made it, and never less than
    /// they take in a message or file.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.size.bytes()
    }

    /// Returns the revision: the number of changes ever made.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Decides about a change that arrived at `now_ms` (since 1970). Its texts lose their control characters. Checks in order: sent twice, whole, every
    /// touched record as its sender saw it, the rules. Locks are asked by [`Self::propose_by`].
    #[must_use]
    pub fn propose(&self, now_ms: u64, change: Change, knowledge: &dyn Knowledge) -> Decision {
        if let Some(decision) = self.answer(&change.op) {
            return decision;
        }
        let change = change.cleaned();
        match self.judge(&change, knowledge) {
            Ok(()) => {
                let (label, author) = (change.label.map(&without_unseen), without_unseen(&change.author));
                let change = Change { at_ms: now_ms, label, author, ..change };
                Decision::Save(Committed { revision: self.revision + 1, change })
            }
            Err(refusal) => Decision::Refuse(refusal),
        }
    }

    /// Decides about a change that somebody sent. Checks in order: sent twice, nothing touched that others are editing,
    /// then all that [`Self::propose`] does. If it is to be saved, the caller says so to the locks in the same step
    /// ([`Locks::begin_saving`]), before anybody else can take one.
    #[must_use]
    pub fn propose_by(
        &self,
        now_ms: u64,
        change: Change,
        presented: &Presented,
        locks: &Locks,
        knowledge: &dyn Knowledge,
    ) -> Decision {
        match self.check_locks(&change, presented, locks) {
            Ok(()) => self.propose(now_ms, change, knowledge),
            Err(refusal) => Decision::Refuse(refusal),
        }
    }

    /// Checks that the locks let a change in. One that was answered before passes, to be answered so again. Cheap, so
    /// that it can be asked where locks are given, and the rest decided elsewhere.
    ///
    /// # Errors
    /// Refuses with the locked record and the name of the person who holds it.
    pub fn check_locks(&self, change: &Change, presented: &Presented, locks: &Locks) -> Result<(), Refusal> {
        if self.answered.contains_key(&change.op) {
            return Ok(());
        }
        locks.check(change, presented).map_err(|(record, holder)| {
            let seen = change.edits.iter().find(|edit| edit.id == *record).and_then(|edit| edit.before.as_ref());
            Refusal::Locked { what: self.call(record, seen), by: holder.name.clone() }
        })
    }

    /// Returns the name that a person uses for a record: “Distance”, this filter, the name or settings.
    #[must_use]
    pub fn name_of(&self, id: &RecordId) -> Phrase {
        self.call(id, None)
    }

    /// Returns the decision about the change named `op`, if it was answered lately.
    #[must_use]
    pub fn answer(&self, op: &Id) -> Option<Decision> {
        self.answered.get(op).map(|answer| match answer {
            ChangeAnswer::Made(revision) => Decision::Duplicate(*revision),
            ChangeAnswer::Refused(refusal) => Decision::Refuse(refusal.clone()),
        })
    }

    pub(crate) fn judge(&self, change: &Change, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
        check_whole(change)?;
        for edit in &change.edits {
            let current = self.behaviour.records.get(&edit.id);
            if current != edit.before.as_ref() {
                return Err(Refusal::Stale(self.call(&edit.id, edit.before.as_ref())));
            }
        }
        if change.edits.iter().any(|edit| edit.id == RecordId::settings() && edit.after.is_none()) {
            return Err(Refusal::Malformed(phrase!("malformed.settings", "the settings cannot be removed")));
        }
        let mut after = self.behaviour.clone();
        after.apply(change);
        rules::check(&after, change, &self.size, knowledge)
    }

    /// Returns the name that a person uses for a record, as it is now or as they saw it.
    pub(crate) fn call(&self, id: &RecordId, seen: Option<&Record>) -> Phrase {
        let record = self.behaviour.records.get(id).or(seen);
        match record {
            Some(Record::Stream(stream)) => phrase!("called.Stream", "“{name}”", name = stream.name),
            Some(Record::Helper(helper)) => phrase!("called.Helper", "the helper “{name}”", name = helper.name),
            Some(Record::Connector(connector)) => {
                phrase!("this.connector_of", "this {of}", of = connector.operation.spec())
            }
            Some(record) => record.kind().this(),
            None => phrase!("this.thing", "this"),
        }
    }

    /// Makes a saved change the truth. The caller saved it first; revisions come in order.
    pub fn commit(&mut self, saved: &Committed) {
        debug_assert_eq!(saved.revision, self.revision + 1, "revisions come in order");
        self.behaviour.apply(&saved.change);
        self.size = self.size.after(&saved.change);
        self.revision = saved.revision;
        self.remember(saved.change.op.clone(), ChangeAnswer::Made(saved.revision));
    }

    /// A change that was refused stays refused: a copy of it that arrives late is answered alike, as its sender already
    /// goes by the first answer. Not for a refusal after which the same change is sent again.
    pub fn refused(&mut self, op: &Id, refusal: &Refusal) {
        if !self.answered.contains_key(op) {
            self.remember(op.clone(), ChangeAnswer::Refused(refusal.clone()));
        }
    }

    fn remember(&mut self, op: Id, answer: ChangeAnswer) {
        if self.answered.insert(op.clone(), answer).is_none() {
            self.answered_order.push_back(op);
        }
        if self.answered_order.len() > ANSWERED_MAX
            && let Some(oldest) = self.answered_order.pop_front()
        {
            self.answered.remove(&oldest);
        }
    }
}

pub(crate) fn check_whole(change: &Change) -> Result<(), Refusal> {
    if change.edits.is_empty() || change.edits.len() > EDITS_MAX {
        return Err(Refusal::Edits(change.edits.len()));
    }
    let mut seen = LookupSet::new();
    for edit in &change.edits {
        let kinds = [&edit.before, &edit.after].into_iter().flatten();
        if !seen.insert(&edit.id) || kinds.into_iter().any(|record| record.kind() != edit.id.kind) {
            return Err(Refusal::Malformed(edit.id.phrase()));
        }
    }
    let too_long = change.author.chars().count() > rules::NAME_MAX_CHARS || change.label.bytes() > LABEL_MAX_BYTES;
    if too_long { Err(Refusal::TooLong(phrase!("limited.label", "the label"), rules::NAME_MAX_CHARS)) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::{Decision, Room};
    use crate::{
        AnyKnowledge, Behaviour, Change, Connector, Holder, Id, Kind, Locks, Params, Presented, Procedure, Record,
        RecordId, Refusal, Stream, StreamKind, connectors,
    };
    use std::collections::BTreeSet;

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn key(kind: Kind, name: &str) -> RecordId {
        RecordId::new(kind, &id(name))
    }

    fn stream(name: &str) -> Record {
        let (kind, name, params) = (StreamKind::Ordinary, name.to_owned(), Params::new());
        let (device, resources, priority, hold_ms) = (None, None, None, None);
        Record::Stream(Stream { kind, name, device, params, order: 0, resources, priority, hold_ms })
    }

    /// Distance and Close with a map between them.
    fn room() -> Room {
        let operation = connectors::map::SPEC.with(Procedure::body("1"));
        let map = Connector { operation, inputs: vec![id("d")], output: id("c"), order: 0 };
        let mut start = Behaviour::default();
        start.records.insert(key(Kind::Stream, "d"), stream("Distance"));
        start.records.insert(key(Kind::Stream, "c"), stream("Close"));
        start.records.insert(key(Kind::Connector, "m"), Record::Connector(map));
        Room::open(start, 0)
    }

    #[test]
    fn what_is_pasted_into_a_text_loses_its_control_characters_before_it_is_saved() {
        let room = room();
        let body = connectors::map::SPEC.with(Procedure::body("\"a\u{b}b\""));
        let map = Connector { operation: body, inputs: vec![id("d")], output: id("c"), order: 0 };
        let note = Record::Note(crate::Note::new("First\u{b}then\u{7}".into()));
        let change = Change::of(id("op"), "Aiko", "Paste").put(&room.behaviour, key(Kind::Note, "n"), note);
        let change = change.put(&room.behaviour, key(Kind::Connector, "m"), Record::Connector(map));
        let Decision::Save(saved) = room.propose(0, change, &AnyKnowledge) else { panic!("it is saved") };
        let told = |edit: &crate::Edit| match &edit.after {
            Some(Record::Note(note)) => note.text.clone(),
            Some(Record::Connector(map)) => format!("{:?}", map.operation.procedure()),
            other => panic!("{other:?}"),
        };
        let told: Vec<_> = saved.change.edits.iter().map(told).collect();
        assert_eq!(told[0], "First\nthen");
        assert!(told[1].contains("a b") && !told[1].contains("\\u{b}"), "{}", told[1]);
    }

    fn yukis(records: &[RecordId]) -> (Locks, Presented) {
        let mut locks = Locks::new(1);
        let yuki = Holder { session: 3, client: id("y"), name: "Yuki".into() };
        let grant = locks.take(0, yuki, records.iter().cloned().collect::<BTreeSet<_>>()).unwrap();
        (locks, Presented { client: Some(id("y")), tokens: vec![grant.token] })
    }

    fn refused(room: &Room, change: &Change, presented: &Presented, locks: &Locks) -> Option<String> {
        match room.propose_by(0, change.clone(), presented, locks, &AnyKnowledge) {
            Decision::Refuse(refusal) => Some(refusal.to_string()),
            Decision::Save(_) | Decision::Duplicate(_) => None,
        }
    }

    #[test]
    fn what_somebody_is_editing_is_refused_with_their_name() {
        let room = room();
        let (locks, hers) = yukis(&[key(Kind::Stream, "d"), key(Kind::Connector, "m")]);
        let (others, start) = (Presented::default(), Change::of(id("op"), "Ben", "Edit"));
        let rename = start.clone().put(room.behaviour(), key(Kind::Stream, "d"), stream("Far"));
        let words = "Yuki is editing “Distance”. Ask, or wait until it is free.";
        assert_eq!(refused(&room, &rename, &others, &locks).as_deref(), Some(words));
        assert_eq!(refused(&room, &rename, &hers, &locks), None);
        let remove = start.take(room.behaviour(), key(Kind::Connector, "m"));
        let words = "Yuki is editing this map. Ask, or wait until it is free.";
        assert_eq!(refused(&room, &remove, &others, &locks).as_deref(), Some(words));
    }

    #[test]
    fn a_stream_goes_only_with_its_connectors_so_a_locked_one_keeps_it() {
        let room = room();
        let (locks, _) = yukis(&[key(Kind::Connector, "m")]);
        let start = Change::of(id("op"), "Ben", "Remove");
        let alone = start.take(room.behaviour(), key(Kind::Stream, "d"));
        assert!(refused(&room, &alone, &Presented::default(), &locks).is_some_and(|words| words.contains("an end")));
        let both = alone.take(room.behaviour(), key(Kind::Connector, "m"));
        assert!(refused(&room, &both, &Presented::default(), &locks).is_some_and(|words| words.starts_with("Yuki")));
    }

    #[test]
    fn a_change_is_answered_alike_whoever_locked_what_it_touched_since() {
        let mut room = room();
        let made = Change::of(id("one"), "Ben", "Rename").put(room.behaviour(), key(Kind::Stream, "d"), stream("Far"));
        let (locks, nobody) = (Locks::new(1), Presented::default());
        let Decision::Save(made) = room.propose_by(0, made, &nobody, &locks, &AnyKnowledge) else {
            panic!("it is free")
        };
        let lost = Change::of(id("two"), "Ben", "Rename").put(room.behaviour(), key(Kind::Stream, "c"), stream("Near"));
        room.commit(&made);
        let (locks, _) = yukis(&[key(Kind::Stream, "d"), key(Kind::Stream, "c")]);
        let again = room.propose_by(0, made.change, &nobody, &locks, &AnyKnowledge);
        assert_eq!(again, Decision::Duplicate(1));
        let Decision::Refuse(no) = room.propose_by(0, lost.clone(), &nobody, &locks, &AnyKnowledge) else { panic!() };
        room.refused(&lost.op, &no);
        let late = room.propose_by(0, lost, &nobody, &Locks::new(2), &AnyKnowledge);
        assert!(matches!(&late, Decision::Refuse(Refusal::Locked { by, .. }) if by == "Yuki"), "{late:?}");
    }
}
