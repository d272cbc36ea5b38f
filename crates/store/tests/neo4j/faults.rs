//! Neo4j killed while it saves, and Neo4j that hangs: nothing acknowledged is lost, every call ends, and the same
//! handle works again.

use crate::samples::{change, id, place};
use crate::server::{self, Neo4j};
use behaviour::{Behaviour, Committed};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;
use store::{Append, Neo4jStore, Store, StoreError, open_neo4j};
use tokio::task::{JoinSet, spawn_blocking};
use tokio::time::timeout;

const KILLS: usize = 4;
const WRITERS: usize = 8;
/// Changes that are acknowledged before a kill.
const BEFORE_KILL: usize = 40;
/// Each call must end within 3 s; the rest is for a busy machine.
const CALL_MAX: Duration = Duration::from_secs(8);
/// The longest time to ask a server that has come back, before giving up on it.
const BACK_MAX: Duration = Duration::from_secs(120);

fn committed(writer: usize, revision: u64) -> Committed {
    let edits = vec![place(&format!("p{}", revision % 7), revision as f64, writer as f64)];
    Committed { revision, change: change(&format!("op{revision}"), &Behaviour::default(), edits) }
}

async fn append(store: &Neo4jStore, writer: usize, revision: u64) -> Result<Append, StoreError> {
    let (id, committed, after) = (writer_id(writer), committed(writer, revision), Behaviour::default());
    timeout(CALL_MAX, store.append(&id, &committed, &after)).await.expect("every call ends")
}

fn writer_id(writer: usize) -> behaviour::Id {
    id(&format!("w{writer}"))
}

async fn started(part: &str) -> Option<(Neo4j, Arc<Neo4jStore>)> {
    let folder = server::folder(part)?;
    let neo4j = spawn_blocking(|| Neo4j::start(folder)).await.expect("a start");
    let store = open_neo4j(&neo4j.url()).await.expect("a store");
    Some((neo4j, Arc::new(store)))
}

/// Starts a server again on what it holds.
async fn again(mut neo4j: Neo4j) -> Neo4j {
    let started = spawn_blocking(move || {
        neo4j.start_again();
        neo4j
    });
    started.await.expect("a start")
}

/// The state that the writers of one round share: how much was acknowledged, and whether Neo4j was killed.
#[derive(Default)]
struct Round {
    acknowledged: AtomicUsize,
    killed: AtomicBool,
}

/// One behaviour's changes, one after the other, until Neo4j is killed; says which revision is in doubt then.
async fn write_on(store: Arc<Neo4jStore>, writer: usize, from: u64, round: Arc<Round>) -> u64 {
    let mut revision = from;
    loop {
        match append(&store, writer, revision).await {
            Ok(answer) => {
                assert!(matches!(answer, Append::Applied | Append::Duplicate { .. }), "{answer:?}");
                revision += 1;
                round.acknowledged.fetch_add(1, Ordering::SeqCst);
            }
            Err(error) if error.is_open() && round.killed.load(Ordering::SeqCst) => return revision,
            Err(error) => assert!(error.is_open(), "{error}"),
        }
    }
}

async fn until_acknowledged(round: &Round) {
    let acknowledged = async {
        while round.acknowledged.load(Ordering::SeqCst) < BEFORE_KILL {
            tokio::time::sleep(Duration::from_millis(5)).await;
        }
    };
    timeout(BACK_MAX, acknowledged).await.expect("changes are saved");
}

#[tokio::test(flavor = "multi_thread")]
async fn nothing_acknowledged_is_lost_when_neo4j_is_killed() {
    let Some((mut neo4j, store)) = started("kill -9 of Neo4j").await else { return };
    let mut in_doubt = [1_u64; WRITERS];
    for _ in 0..KILLS {
        let round = Arc::new(Round::default());
        let write = |writer| write_on(Arc::clone(&store), writer, in_doubt[writer], Arc::clone(&round));
        let writers: Vec<_> = (0..WRITERS).map(|writer| tokio::spawn(write(writer))).collect();
        until_acknowledged(&round).await;
        round.killed.store(true, Ordering::SeqCst);
        neo4j.kill();
        for (writer, ended) in writers.into_iter().enumerate() {
            in_doubt[writer] = ended.await.expect("the writer ends well");
        }
        neo4j = again(neo4j).await;
        until_answered(async || store.healthy().await).await;
        for (writer, revision) in in_doubt.iter_mut().enumerate() {
            check_after_kill(&store, writer, *revision).await;
            *revision += 1;
        }
    }
}

