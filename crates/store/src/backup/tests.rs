//! Backups there and back, cut off, changed, and taken up again.

use super::{BackedUpRobot, BackupError, Counted, backup, compare, migrate, read, restore};
use crate::{Filling, FillingSource, FolderStore, LIBRARY, MemoryStore, Store, StoreError, check_whole};
use behaviour::{Behaviour, Change, Checkpoint, Committed, Helper, Id, Kind, Note, Record, RecordId, Settings};
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
        _ => (RecordId::new(Kind::Note, &id(&format!("n{head}"))), Record::Note(Note::new(format!("{head}\n")))),
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
        ..Helper::default()
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
    for (to, revision, name) in [("b", 300, "Works"), ("b", 7, "First try"), ("c", 2, "Works"), ("d", 1, "赤")] {
        name_version(&*store, to, revision, name).await;
    }
    assert!(store.remove(&id("c"), 77, "Ben").await.expect("an answer"));
    store
}

async fn name_version(store: &dyn Store, to: &str, revision: u64, name: &str) {
    let named = Checkpoint { revision, name: name.to_owned(), by: "Aiko".to_owned(), at_ms: 5 };
    assert_eq!(store.keep_checkpoint(&id(to), &named).await, Ok(true));
}

fn robots() -> Vec<BackedUpRobot> {
    let robot = |name: &str, order| BackedUpRobot { id: id(name), name: name.to_owned(), seed: 3, real: None, order };
    vec![robot("nao", vec![id("b"), id("a")]), robot("other", Vec::new())]
}

async fn taken(store: &dyn Store) -> String {
    let text = Mutex::new(String::new());
    let put = |line: String| {
        text.lock().expect("nobody panicked").push_str(&line);
        std::future::ready(Ok(()))
    };
    let done = backup(store, EPOCH, &robots(), put, &|_, _| {}).await.expect("a backup");
    assert_eq!(done, Counted { behaviours: 5, changes: 311 });
    text.into_inner().expect("nobody panicked")
}

async fn given(text: &str, to: &Arc<dyn Store>) -> Result<Counted, BackupError> {
    let read = read(Cursor::new(text.to_owned().into_bytes()), &**to).await?;
    assert_eq!(read.robots(), robots());
    let filling = Filling::begin(to, &read.source("rrp restore it")).await?;
    let done = restore(read, &filling, &|_, _| {}).await?;
    filling.end().await?;
    Ok(done)
}

fn other_store() -> FillingSource {
    FillingSource { key: "another store".to_owned(), again: "rrp migrate --from it".to_owned() }
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
        text.replacen("First try", "First\u{200b}try", 1),
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
    let (done, differences) = migrate(&from, &to, &other_store(), &tell).await.expect("copied");
    assert_eq!((done, differences), (Counted { behaviours: 5, changes: 311 }, vec![]));
    assert_eq!(told.into_inner().expect("nobody panicked"), [(1, 5), (2, 5), (3, 5), (4, 5), (5, 5)]);
    change(&*to, "a").await;
    change(&*from, "e").await;
    let differences = compare(&*from, &*to).await.expect("an answer");
    let differences: Vec<_> = differences.iter().map(|d| (d.behaviour.as_str(), d.what)).collect();
    assert_eq!(differences, [("a", "its revision"), ("e", "it is in one store only")]);
    assert!(
        matches!(migrate(&from, &to, &other_store(), &|_, _| {}).await, Err(BackupError::NotEmpty(id)) if id.as_str() == "a")
    );
}

/// A backup with another line in the place of one, and with the sum that belongs to it.
fn resigned(text: &str, at: usize, line: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    lines[at] = line;
    let (end, before) = lines.split_last().expect("an end");
    let before = before.join("\n") + "\n";
    let sum = before
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    let (start, _) = end.split_once("\"sum\":").expect("a sum");
    format!("{before}{start}\"sum\":\"{sum:016x}\"}}}}\n")
}

#[tokio::test]
async fn a_backup_of_an_older_rrp_has_no_robots_and_is_restored() {
    let text = taken(&*filled().await).await;
    let robots: Vec<_> = text.lines().filter(|line| line.starts_with("{\"robot\"")).collect();
    assert_eq!(robots.len(), 2);
    let older = text.lines().filter(|line| !robots.contains(line)).collect::<Vec<_>>().join("\n");
    let older = resigned(&older, 0, older.lines().next().expect("a first line"));
    let to: Arc<dyn Store> = Arc::new(MemoryStore::new());
    let read = read(Cursor::new(older.into_bytes()), &*to).await.expect("it is whole");
    assert_eq!(read.robots(), []);
    let filling = Filling::begin(&to, &read.source("again")).await.expect("begun");
    assert_eq!(restore(read, &filling, &|_, _| {}).await.expect("restored").changes, 311);
}

