//! A whole store into Neo4j and back: the templates of the house with their helpers, a bin, and longer histories.

use crate::samples::{id, now, save};
use crate::shared;
use behaviour::{Committed, Id, Kind, Place, Record, RecordId};
use std::io::Cursor;
use std::sync::{Arc, Mutex};
use store::backup::{self, backup, compare, migrate, restore};
use store::files::{ImportMode, import, read};
use store::{Filling, FillingSource, LIBRARY, MemoryStore, Store};

/// Every template, imported into a store in memory; one is changed some times, one goes to the bin.
async fn filled() -> Arc<dyn Store> {
    let store = MemoryStore::new();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/behaviours");
    let mut number = 0;
    let mut new_id = || {
        number += 1;
        id(&format!("id{number}"))
    };
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).expect("templates").map(|entry| entry.expect("a file").path()).collect();
    paths.sort();
    let mut last = id("none");
    for path in paths {
        let file = read(&std::fs::read(path).expect("a file")).expect("a template");
        let library = now(&store, LIBRARY).await;
        let made = import(&file, ImportMode::Copy, &library, "Aiko", &mut new_id).expect("an import");
        if let Some(change) = made.library {
            put(&store, &id(LIBRARY), change).await;
        }
        for change in made.changes {
            put(&store, &made.behaviour, change).await;
        }
        last = made.behaviour;
    }
    for step in 0..40 {
        let place = Record::Place(Place { x: f64::from(step) / 7.0, y: -0.0 });
        save(&store, last.as_str(), &format!("step{step}"), vec![(RecordId::new(Kind::Place, &id("moved")), place)])
            .await;
    }
    let listed = store.list(&store::Query::default()).await.expect("a list").lines;
    assert!(listed.len() >= 8 && store.remove(&listed[1].id, 5, "Ben").await.expect("an answer"));
    Arc::new(store)
}

async fn put(store: &MemoryStore, to: &Id, change: behaviour::Change) {
    let mut after = now(store, to.as_str()).await;
    let revision = store.load(to).await.expect("an answer").map_or(0, |loaded| loaded.revision) + 1;
    after.apply(&change);
    store.append(to, &Committed { revision, change }, &after).await.expect("saved");
}

#[tokio::test(flavor = "multi_thread")]
async fn everything_moves_into_neo4j_and_back() {
    let Some(neo4j) = shared::alone("moving a store into Neo4j and back").await else { return };
    let (from, to) = (filled().await, Arc::new(neo4j.empty_store().await) as Arc<dyn Store>);
    let source = FillingSource { key: "memory".to_owned(), again: "rrp migrate".to_owned() };
    for _ in 0..2 {
        let (done, differences) = migrate(&from, &to, &source, &|_, _| {}).await.expect("copied");
        assert_eq!((done.behaviours >= 9, differences), (true, vec![]));
    }
    let lines = Mutex::new(Vec::new());
    let put = |line: String| {
        lines.lock().expect("nobody panicked").extend(line.into_bytes());
        std::future::ready(Ok(()))
    };
    backup(&*to, 1, &[], put, &|_, _| {}).await.expect("a backup");
    let back: Arc<dyn Store> = Arc::new(MemoryStore::new());
    let file = Cursor::new(lines.into_inner().expect("nobody panicked"));
    let whole = backup::read(file, &*back).await.expect("a whole backup");
    let filling = Filling::begin(&back, &whole.source("rrp restore")).await.expect("begun");
    restore(whole, &filling, &|_, _| {}).await.expect("restored");
    assert_eq!(compare(&*from, &*back).await.expect("an answer"), []);
}