/// Everything acknowledged is there; the one in doubt was saved or is saved now, and nothing twice.
async fn check_after_kill(store: &Neo4jStore, writer: usize, in_doubt: u64) {
    let id = writer_id(writer);
    let head = until_answered(async || store.history(&id, 0, u32::MAX).await).await.len() as u64;
    assert!(head == in_doubt || head + 1 == in_doubt, "writer {writer}: {head} saved, {in_doubt} in doubt");
    let answer = until_answered(async || append(store, writer, in_doubt).await).await;
    let duplicate = Append::Duplicate { revision: in_doubt };
    assert!(answer == duplicate || (head < in_doubt && answer == Append::Applied), "writer {writer}: {answer:?}");
    let history = until_answered(async || store.history(&id, 0, u32::MAX).await).await;
    let wanted: Vec<_> = (1..=in_doubt).map(|revision| committed(writer, revision)).collect();
    assert_eq!(history, wanted, "writer {writer}");
    let loaded = until_answered(async || store.load(&id).await).await.expect("a behaviour");
    let mut replayed = Behaviour::default();
    history.iter().for_each(|made| replayed.apply(&made.change));
    assert_eq!((loaded.behaviour, loaded.revision), (replayed, in_doubt), "writer {writer}");
}

/// Calls until there is an answer: just after a start, Neo4j's first plans may take a busy machine longer than a call
/// has.
async fn until_answered<T>(call: impl AsyncFn() -> Result<T, StoreError>) -> T {
    let answered = async {
        loop {
            match timeout(CALL_MAX, call()).await.expect("every call ends") {
                Ok(answer) => break answer,
                Err(error) => assert!(error.is_open(), "{error}"),
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    timeout(BACK_MAX, answered).await.expect("the same handle works again")
}

#[tokio::test(flavor = "multi_thread")]
async fn a_neo4j_that_hangs_holds_nobody_up() {
    let Some((neo4j, store)) = started("SIGSTOP of Neo4j").await else { return };
    until_answered(async || append(&store, 0, 1).await).await;
    neo4j.hold();
    let mut calls = JoinSet::new();
    for _ in 0..3 {
        // More than there are connections, so some wait for a new one and some for one that is in use.
        for writer in 0..40 {
            let store = Arc::clone(&store);
            calls.spawn(async move { append(&store, writer, 2).await.map(|_| ()) });
        }
        let (again, third) = (Arc::clone(&store), Arc::clone(&store));
        calls.spawn(async move { timeout(CALL_MAX, again.load(&id("w0"))).await.expect("it ends").map(|_| ()) });
        calls.spawn(async move { timeout(CALL_MAX, third.healthy()).await.expect("it ends") });
        while let Some(ended) = calls.join_next().await {
            let error = ended.expect("no panic").expect_err("nobody answers");
            assert!(error.is_open(), "{error}");
        }
    }
    neo4j.go_on();
    until_answered(async || store.healthy().await).await;
    for revision in 2..=3 {
        let answer = until_answered(async || append(&store, 0, revision).await).await;
        assert!([Append::Applied, Append::Duplicate { revision }].contains(&answer), "{answer:?}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_neo4j_that_is_away_is_told_at_once_and_found_again() {
    let Some((mut neo4j, store)) = started("Neo4j away and back").await else { return };
    until_answered(async || append(&store, 0, 1).await).await;
    neo4j.kill();
    let told = append(&store, 0, 2).await.expect_err("nobody is there").to_string();
    assert!(told.contains("Neo4j at bolt://127.0.0.1:"), "{told}");
    assert!(open_neo4j(&neo4j.url()).await.is_err(), "a start is refused too");
    let _running = again(neo4j).await;
    until_answered(async || store.healthy().await).await;
    let answer = until_answered(async || append(&store, 0, 2).await).await;
    assert!([Append::Applied, Append::Duplicate { revision: 2 }].contains(&answer), "{answer:?}");
}
