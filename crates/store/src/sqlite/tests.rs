//! The contract on both stores, and what only the embedded store promises.

use super::write::{self, PreparedChange};
use super::writer::SqliteWriter;
use super::{SqliteStore, connect, open, read};
use crate::{Append, MemoryStore, Query, Store, StoreError, contract, json};
use behaviour::{Behaviour, Change, Checkpoint, Committed, Id, Kind, Note, Record, RecordId};
use rusqlite::Connection;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

fn committed(revision: u64, text: &str) -> Committed {
    let change = Change::of(id(&format!("op{revision}")), "Aiko", "Note");
    let note = Record::Note(Note::new(text.to_owned()));
    let key = RecordId::new(Kind::Note, &id(&format!("n{revision}")));
    Committed { revision, change: change.put(&Default::default(), key, note) }
}

fn writing(store: &SqliteStore) -> &SqliteWriter {
    store.writer().expect("it can write")
}

async fn put(store: &dyn Store, made: &Committed) -> Result<Append, StoreError> {
    let loaded = store.load(&id("b")).await.expect("an answer");
    let mut after = loaded.map(|loaded| loaded.behaviour).unwrap_or_default();
    after.apply(&made.change);
    store.append(&id("b"), made, &after).await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_store_in_memory_keeps_the_contract() {
    contract::check(async || Arc::new(MemoryStore::new()) as Arc<dyn Store>, contract::RUNS).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_embedded_store_keeps_the_contract() {
    let used = Mutex::new(Vec::new());
    let make = || async {
        let dir = tempfile::tempdir().expect("a directory");
        let store = open(dir.path()).await.expect("a store");
        used.lock().expect("no panic").push(dir);
        Arc::new(store) as Arc<dyn Store>
    };
    contract::check(make, contract::RUNS).await;
}

#[tokio::test]
async fn clones_in_memory_share_what_they_keep() {
    let store = MemoryStore::new();
    let other = store.clone();
    assert_eq!(put(&store, &committed(1, "one")).await, Ok(Append::Applied));
    assert_eq!(put(&other, &committed(2, "two")).await, Ok(Append::Applied));
    assert_eq!(store.load(&id("b")).await, other.load(&id("b")).await);
}

#[tokio::test]
async fn a_second_server_is_refused_until_the_first_has_gone() {
    let dir = tempfile::tempdir().expect("a directory");
    let first = open(dir.path()).await.expect("a store");
    let second = open(dir.path()).await.err().expect("a refusal");
    assert_eq!(second, StoreError::Busy(dir.path().to_owned()));
    assert!(second.to_string().starts_with("Another rrp server already uses /"), "{second}");
    assert_eq!(first.healthy().await, Ok(()));
    drop(first);
    open(dir.path()).await.expect("the directory is free again");
}

#[tokio::test]
async fn everything_is_there_after_opening_again() {
    let dir = tempfile::tempdir().expect("a directory");
    let deep = dir.path().join("made/on/demand");
    let mut before = None;
    for start in 1..=3 {
        let store = open(&deep).await.expect("a store");
        assert_eq!(store.next_epoch().await, Ok(start), "the epoch grows over every start");
        assert_eq!(store.load(&id("b")).await.expect("an answer"), before);
        assert_eq!(put(&store, &committed(start, "kept")).await, Ok(Append::Applied));
        before = store.load(&id("b")).await.expect("an answer");
    }
    assert_eq!(before.expect("a behaviour").revision, 3);
}

#[tokio::test]
async fn purging_leaves_no_row_behind() {
    let dir = tempfile::tempdir().expect("a directory");
    let store = open(dir.path()).await.expect("a store");
    put(&store, &committed(1, "one")).await.expect("an answer");
    let named = Checkpoint { revision: 1, name: "First".to_owned(), by: "Aiko".to_owned(), at_ms: 1 };
    assert_eq!(store.keep_checkpoint(&id("b"), &named).await, Ok(true));
    store.remove(&id("b"), 1, "Ben").await.expect("an answer");
    assert_eq!(store.purge(2).await, Ok(1));
    for table in ["behaviour", "record", "op", "used", "searched", "search", "device", "checkpoint"] {
        let count = format!("SELECT count(*) FROM {table}");
        let rows: i64 =
            Connection::open(&store.file).expect("open").query_row(&count, [], |row| row.get(0)).expect("a number");
        assert_eq!(rows, 0, "{table}");
    }
}

#[tokio::test]
async fn a_newer_schema_is_refused_and_left_alone() {
    let dir = tempfile::tempdir().expect("a directory");
    drop(open(dir.path()).await.expect("a store"));
    let file = connect::database(dir.path());
    Connection::open(&file).expect("open").execute("UPDATE meta SET schema_version = 99", []).expect("an update");
    let refusal = open(dir.path()).await.err().expect("a refusal");
    assert_eq!(refusal, StoreError::Newer { found: 99, known: 5 });
}

/// Opens a directory whose database was damaged; says the error of opening, or of reading everything.
async fn error_in(dir: &Path) -> Option<StoreError> {
    let store = match open(dir).await {
        Ok(store) => store,
        Err(error) => return Some(error),
    };
    let loaded = store.load(&id("b")).await.err();
    loaded.or(store.history(&id("b"), 0, 1_000).await.err())
}

async fn filled() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a directory");
    let store = open(dir.path()).await.expect("a store");
    for revision in 1..=40 {
        put(&store, &committed(revision, &"text ".repeat(500))).await.expect("an answer");
    }
    dir
}

#[tokio::test]
async fn a_damaged_file_is_an_error_with_its_path() {
    for (cut, fill) in [(0, 4_096), (4_096, 8_192), (20_000, 60_000), (0, 200_000)] {
        let dir = filled().await;
        let file = connect::database(dir.path());
        let mut bytes = std::fs::read(&file).expect("the file");
        assert!(bytes.len() > fill, "{} bytes", bytes.len());
        bytes[cut..fill].fill(0xA5);
        std::fs::write(&file, bytes).expect("to damage it");
        let error = open(dir.path()).await.err().expect("damage is noticed before anything is written to it");
        assert!(
            matches!(&error, StoreError::Damaged(damage) if damage.to_string().contains("rrp.sqlite")),
            "{error:?}"
        );
    }
}

#[tokio::test]
async fn a_file_cut_off_or_of_another_kind_is_an_error() {
    for length in [1, 100, 5_000, 40_000] {
        let dir = filled().await;
        let file = connect::database(dir.path());
        std::fs::File::options().write(true).open(&file).expect("open").set_len(length).expect("to cut it off");
        let error = error_in(dir.path()).await;
        assert!(matches!(&error, Some(StoreError::Damaged(_))), "{length}: {error:?}");
    }
    let dir = filled().await;
    std::fs::write(connect::database(dir.path()).with_extension("sqlite-wal"), "log").expect("a log");
    std::fs::write(connect::database(dir.path()), "").expect("an empty file");
    assert!(matches!(error_in(dir.path()).await, Some(StoreError::Damaged(_))));
}

#[tokio::test]
async fn a_record_that_cannot_be_read_is_damage() {
    let dir = filled().await;
    let at = Connection::open(connect::database(dir.path())).expect("open");
    at.execute("UPDATE record SET json = '{' WHERE id = 'note/n7'", []).expect("an update");
    drop(at);
    let error = error_in(dir.path()).await.expect("damage is noticed");
    assert!(matches!(&error, StoreError::Damaged(_)), "{error:?}");
}

#[tokio::test]
async fn on_a_full_disk_everything_can_still_be_read() {
    let dir = filled().await;
    let store = open(dir.path()).await.expect("a store");
    // SQLite never goes below the pages it has, so this leaves no room at all.
    let limit = |pages: i64| {
        move |at: &Connection| Ok(at.query_row(&format!("PRAGMA max_page_count = {pages}"), [], |_| Ok(()))?)
    };
    writing(&store).ask(limit(1)).await.expect("a limit");
    let before = store.load(&id("b")).await.expect("an answer");
    let large = committed(41, &"large ".repeat(50_000));
    assert_eq!(put(&store, &large).await, Err(StoreError::Full));
    assert_eq!(store.load(&id("b")).await.expect("an answer"), before, "nothing is half saved");
    writing(&store).ask(limit(1_000_000)).await.expect("a limit");
    assert_eq!(put(&store, &large).await, Ok(Append::Applied), "it works again with room");
}

#[tokio::test]
async fn whatever_finds_no_room_makes_the_disk_full_until_there_is_more() {
    let dir = tempfile::tempdir().expect("a directory");
    let store = open(dir.path()).await.expect("a store");
    assert_eq!(store.wants_bytes.load(Ordering::Relaxed), 0);
    let refused: Result<(), _> = store.write(5, |_| Err(StoreError::Full.into())).await;
    assert_eq!(refused, Err(StoreError::Full));
    assert_eq!(store.wants_bytes.load(Ordering::Relaxed), super::ROOM_MIN_BYTES + 5 * super::ROOM_TIMES);
    assert_eq!(store.healthy().await, Ok(()), "there is room");
    assert_eq!(store.wants_bytes.load(Ordering::Relaxed), 0);
}

/// Holds the writer until everything else waits, so that the next transaction takes all of it.
#[tokio::test]
async fn one_job_that_fails_spoils_no_other_in_its_transaction() {
    let dir = tempfile::tempdir().expect("a directory");
    let store = open(dir.path()).await.expect("a store");
    let (started, has_started) = tokio::sync::oneshot::channel();
    let (go, gate) = std::sync::mpsc::channel();
    let hold = writing(&store).ask(move |_| {
        started.send(()).expect("somebody waits");
        gate.recv().expect("the gate opens");
        Ok(())
    });
    let append = |name: &str, revision| {
        let ready = PreparedChange::new(committed(revision, "x"), Behaviour::default());
        let (name, ready) = (id(name), ready.expect("it can be kept"));
        writing(&store).ask(move |at| write::append(at, &name, &ready))
    };
    let spoilt = writing(&store).ask(|at| {
        at.execute("UPDATE meta SET epoch = 99", [])?;
        Ok(at.execute("INSERT INTO meta VALUES (2, 0, 0)", [])?)
    });
    let rest = async {
        has_started.await.expect("the writer is held");
        let open = async { go.send(()).expect("the writer waits") };
        tokio::join!(append("a", 1), spoilt, append("b", 2), append("a", 2), open)
    };
    let (_, (first, bad, stale, second, ())) = tokio::join!(hold, rest);
    assert_eq!((first, second), (Ok(Append::Applied), Ok(Append::Applied)));
    assert!(matches!(bad, Err(StoreError::Unavailable(_))), "{bad:?}");
    assert_eq!(stale, Ok(Append::Conflict { head: 0 }));
    assert_eq!(store.next_epoch().await, Ok(1), "the failed job left nothing");
    assert_eq!(store.load(&id("a")).await.expect("an answer").expect("a behaviour").revision, 2);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_reader_sees_one_moment_while_others_write() {
    let dir = filled().await;
    let store = open(dir.path()).await.expect("a store");
    let (started, has_started) = tokio::sync::oneshot::channel();
    let (go, gate) = std::sync::mpsc::channel();
    let read_twice = store.readers.ask(move |at| {
        let first = read::load(at, &id("b"))?;
        started.send(()).expect("somebody waits");
        gate.recv().expect("the gate opens");
        Ok((first, read::load(at, &id("b"))?))
    });
    let write_between = async {
        has_started.await.expect("the reader has started");
        assert_eq!(put(&store, &committed(41, "new")).await, Ok(Append::Applied));
        go.send(()).expect("the reader waits");
    };
    let (seen, ()) = tokio::join!(read_twice, write_between);
    let (first, second) = seen.expect("an answer");
    assert_eq!(first, second);
    assert_eq!(store.load(&id("b")).await.expect("an answer").expect("a behaviour").revision, 41);
}

/// A database as the first version wrote it, with one behaviour of Aiko's that Ben changed.
async fn of_the_first_version(dir: &Path) {
    let at = Connection::open(connect::database(dir)).expect("open");
    at.execute_batch(include_str!("../../../../migrations/sqlite/0001-start.sql")).expect("its tables");
    let change = Change::of(id("op1"), "Aiko", "Add").put(
        &Behaviour::default(),
        RecordId::settings(),
        Record::Settings(behaviour::Settings::named("Old one")),
    );
    let (made, record) = (json::encode(&change).expect("json"), json::encode(&change.edits[0].after).expect("json"));
    let note = json::encode(&committed(2, "near").change).expect("json");
    at.execute("UPDATE meta SET schema_version = 1", []).expect("its version");
    at.execute("INSERT INTO behaviour VALUES ('b', 'Old one', 2, 7, 'Ben', 0, NULL, NULL)", []).expect("a row");
    at.execute("INSERT INTO record VALUES ('b', 'settings/behaviour', 1, ?1)", [record]).expect("a row");
    let op = "INSERT INTO op VALUES ('b', ?1, ?2, ?3, 'Edit', 7, ?4)";
    at.execute(op, rusqlite::params![1, "op1", "Aiko", made]).expect("a row");
    at.execute(op, rusqlite::params![2, "op2", "Ben", note]).expect("a row");
}

#[tokio::test]
async fn what_an_older_version_wrote_is_brought_up_to_date() {
    let dir = tempfile::tempdir().expect("a directory");
    of_the_first_version(dir.path()).await;
    let store = open(dir.path()).await.expect("a store");
    let query = Query { words: "OLD".to_owned(), owner: Some("Aiko".to_owned()), ..Query::default() };
    let lines = store.list(&query).await.expect("a page").lines;
    assert_eq!(
        lines.iter().map(|line| (line.name.as_str(), line.by.as_str())).collect::<Vec<_>>(),
        [("Old one", "Ben")]
    );
    assert_eq!(put(&store, &committed(3, "more")).await, Ok(Append::Applied));
}
