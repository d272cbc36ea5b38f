//! Revisions with a name: each name once, in order, kept as long as the behaviour.

use super::samples::{id, key, note, save, settings};
use crate::{Store, StoreError};
use behaviour::{Checkpoint, Kind, RecordId};
use std::future::Future;
use std::sync::Arc;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    each_name_is_kept_once_and_in_order(make().await.as_ref()).await;
    what_is_not_there_has_no_name(make().await.as_ref()).await;
    names_go_with_their_behaviour(make().await.as_ref()).await;
}

fn named(revision: u64, name: &str, at_ms: u64) -> Checkpoint {
    Checkpoint { revision, name: name.to_owned(), by: "Aiko".to_owned(), at_ms }
}

async fn changed(store: &dyn Store, to: &str, times: usize) {
    save(store, to, "op1", vec![(RecordId::settings(), settings(to))]).await;
    for number in 2..=times {
        save(store, to, &format!("op{number}"), vec![(key(Kind::Note, "n"), note(&number.to_string()))]).await;
    }
}

async fn each_name_is_kept_once_and_in_order(store: &dyn Store) {
    changed(store, "b", 3).await;
    changed(store, "c", 1).await;
    assert_eq!(store.checkpoints(&id("b")).await, Ok(vec![]));
    let all = [named(1, "球 \"quoted\" 👩‍🔬", 9), named(3, "a", 4), named(3, "Z", 5), named(3, "b", 5)];
    for one in [3, 1, 0, 2].map(|at: usize| &all[at]) {
        assert_eq!(store.keep_checkpoint(&id("b"), one).await, Ok(true));
        assert_eq!(store.keep_checkpoint(&id("b"), one).await, Ok(true), "sent twice, kept once");
    }
    assert_eq!(store.checkpoints(&id("b")).await, Ok(all.to_vec()));
    for other in [named(2, "a", 4), named(3, "a", 5), Checkpoint { by: "Ben".to_owned(), ..named(3, "a", 4) }] {
        assert_eq!(store.keep_checkpoint(&id("b"), &other).await, Ok(false), "the name is taken");
    }
    assert_eq!(store.keep_checkpoint(&id("c"), &named(1, "a", 4)).await, Ok(true), "each behaviour has its own");
    for _ in 0..2 {
        assert_eq!(store.drop_checkpoint(&id("b"), "a").await, Ok(()));
    }
    assert_eq!(store.checkpoints(&id("b")).await, Ok([&all[..1], &all[2..]].concat()));
    assert_eq!(store.keep_checkpoint(&id("b"), &named(2, "a", 9)).await, Ok(true), "a name is free again");
    assert_eq!(store.checkpoints(&id("c")).await, Ok(vec![named(1, "a", 4)]));
    assert_eq!(store.load(&id("b")).await.expect("an answer").expect("it").revision, 3, "no name is a change");
}

async fn what_is_not_there_has_no_name(store: &dyn Store) {
    changed(store, "b", 2).await;
    for revision in [0, 3, u64::MAX] {
        assert_eq!(store.keep_checkpoint(&id("b"), &named(revision, "a", 1)).await, Ok(false), "{revision}");
    }
    assert_eq!(store.keep_checkpoint(&id("nobody"), &named(1, "a", 1)).await, Ok(false));
    assert_eq!(store.drop_checkpoint(&id("nobody"), "a").await, Ok(()));
    assert_eq!(store.checkpoints(&id("nobody")).await, Ok(vec![]));
    let late = store.keep_checkpoint(&id("b"), &named(1, "a", u64::MAX)).await;
    assert!(matches!(late, Err(StoreError::Refused(_))), "{late:?}");
    assert_eq!(store.checkpoints(&id("b")).await, Ok(vec![]));
}

async fn names_go_with_their_behaviour(store: &dyn Store) {
    let one = named(1, "First", 1);
    for name in ["gone", "back"] {
        changed(store, name, 1).await;
        assert_eq!(store.keep_checkpoint(&id(name), &one).await, Ok(true));
        assert_eq!(store.remove(&id(name), if name == "gone" { 10 } else { 20 }, "Ben").await, Ok(true));
        assert_eq!(store.checkpoints(&id(name)).await, Ok(vec![one.clone()]), "the bin keeps them");
    }
    assert_eq!(store.purge(15).await, Ok(1));
    assert_eq!(store.restore(&id("back")).await, Ok(true));
    assert_eq!(store.checkpoints(&id("gone")).await, Ok(vec![]));
    assert_eq!(store.checkpoints(&id("back")).await, Ok(vec![one]));
    changed(store, "gone", 1).await;
    assert_eq!(store.checkpoints(&id("gone")).await, Ok(vec![]), "born again without them");
}
