//! Taking back one's own: examples to read, and properties of many random histories.

use super::UndoLog;
use crate::{AnyKnowledge, Behaviour, Change, Committed, Decision, Id, Kind, Note, Record, RecordId, Refusal, Room};
use proptest::prelude::*;

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

fn note(name: &str) -> RecordId {
    RecordId::new(Kind::Note, &id(name))
}

fn text(record: Option<&Record>) -> &str {
    if let Some(Record::Note(note)) = record { &note.text } else { "" }
}

/// A room and its log.
struct Desk {
    room: Room,
    log: Vec<Committed>,
    ops: usize,
}

impl Desk {
    fn new() -> Self {
        Self { room: Room::open(Behaviour::default(), 0), log: Vec::new(), ops: 0 }
    }

    fn op(&mut self) -> Id {
        self.ops += 1;
        id(&format!("op{}", self.ops))
    }

    fn save(&mut self, change: Change) {
        match self.room.propose(0, change, &AnyKnowledge) {
            Decision::Save(committed) => {
                self.room.commit(&committed);
                self.log.push(committed);
            }
            Decision::Refuse(Refusal::Edits(0)) => {}
            other => panic!("{other:?}"),
        }
    }

    /// Somebody writes a text, which nobody wrote before, into some notes; an empty one takes them away.
    fn writes(&mut self, who: &str, notes: &[&str], what: &str) {
        let op = self.op();
        let after = (!what.is_empty()).then(|| Record::Note(Note::new(format!("{who}: {what}"))));
        let start = Change { by: Some(id(who)), ..Change::of(op, who, format!("Write {what}")) };
        let change = notes.iter().fold(start, |made, name| match &after {
            Some(after) => made.put(self.room.behaviour(), note(name), after.clone()),
            None => made.take(self.room.behaviour(), note(name)),
        });
        self.save(change);
    }

    fn undoes(&mut self, who: &str) -> Result<Change, Refusal> {
        let op = self.op();
        let change = UndoLog::of(&self.log).undo(&id(who), op, &self.room)?;
        self.save(change.clone());
        Ok(change)
    }

    fn redoes(&mut self, who: &str) -> Result<Change, Refusal> {
        let op = self.op();
        let change = UndoLog::of(&self.log).redo(&id(who), op, &self.room)?;
        self.save(change.clone());
        Ok(change)
    }

    fn says(&self, name: &str) -> &str {
        text(self.room.behaviour().records.get(&note(name)))
    }
}

#[test]
fn each_takes_back_only_their_own() {
    let mut desk = Desk::new();
    desk.writes("Aiko", &["a", "b"], "one");
    desk.writes("Ben", &["c"], "two");
    assert_eq!(desk.undoes("Aiko").unwrap().label, "Undo: Write one");
    assert_eq!((desk.says("a"), desk.says("b"), desk.says("c")), ("", "", "Ben: two"), "a gesture as a whole");
    assert_eq!(desk.undoes("Aiko"), Err(Refusal::NothingToUndo));
    assert_eq!(desk.redoes("Aiko").unwrap().label, "Redo: Write one");
    assert_eq!(desk.redoes("Aiko"), Err(Refusal::NothingToUndo));
    assert_eq!(desk.undoes("Aiko").unwrap().label, "Undo: Write one");
}

#[test]
fn what_somebody_changed_since_is_refused_with_their_name() {
    let mut desk = Desk::new();
    desk.writes("Aiko", &["a", "b"], "one");
    desk.writes("Ben", &["b"], "two");
    let no = desk.undoes("Aiko").unwrap_err();
    assert!(no.to_string().starts_with("Ben changed this note since then"), "{no}");
    desk.undoes("Ben").unwrap();
    assert_eq!(desk.says("b"), "Aiko: one");
    desk.undoes("Aiko").unwrap();
    assert!(desk.room.behaviour().records.is_empty());
}