#[tokio::test]
async fn what_no_server_can_have_written_is_refused_though_its_sum_is_right() {
    let text = taken(&*filled().await).await;
    let lines: Vec<&str> = text.lines().collect();
    let with = |wanted: &str, from: &str, to: &str| {
        let at = lines.iter().position(|line| line.contains(wanted)).expect("a line");
        resigned(&text, at, &lines[at].replacen(from, to, 1))
    };
    assert_eq!(resigned(&text, 0, lines[0]), text);
    let cases = [
        (with("\"start\"", "\"epoch\":5", "\"epoch\":9223372036854775808"), "so often"),
        (with("\"id\":\"d\"", "\"id\":\"d\"", "\"id\":\"a\""), "was there before"),
        (with("\"b-7\"", "\"b-7\"", "\"b-6\""), "twice"),
        (with("\"b-7\"", "\"note/n7\"", "\"note/n6\""), "does not fit what note/n6 was"),
        (with("\"b-7\"", "\"note/n7\"", "\"stream/n7\""), "No room would have made"),
        (with("\"id\":\"a\"", "\"revision\":1", "\"revision\":0"), "does not follow"),
    ];
    let (long, nul) = ("x".repeat(1 << 20), "a\\u0000b");
    let cases = cases.into_iter().chain([
        (with("\"name\":\"d\"", "\"name\":\"d\"", &format!("\"name\":\"{long}\"")), "too large"),
        (with("\"name\":\"d\"", "\"name\":\"d\"", &format!("\"name\":\"{nul}\"")), "nobody sees"),
        (with("\"b-7\"", "\"author\":\"Aiko\"", &format!("\"author\":\"{long}\"")), "too long"),
        (with("\"b-7\"", "\"label\":\"Edit\"", &format!("\"label\":\"{nul}\"")), "nobody sees"),
        (with("\"b-7\"", "\"at_ms\":7", "\"at_ms\":18446744073709551615"), "in the future"),
        (with("\"by\":\"Ben\"", "\"by\":\"Ben\"", &format!("\"by\":\"{nul}\"")), "gone to the bin so"),
        (with("\"by\":\"Ben\"", "\"atMs\":77", "\"atMs\":18446744073709551615"), "in the future"),
        (with("First try", "\"by\":\"Aiko\"", &format!("\"by\":\"{long}\"")), "named a version so"),
    ]);
    for (text, why) in cases {
        let to: Arc<dyn Store> = Arc::new(MemoryStore::new());
        let refused = given(&text, &to).await.expect_err("this is refused");
        assert!(
            matches!(&refused, BackupError::Broken(line, flaw) if *line > 0 && flaw.to_string().contains(why)),
            "{refused}"
        );
        assert!(super::shelves(&*to).await.expect("an answer").is_empty());
    }
}

#[tokio::test]
async fn a_large_number_of_starts_is_restored_at_once() {
    let text = taken(&*filled().await).await;
    let first = text.lines().next().expect("a first line").replace("\"epoch\":5", "\"epoch\":9007199254740992");
    let text = resigned(&text, 0, &first);
    let folder = tempfile::tempdir().expect("a folder");
    let sqlite: Arc<dyn Store> = Arc::new(crate::open(folder.path()).await.expect("a store"));
    given(&text, &sqlite).await.expect("restored");
    assert_eq!(sqlite.next_epoch().await, Ok((1 << 53) + 1));
}

/// Cuts and flips of all kinds, the same ones each time: each is refused with a sentence, and none hangs or panics.
#[test]
fn whatever_is_cut_or_flipped_is_noticed() {
    let text = tokio::runtime::Runtime::new().expect("a runtime").block_on(async { taken(&*filled().await).await });
    let mut last = 7_u64;
    let mut below = |bound: usize| {
        last = last.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(last >> 33).expect("it is small") % bound
    };
    for round in 0..400 {
        let mut bytes = text.clone().into_bytes();
        match round % 4 {
            0 => bytes.truncate(below(bytes.len())),
            1 => drop(bytes.remove(below(bytes.len()))),
            2 => {
                let at = below(bytes.len());
                bytes[at] ^= 1 << below(8);
            }
            _ => {
                let from = below(bytes.len());
                let piece = bytes[from..(from + 1 + below(500)).min(bytes.len())].to_vec();
                let to = below(bytes.len());
                bytes.splice(to..to, piece);
            }
        }
        if bytes == text.as_bytes() {
            continue;
        }
        let refused = super::verify(&mut bytes.as_slice());
        assert!(matches!(refused, Err(BackupError::Broken(..))), "round {round}: {refused:?}");
    }
}

