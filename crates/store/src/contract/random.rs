//! Chance against a model: whatever is done in whatever order, the store and the model stay equal.

use super::samples::{Chance, filter, group, helper, id, in_bin, key, note, pad, settings, stream, two_streams};
use crate::{Append, Query, Store, StoreError};
use behaviour::{Behaviour, Change, Committed, Id, Kind, Place, Procedure, Record, RecordId};
use std::collections::BTreeMap;

/// The number of steps in one run.
const STEPS: u64 = 80;
const BEHAVIOURS: [&str; 4] = ["a", "b", "c", crate::LIBRARY];

#[derive(Default)]
struct StoreModel {
    shelves: BTreeMap<Id, RandomShelf>,
    ops: u64,
    seed: u64,
}

#[derive(Default)]
struct RandomShelf {
    behaviour: Behaviour,
    history: Vec<Committed>,
    removed_ms: Option<u64>,
}

pub(super) async fn check(store: &dyn Store, seed: u64) {
    let mut chance = Chance(seed);
    let mut model = StoreModel { seed, ..StoreModel::default() };
    for step in 0..STEPS {
        let name = id(BEHAVIOURS[chance.below(4) as usize]);
        match chance.below(20) {
            0 => model.remove(store, &name, step).await,
            1..=2 => model.restore(store, &name).await,
            3 => model.purge(store, step.saturating_sub(chance.below(20))).await,
            4..=5 => model.send_again(store, &name, &mut chance).await,
            6..=7 => model.send_stale(store, &name, &mut chance).await,
            _ => model.append(store, &name, step, &mut chance).await,
        }
        model.compare_one(store, &name).await;
    }
    model.compare_lists(store).await;
}

impl StoreModel {
    fn head(&self, name: &Id) -> u64 {
        self.shelves.get(name).map_or(0, |shelf| shelf.history.len() as u64)
    }

    fn after(&self, name: &Id, change: &Change) -> Behaviour {
        let mut after = self.shelves.get(name).map(|shelf| shelf.behaviour.clone()).unwrap_or_default();
        after.apply(change);
        after
    }

    fn change(&mut self, name: &Id, step: u64, chance: &mut Chance) -> Change {
        self.ops += 1;
        let now = self.shelves.get(name).map_or_else(Behaviour::default, |shelf| shelf.behaviour.clone());
        let start = Change { at_ms: step, ..Change::of(id(&format!("op{}", self.ops)), "Aiko", "Edit") };
        let first = self.head(name) == 0 && name.as_str() != crate::LIBRARY;
        let streams = if first { two_streams() } else { Vec::new() };
        let start = streams.into_iter().fold(start, |made, (key, record)| made.put(&now, key, record));
        (0..=chance.below(4)).fold(start, |made, _| {
            let (key, record) = any_edit(name, chance);
            if let Some(record) = record { made.put(&now, key, record) } else { made.take(&now, key) }
        })
    }

    async fn append(&mut self, store: &dyn Store, name: &Id, step: u64, chance: &mut Chance) {
        let made = Committed { revision: self.head(name) + 1, change: self.change(name, step, chance) };
        let answer = store.append(name, &made, &self.after(name, &made.change)).await;
        if self.shelves.get(name).is_some_and(|shelf| shelf.removed_ms.is_some()) {
            return assert_eq!(answer, Err(StoreError::Gone), "seed {}", self.seed);
        }
        assert_eq!(answer, Ok(Append::Applied), "seed {}", self.seed);
        let shelf = self.shelves.entry(name.clone()).or_default();
        shelf.behaviour.apply(&made.change);
        shelf.history.push(made);
    }

    async fn send_again(&self, store: &dyn Store, name: &Id, chance: &mut Chance) {
        let Some(shelf) = self.shelves.get(name) else { return };
        let old = &shelf.history[chance.below(shelf.history.len() as u64) as usize];
        let answer = store.append(name, old, &shelf.behaviour).await;
        assert_eq!(answer, Ok(Append::Duplicate { revision: old.revision }), "seed {}", self.seed);
    }

    async fn send_stale(&mut self, store: &dyn Store, name: &Id, chance: &mut Chance) {
        let head = self.head(name);
        let revision = chance.below(head + 3);
        let in_bin = self.shelves.get(name).is_some_and(|shelf| shelf.removed_ms.is_some());
        if in_bin || revision == head + 1 {
            return;
        }
        let made = Committed { revision, change: self.change(name, 0, chance) };
        let answer = store.append(name, &made, &self.after(name, &made.change)).await;
        assert_eq!(answer, Ok(Append::Conflict { head }), "seed {}", self.seed);
    }

