//! Many at once: every change is saved once, in one order, and nobody sees half of one.

use super::samples::{append, change, id, key, note};
use crate::{Append, Store};
use behaviour::{Behaviour, Kind};
use std::future::Future;
use std::sync::Arc;

const APPENDERS: u64 = 32;
const CHANGES_EACH: u64 = 4;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    appenders_make_one_order(&make().await).await;
    many_send_the_same_change(&make().await).await;
    conflicts_spoil_no_other_change(&make().await).await;
    readers_see_whole_changes(&make().await).await;
}

async fn all<T: 'static>(tasks: Vec<tokio::task::JoinHandle<T>>) -> Vec<T> {
    let mut answers = Vec::new();
    for task in tasks {
        answers.push(task.await.expect("the task ends well"));
    }
    answers
}

async fn appenders_make_one_order(store: &Arc<dyn Store>) {
    all((0..APPENDERS).map(|who| tokio::spawn(append_some(Arc::clone(store), who))).collect()).await;
    let history = store.history(&id("b"), 0, u32::MAX).await.expect("history");
    let revisions: Vec<_> = history.iter().map(|made| made.revision).collect();
    assert_eq!(revisions, (1..=APPENDERS * CHANGES_EACH).collect::<Vec<_>>());
    let mut replayed = Behaviour::default();
    history.iter().for_each(|made| replayed.apply(&made.change));
    let loaded = store.load(&id("b")).await.expect("an answer").expect("a behaviour");
    assert_eq!((loaded.behaviour, loaded.revision), (replayed, APPENDERS * CHANGES_EACH));
}

async fn append_some(store: Arc<dyn Store>, who: u64) {
    for number in 0..CHANGES_EACH {
        let name = format!("op-{who}-{number}");
        let made = change(&name, number, vec![(key(Kind::Note, &name), note(&name))]);
        loop {
            let head = store.load(&id("b")).await.expect("an answer").map_or(0, |loaded| loaded.revision);
            match append(store.as_ref(), "b", head + 1, made.clone()).await {
                Append::Applied => break,
                Append::Conflict { head: now } => assert!(now > head, "a conflict has a reason"),
                Append::Reused { revision } | Append::Duplicate { revision } => {
                    panic!("{name} was never sent before, but saved as {revision}")
                }
            }
        }
    }
}

async fn many_send_the_same_change(store: &Arc<dyn Store>) {
    let send = |_| {
        let (store, made) = (Arc::clone(store), change("op", 1, vec![(key(Kind::Note, "n"), note("once"))]));
        tokio::spawn(async move { append(store.as_ref(), "b", 1, made).await })
    };
    let answers = all((0..APPENDERS).map(send).collect()).await;
    assert_eq!(answers.iter().filter(|answer| **answer == Append::Applied).count(), 1);
    let others = answers.iter().filter(|answer| **answer != Append::Applied);
    others.for_each(|answer| assert_eq!(*answer, Append::Duplicate { revision: 1 }));
}

/// Every second one is stale; they wait together, so one transaction is likely to hold both.
async fn conflicts_spoil_no_other_change(store: &Arc<dyn Store>) {
    let send = |who: u64| {
        let (store, name) = (Arc::clone(store), format!("b{who}"));
        let made = change("op", 1, vec![(key(Kind::Note, "n"), note("own"))]);
        tokio::spawn(async move { append(store.as_ref(), &name, 1 + who % 2, made).await })
    };
    let answers = all((0..APPENDERS).map(send).collect()).await;
    for (who, answer) in (0..APPENDERS).zip(answers) {
        assert_eq!(answer, if who % 2 == 0 { Append::Applied } else { Append::Conflict { head: 0 } });
        let there = store.load(&id(&format!("b{who}"))).await.expect("an answer").is_some();
        assert_eq!(there, who % 2 == 0);
    }
}

/// Each change writes its number into two notes; a reader must never see two numbers.
async fn readers_see_whole_changes(store: &Arc<dyn Store>) {
    let writing = Arc::clone(store);
    let writer = tokio::spawn(async move {
        for number in 1..=50_u64 {
            let text = number.to_string();
            let edits = vec![(key(Kind::Note, "a"), note(&text)), (key(Kind::Note, "z"), note(&text))];
            append(writing.as_ref(), "b", number, change(&format!("op{number}"), number, edits)).await;
        }
    });
    while !writer.is_finished() {
        let Some(seen) = store.load(&id("b")).await.expect("an answer") else { continue };
        let wanted = note(&seen.revision.to_string());
        assert!(seen.behaviour.records.values().all(|record| *record == wanted), "{seen:?}");
    }
    writer.await.expect("the writer ends well");
}