#[tokio::test]
async fn a_store_that_is_filled_is_a_part_until_all_is_there_and_only_its_source_goes_on() {
    let (from, to) = (filled().await, Arc::new(MemoryStore::new()) as Arc<dyn Store>);
    let text = taken(&*from).await;
    let first = read(Cursor::new(text.clone().into_bytes()), &*to).await.expect("it is whole");
    drop(Filling::begin(&to, &first.source("rrp restore monday")).await.expect("begun, and then killed"));
    change(&*to, "d").await;
    let part = StoreError::Unfinished("rrp restore monday".to_owned());
    assert_eq!(check_whole(&*to).await, Err(part.clone()));
    let refused = migrate(&from, &to, &other_store(), &|_, _| {}).await.expect_err("it is filled from elsewhere");
    assert!(matches!(refused, BackupError::Store(error) if error == part));
    change(&*from, "e").await;
    let other = text.replacen("\"epoch\":5", "\"epoch\":6", 1);
    let other = resigned(&other, 0, other.lines().next().expect("a first line"));
    assert!(matches!(given(&other, &to).await, Err(BackupError::Store(error)) if error == part), "another backup");
    given(&text, &to).await.expect("the same backup goes on");
    assert_eq!(check_whole(&*to).await, Ok(()));
    assert_eq!(taken(&*to).await, text);
}

#[tokio::test]
async fn what_changed_in_the_first_store_while_a_migration_was_dead_is_brought_too() {
    let (from, to) = (filled().await, Arc::new(MemoryStore::new()) as Arc<dyn Store>);
    migrate(&from, &to, &other_store(), &|_, _| {}).await.expect("copied");
    drop(Filling::begin(&to, &other_store()).await.expect("killed just before its end"));
    assert!(from.restore(&id("c")).await.expect("an answer"));
    change(&*from, "c").await;
    from.drop_checkpoint(&id("b"), "Works").await.expect("an answer");
    let (_, differences) = migrate(&from, &to, &other_store(), &|_, _| {}).await.expect("copied");
    assert_eq!((differences, check_whole(&*to).await), (vec![], Ok(())));
}

#[tokio::test]
async fn a_whole_store_with_more_of_its_own_stays_one_when_it_is_filled_again() {
    let (from, to) = (filled().await, Arc::new(MemoryStore::new()) as Arc<dyn Store>);
    migrate(&from, &to, &other_store(), &|_, _| {}).await.expect("copied");
    name_version(&*to, "a", 1, "Mine").await;
    let (_, differences) = migrate(&from, &to, &other_store(), &|_, _| {}).await.expect("copied");
    assert_eq!((differences.len(), check_whole(&*to).await), (1, Ok(())));
}

#[tokio::test]
async fn a_folder_in_which_an_older_rrp_did_not_end_is_filled_by_any_backup() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mark, text) = (folder.path().join("rrp.restoring"), taken(&*filled().await).await);
    for kind in ["files:", "sqlite:"] {
        std::fs::write(&mark, "").expect("a file");
        let url = format!("{kind}{}", folder.path().display());
        assert!(matches!(crate::open_url(&url).await, Err(StoreError::Unfinished(_))));
        assert!(crate::check_folder(folder.path()).is_err());
        let to = crate::open_url_to_fill(&url).await.expect("it can be filled");
        given(&text, &to).await.expect("restored");
        drop(to);
        crate::open_url(&url).await.expect("it is whole");
        assert!(!mark.exists());
    }
}

/// The templates, edits of several people, an undo, named versions, the library and a program in the bin, as the rrp of
/// November 2026 wrote them.
#[tokio::test]
async fn a_real_backup_of_before_is_restored_as_it_is() {
    let text = include_str!("samples/november.rrpbackup");
    let to: Arc<dyn Store> = Arc::new(MemoryStore::new());
    let read = read(Cursor::new(text.as_bytes().to_vec()), &*to).await.expect("it is whole");
    let filling = Filling::begin(&to, &read.source("rrp restore")).await.expect("begun");
    let done = restore(read, &filling, &|_, _| {}).await.expect("restored");
    filling.end().await.expect("ended");
    assert_eq!(done, Counted { behaviours: 14, changes: 78 });
    let again = Mutex::new(String::new());
    let put = |line: String| {
        again.lock().expect("nobody panicked").push_str(&line);
        std::future::ready(Ok(()))
    };
    backup(&*to, 1, &[], put, &|_, _| {}).await.expect("a backup");
    let middle = |text: &str| {
        text.lines()
            .filter(|line| !line.contains("\"start\"") && !line.contains("\"sum\""))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(middle(&again.into_inner().expect("nobody panicked")), middle(text));
}