    async fn remove(&mut self, store: &dyn Store, name: &Id, step: u64) {
        let shelf = self.shelves.get_mut(name).filter(|shelf| shelf.removed_ms.is_none());
        let shelf = shelf.filter(|_| name.as_str() != crate::LIBRARY);
        assert_eq!(store.remove(name, step, "Ben").await, Ok(shelf.is_some()), "seed {}", self.seed);
        if let Some(shelf) = shelf {
            shelf.removed_ms = Some(step);
        }
    }

    async fn restore(&mut self, store: &dyn Store, name: &Id) {
        let was = self.shelves.get_mut(name).is_some_and(|shelf| shelf.removed_ms.take().is_some());
        assert_eq!(store.restore(name).await, Ok(was), "seed {}", self.seed);
    }

    async fn purge(&mut self, store: &dyn Store, before: u64) {
        let many = self.shelves.len();
        self.shelves.retain(|_, shelf| shelf.removed_ms.is_none_or(|at| at >= before));
        let gone = u32::try_from(many - self.shelves.len()).expect("few");
        assert_eq!(store.purge(before).await, Ok(gone), "seed {}", self.seed);
    }

    async fn compare_one(&self, store: &dyn Store, name: &Id) {
        let loaded = store.load(name).await.expect("an answer");
        let history = store.history(name, 0, u32::MAX).await.expect("history");
        let mut replayed = Behaviour::default();
        history.iter().for_each(|made| replayed.apply(&made.change));
        let Some(shelf) = self.shelves.get(name) else {
            return assert!(loaded.is_none() && history.is_empty(), "seed {}", self.seed);
        };
        let loaded = loaded.expect("the model has it");
        assert_eq!(loaded.behaviour, shelf.behaviour, "seed {}", self.seed);
        assert_eq!(loaded.behaviour, replayed, "seed {}", self.seed);
        assert_eq!((loaded.revision, loaded.removed_ms), (self.head(name), shelf.removed_ms), "seed {}", self.seed);
        assert_eq!(history, shelf.history, "seed {}", self.seed);
    }

    async fn compare_lists(&self, store: &dyn Store) {
        let shown = |is_bin: bool| {
            let shelves = self.shelves.iter().filter(move |(_, shelf)| shelf.removed_ms.is_some() == is_bin);
            let shelves = shelves.filter(|(_, shelf)| shelf.behaviour.settings().is_some());
            shelves.map(|(name, s)| (name.clone(), s.behaviour.name().to_owned(), s.behaviour.streams().count()))
        };
        for (is_bin, query) in [(false, Query::default()), (true, in_bin())] {
            let listing = store.list(&query).await.expect("an answer");
            assert_eq!(listing.total, listing.lines.len() as u64, "seed {}", self.seed);
            let lines = listing.lines.into_iter();
            let mut lines: Vec<_> = lines.map(|line| (line.id, line.name, line.streams as usize)).collect();
            lines.sort();
            assert_eq!(lines, shown(is_bin).collect::<Vec<_>>(), "seed {}", self.seed);
        }
        let open = self.shelves.values().filter(|shelf| shelf.removed_ms.is_none());
        let used = open.flat_map(|shelf| shelf.behaviour.records.values()).filter(|record| **record == user()).count();
        assert_eq!(store.users("near").await.expect("uses").len(), used, "seed {}", self.seed);
    }
}

fn user() -> Record {
    filter(Procedure::body("near(x)"))
}

fn any_edit(name: &Id, chance: &mut Chance) -> (RecordId, Option<Record>) {
    let which = chance.below(6).to_string();
    let number = chance.below(1_000);
    let (key, record) = match (name.as_str() == crate::LIBRARY, chance.below(8)) {
        (true, _) => (key(Kind::Helper, &which), helper(&format!("h{number}"), "x + 1")),
        (false, 0) => (RecordId::settings(), settings(&format!("Name {number}"))),
        (false, 1..=2) => (key(Kind::Stream, &which), stream(&format!("S {which} {number}"), 0)),
        (false, 3) => (key(Kind::Connector, &which), if number < 500 { user() } else { filter(Procedure::body("x")) }),
        (false, 4) => (key(Kind::Place, &which), Record::Place(Place { x: number as f64 / 7.0, y: -0.0 })),
        (false, 5) => (key(Kind::Group, &which), group(&format!("G {number}"), &[&which])),
        (false, 6) => (RecordId::pad(), pad(&format!("P {number}"))),
        (false, _) => (key(Kind::Note, &which), note(&number.to_string())),
    };
    (key, (chance.below(3) > 0).then_some(record))
}