/// Aiko wrote one, Ben two, and then one again.
fn aikos_value_written_by_ben() -> Desk {
    let mut desk = Desk::new();
    desk.writes("Aiko", &["a"], "one");
    let aikos = desk.room.behaviour().records[&note("a")].clone();
    desk.writes("Ben", &["a"], "two");
    let op = desk.op();
    let back = Change { by: Some(id("Ben")), ..Change::of(op, "Ben", "Write") };
    desk.save(back.put(desk.room.behaviour(), note("a"), aikos));
    desk
}

#[test]
fn a_value_that_somebody_wrote_anew_is_theirs() {
    let mut desk = aikos_value_written_by_ben();
    assert!(matches!(desk.undoes("Aiko"), Err(Refusal::ChangedSince { by, .. }) if by == "Ben"));
}

#[test]
fn a_change_that_only_says_it_takes_one_back_is_a_change() {
    let mut desk = Desk::new();
    desk.writes("Aiko", &["a"], "one");
    let theirs = desk.log[0].change.op.clone();
    let op = desk.op();
    let forged = Change { by: Some(id("Ben")), undoes: Some(theirs), ..Change::of(op, "Ben", "Write") };
    desk.save(forged.take(desk.room.behaviour(), note("a")));
    assert!(matches!(desk.undoes("Aiko"), Err(Refusal::ChangedSince { by, .. }) if by == "Ben"));
    desk.undoes("Ben").unwrap();
    assert_eq!(desk.says("a"), "Aiko: one");
}

#[test]
fn taking_back_by_hand_what_is_another_s_now_is_a_change_of_its_own() {
    let mut desk = aikos_value_written_by_ben();
    let op = desk.op();
    let by_hand = desk.log[0].change.swapped(op, "Undo");
    desk.save(by_hand);
    assert!(matches!(desk.undoes("Ben"), Err(Refusal::ChangedSince { by, .. }) if by == "Aiko"));
    assert_eq!(desk.undoes("Aiko").unwrap().label, "Undo: Undo");
    assert_eq!(desk.says("a"), "Aiko: one");
}

#[test]
fn something_new_ends_what_can_be_done_again() {
    let mut desk = Desk::new();
    desk.writes("Aiko", &["a"], "one");
    desk.undoes("Aiko").unwrap();
    desk.writes("Aiko", &["b"], "two");
    assert_eq!(desk.redoes("Aiko"), Err(Refusal::NothingToUndo));
}

const PEOPLE: [&str; 3] = ["Aiko", "Ben", "Yuki"];

/// One of three people writes, takes away, takes back or does again.
fn act(desk: &mut Desk, (who, what, one, other): (usize, u8, usize, usize)) {
    let (who, names) = (PEOPLE[who], ["a", "b", "c", "d"]);
    let before = desk.room.behaviour().clone();
    match what {
        0..=2 => desk.writes(who, &[names[one], names[other]], &format!("{}", desk.ops)),
        3 => desk.writes(who, &[names[one]], ""),
        4 | 5 => {
            let Ok(undone) = desk.undoes(who) else { return };
            for edit in &undone.edits {
                let value = text(before.records.get(&edit.id));
                assert!(value.is_empty() || value.starts_with(who), "{who} took back {value}");
            }
        }
        _ => drop(desk.redoes(who)),
    }
}

/// Returns the person who did the newest thing that can be taken back.
fn newest(desk: &Desk) -> Option<&'static str> {
    let log = UndoLog::of(&desk.log);
    let revision = |op: &Id| desk.log.iter().position(|committed| committed.change.op == *op);
    let last = |who: &&str| log.last(&id(who)).map(|change| &change.op);
    PEOPLE.into_iter().filter(|who| last(who).is_some()).max_by_key(|who| last(who).and_then(revision))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn undoing_everything_leaves_nothing(acts in prop::collection::vec((0..3usize, 0..7u8, 0..4usize, 0..4usize), 0..40)) {
        let mut desk = Desk::new();
        acts.into_iter().for_each(|one| act(&mut desk, one));
        while let Some(who) = newest(&desk) {
            prop_assert!(desk.undoes(who).is_ok());
        }
        prop_assert!(desk.room.behaviour().records.is_empty());
    }
}
