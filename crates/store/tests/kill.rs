//! A server killed with `kill -9` while it saves loses nothing that it acknowledged.

use behaviour::{Behaviour, Change, Committed, Id, Kind, Note, Record, RecordId};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use store::{Append, Store, open};

const ROUNDS: usize = 200;
const DIRECTORY: &str = "RRP_STORE_KILLED_CHILD";
const ACKNOWLEDGED: &str = "acknowledged ";

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

fn committed(revision: u64) -> Committed {
    let change = Change::of(id(&format!("op{revision}")), "Aiko", "Note");
    let key = RecordId::new(Kind::Note, &id(&format!("n{}", revision % 50)));
    let note = Record::Note(Note::new(revision.to_string()));
    Committed { revision, change: change.put(&Behaviour::default(), key, note) }
}

/// Not a test of its own: the process that is killed. Without its directory it does nothing.
#[tokio::test]
async fn child_that_saves_until_it_is_killed() {
    let Ok(directory) = std::env::var(DIRECTORY) else { return };
    let store = open(Path::new(&directory)).await.expect("the directory is free");
    let loaded = store.load(&id("b")).await.expect("an answer");
    let (mut after, head) = loaded.map(|loaded| (loaded.behaviour, loaded.revision)).unwrap_or_default();
    for revision in head + 1.. {
        let made = committed(revision);
        after.apply(&made.change);
        assert_eq!(store.append(&id("b"), &made, &after).await, Ok(Append::Applied));
        let mut out = std::io::stdout().lock();
        writeln!(out, "\n{ACKNOWLEDGED}{revision}").and_then(|()| out.flush()).expect("somebody listens");
    }
}

fn child(directory: &Path) -> Child {
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    command.args(["--exact", "child_that_saves_until_it_is_killed", "--nocapture", "--test-threads=1"]);
    command.env(DIRECTORY, directory).stdin(Stdio::null()).stdout(Stdio::piped()).spawn().expect("a child")
}

/// Kills a child after some acknowledgements; says the last one it gave.
fn last_acknowledged(directory: &Path, after: usize) -> u64 {
    let mut child = child(directory);
    let mut lines = BufReader::new(child.stdout.take().expect("its output")).lines().map_while(Result::ok);
    let mut acknowledged = lines.by_ref().filter_map(|line| line.strip_prefix(ACKNOWLEDGED)?.parse().ok());
    let mut last = acknowledged.by_ref().take(after).last().expect("an acknowledgement");
    child.kill().expect("to kill it");
    for later in acknowledged {
        last = later;
    }
    child.wait().expect("its end");
    last
}

async fn check(directory: &Path, acknowledged: u64) {
    let store = open(directory).await.expect("the directory is free and whole");
    let loaded = store.load(&id("b")).await.expect("an answer").expect("a behaviour");
    assert!(loaded.revision >= acknowledged, "{acknowledged} was acknowledged, but the last is {}", loaded.revision);
    let history = store.history(&id("b"), 0, u32::MAX).await.expect("history");
    let wanted: Vec<_> = (1..=loaded.revision).map(committed).collect();
    assert!(history == wanted, "the history has a gap before {}", loaded.revision);
    let mut replayed = Behaviour::default();
    history.iter().for_each(|made| replayed.apply(&made.change));
    assert_eq!(loaded.behaviour, replayed);
}

#[tokio::test]
async fn nothing_acknowledged_is_lost_when_killed() {
    let directory = tempfile::tempdir().expect("a directory");
    for round in 0..ROUNDS {
        let acknowledged = last_acknowledged(directory.path(), 1 + round * 7 % 30);
        check(directory.path(), acknowledged).await;
    }
}
