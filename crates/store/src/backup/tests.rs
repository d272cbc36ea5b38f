//! Backups there and back, cut off, changed, and taken up again.

use super::{BackupError, Counted, backup, compare, migrate, restore};
use crate::{FolderStore, LIBRARY, MemoryStore, Store};
use behaviour::{Behaviour, Change, Committed, Helper, Id, Kind, Note, Record, RecordId, Settings};
use std::io::Cursor;
use std::sync::{Arc, Mutex};

const EPOCH: u64 = 5;

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

/// Makes the next change of a behaviour: a settings record or a helper at first, then notes.
async fn change(store: &dyn Store, to: &str) {
    let loaded = store.load(&id(to)).await.expect("an answer");
    let (mut now, head) = loaded.map_or_else(Default::default, |loaded| (loaded.behaviour, loaded.revision));
    let (key, record) = match (head, to) {
        (0, LIBRARY) => (RecordId::new(Kind::Helper, &id("h")), helper()),
        (0, name) => (RecordId::settings(), Record::Settings(Settings::named(name))),
        _ => (RecordId::new(Kind::Note, &id(&format!("n{head}"))), Record::Note(Note { text: format!("{head}\n") })),
    };
    let start = Change { at_ms: head, ..Change::of(id(&format!("{to}-{head}")), "Aiko", "Edit") };
    let change = start.put(&now, key, record);
    now.apply(&change);
    let made = Committed { revision: head + 1, change };
    assert_eq!(store.append(&id(to), &made, &now).await, Ok(crate::Append::Applied));
}

fn helper() -> Record {
    Record::Helper(Helper {
        name: "near".into(),
        params: vec!["x".into()],
        body: "x < 0.1".into(),
        says: String::new(),
    })
}

/// A library, behaviours with histories of different lengths, and one in the bin.
async fn filled() -> Arc<dyn Store> {
    let store: Arc<dyn Store> = Arc::new(MemoryStore::new());
    for (name, changes) in [(LIBRARY, 1), ("a", 1), ("b", 300), ("c", 2), ("d", 7)] {
        for _ in 0..changes {
            change(&*store, name).await;
        }
    }
    assert!(store.remove(&id("c"), 77, "Ben").await.expect("an answer"));
    store
}

async fn taken(store: &dyn Store) -> String {
    let text = Mutex::new(String::new());
    let put = |line: String| {
        text.lock().expect("nobody panicked").push_str(&line);
        std::future::ready(Ok(()))
    };
    let done = backup(store, EPOCH, put, &|_, _| {}).await.expect("a backup");
    assert_eq!(done, Counted { behaviours: 5, changes: 311 });
    text.into_inner().expect("nobody panicked")
}

async fn given(text: &str, to: &Arc<dyn Store>) -> Result<Counted, BackupError> {
    restore(Cursor::new(text.to_owned().into_bytes()), to, &|_, _| {}).await
}

#[tokio::test]
async fn a_restored_store_holds_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let from = filled().await;
    let text = taken(&*from).await;
    let files: Arc<dyn Store> = Arc::new(FolderStore::open(&folder.path().join("f")).await.expect("a store"));
    let sqlite: Arc<dyn Store> = Arc::new(crate::open(&folder.path().join("s")).await.expect("a store"));
    for to in [Arc::new(MemoryStore::new()), files, sqlite] {
        assert_eq!(given(&text, &to).await.expect("restored"), Counted { behaviours: 5, changes: 311 });
        assert_eq!(compare(&*from, &*to).await.expect("an answer"), []);
        assert_eq!(taken(&*to).await, text, "its backup is the same file");
        assert!(to.next_epoch().await.expect("an epoch") > EPOCH);
    }
}

#[tokio::test]
async fn what_is_no_whole_backup_is_refused_before_anything_is_changed() {
    let text = taken(&*filled().await).await;
    let lines: Vec<&str> = text.lines().collect();
    let without = |gone: usize| {
        let left: Vec<_> = lines.iter().enumerate().filter(|(at, _)| *at != gone).map(|(_, line)| *line).collect();
        left.join("\n") + "\n"
    };
    let mut broken = vec![
        String::new(),
        text[..text.len() - 1].to_owned(),
        text[..text.len() / 2].to_owned(),
        text.replace("rrp-backup/1", "rrp-backup/2"),
        text.replacen("Aiko", "Yuki", 1),
        text.clone() + "more\n",
        text.replacen("\"revision\":2", "\"revision\":3", 1),
    ];
    broken.extend((0..lines.len()).step_by(37).chain([lines.len() - 1]).map(without));
    for text in broken {
        let to: Arc<dyn Store> = Arc::new(MemoryStore::new());
        let refused = given(&text, &to).await;
        assert!(matches!(refused, Err(BackupError::Broken(..))), "{refused:?}");
        assert!(super::shelves(&*to).await.expect("an answer").is_empty());
    }
}

#[tokio::test]
async fn a_restore_that_ended_early_goes_on_and_a_strange_store_is_refused() {
    let (from, to) = (filled().await, Arc::new(MemoryStore::new()) as Arc<dyn Store>);
    let text = taken(&*from).await;
    for (name, changes) in [(LIBRARY, 1), ("b", 123), ("c", 2)] {
        for _ in 0..changes {
            change(&*to, name).await;
        }
    }
    assert!(to.remove(&id("c"), 77, "Ben").await.expect("an answer"));
    given(&text, &to).await.expect("restored");
    assert_eq!(compare(&*from, &*to).await.expect("an answer"), []);
    given(&text, &to).await.expect("once more is fine");
    change(&*to, "d").await;
    assert!(matches!(given(&text, &to).await, Err(BackupError::NotEmpty(id)) if id.as_str() == "d"));
    let strange: Arc<dyn Store> = Arc::new(MemoryStore::new());
    change(&*strange, "z").await;
    assert!(matches!(given(&text, &strange).await, Err(BackupError::NotEmpty(id)) if id.as_str() == "z"));
    let other: Arc<dyn Store> = Arc::new(MemoryStore::new());
    let mut now = Behaviour::default();
    let first =
        Change::of(id("other"), "Eve", "Edit").put(&now, RecordId::settings(), Record::Settings(Settings::named("A")));
    now.apply(&first);
    other.append(&id("a"), &Committed { revision: 1, change: first }, &now).await.expect("saved");
    assert!(matches!(given(&text, &other).await, Err(BackupError::NotEmpty(id)) if id.as_str() == "a"));
}

#[tokio::test]
async fn a_migration_copies_everything_goes_on_and_says_how_far_it_is() {
    let (from, to) = (filled().await, Arc::new(MemoryStore::new()) as Arc<dyn Store>);
    change(&*to, "a").await;
    let told = Mutex::new(Vec::new());
    let tell = |done: Counted, of: u64| told.lock().expect("nobody panicked").push((done.behaviours, of));
    let (done, differences) = migrate(&from, &to, &tell).await.expect("copied");
    assert_eq!((done, differences), (Counted { behaviours: 5, changes: 311 }, vec![]));
    assert_eq!(told.into_inner().expect("nobody panicked"), [(1, 5), (2, 5), (3, 5), (4, 5), (5, 5)]);
    change(&*to, "a").await;
    change(&*from, "e").await;
    let differences = compare(&*from, &*to).await.expect("an answer");
    let differences: Vec<_> = differences.iter().map(|d| (d.behaviour.as_str(), d.what)).collect();
    assert_eq!(differences, [("a", "its revision"), ("e", "it is in one store only")]);
    assert!(matches!(migrate(&from, &to, &|_, _| {}).await, Err(BackupError::NotEmpty(id)) if id.as_str() == "a"));
}
