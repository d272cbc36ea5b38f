//! The contract on a folder, and what only a folder promises.

use super::FolderStore;
use crate::{Append, Query, Store, StoreError, contract};
use behaviour::{Behaviour, Change, Committed, Id, Record, RecordId, Settings};
use std::path::Path;
use std::sync::{Arc, Mutex};

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

async fn put(store: &FolderStore, to: &str, revision: u64) -> Result<Append, StoreError> {
    let settings = Record::Settings(Settings::named(&format!("{to} {revision}")));
    let change = Change::of(id(&format!("op{revision}")), "Aiko", "Name");
    let change = change.put(&Behaviour::default(), RecordId::settings(), settings);
    let mut after = Behaviour::default();
    after.apply(&change);
    store.append(&id(to), &Committed { revision, change }, &after).await
}

async fn opened(dir: &Path) -> FolderStore {
    FolderStore::open(dir).await.expect("a store")
}

#[tokio::test(flavor = "multi_thread")]
async fn a_folder_keeps_the_contract() {
    let used = Mutex::new(Vec::new());
    let make = || async {
        let dir = tempfile::tempdir().expect("a directory");
        let store = opened(dir.path()).await;
        used.lock().expect("no panic").push(dir);
        Arc::new(store) as Arc<dyn Store>
    };
    contract::check(make, contract::RUNS).await;
}

#[tokio::test]
async fn everything_is_there_after_opening_again() {
    let dir = tempfile::tempdir().expect("a directory");
    for start in 1..=3 {
        let store = opened(dir.path()).await;
        assert_eq!(store.next_epoch().await, Ok(start));
        for name in ["b", "B", "Con"] {
            assert_eq!(put(&store, name, start).await, Ok(Append::Applied), "{name} {start}");
        }
        assert_eq!(store.remove(&id("Con"), start, "Ben").await, Ok(true));
        assert_eq!(store.restore(&id("Con")).await, Ok(true));
    }
    let store = opened(dir.path()).await;
    let query = Query { sort: crate::Sort::Name, ..Query::default() };
    let names: Vec<_> = store.list(&query).await.expect("a page").lines.into_iter().map(|line| line.name).collect();
    assert_eq!(names, ["B 3", "b 3", "Con 3"]);
    assert_eq!(store.history(&id("b"), 0, 9).await.expect("history").len(), 3);
    assert_eq!(FolderStore::open(dir.path()).await.err(), Some(StoreError::Busy(dir.path().to_owned())));
}

#[tokio::test]
async fn a_line_that_was_not_written_whole_goes_and_the_next_one_follows() {
    let dir = tempfile::tempdir().expect("a directory");
    put(&opened(dir.path()).await, "b", 1).await.expect("an answer");
    let file = dir.path().join("b-b.jsonl");
    let whole = std::fs::read(&file).expect("the file");
    for torn in ["{", "{\"change\":{\"revision\":2", "\u{fffd}"] {
        std::fs::write(&file, [whole.as_slice(), torn.as_bytes()].concat()).expect("to write");
        assert_eq!(opened(dir.path()).await.load(&id("b")).await.expect("an answer").expect("it").revision, 1);
        assert_eq!(std::fs::read(&file).expect("the file"), whole);
    }
    assert_eq!(put(&opened(dir.path()).await, "b", 2).await, Ok(Append::Applied));
    assert_eq!(opened(dir.path()).await.load(&id("b")).await.expect("an answer").expect("it").revision, 2);
}

#[tokio::test]
async fn a_damaged_line_is_an_error_with_its_file_and_number() {
    let dir = tempfile::tempdir().expect("a directory");
    let store = opened(dir.path()).await;
    for revision in 1..=3 {
        put(&store, "b", revision).await.expect("an answer");
    }
    drop(store);
    let file = dir.path().join("b-b.jsonl");
    let text = std::fs::read_to_string(&file).expect("the file");
    let lines: Vec<_> = text.lines().collect();
    for bad in [[lines[0], "{}", lines[2]].join("\n") + "\n", [lines[0], lines[2]].join("\n") + "\n"] {
        std::fs::write(&file, bad).expect("to write");
        let error = FolderStore::open(dir.path()).await.err().expect("damage is noticed");
        assert!(
            matches!(&error, StoreError::Damaged(damage) if damage.to_string().contains("b-b.jsonl line 2")),
            "{error:?}"
        );
    }
}
