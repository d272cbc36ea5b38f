//! The bin: what is in it is kept and closed, what is purged leaves nothing behind.

use super::samples::{
    append, change, filter, helper, id, in_bin, key, note, save, settings, stream, try_append, two_streams,
};
use crate::{Append, LIBRARY, Listing, Query, Store, StoreError};
use behaviour::{Kind, Procedure, RecordId};
use std::future::Future;
use std::sync::Arc;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    the_bin_keeps_and_gives_back(make().await.as_ref()).await;
    the_bin_is_closed_for_changes(make().await.as_ref()).await;
    purging_leaves_nothing_behind(make().await.as_ref()).await;
    the_library_never_goes(make().await.as_ref()).await;
}

async fn the_bin_keeps_and_gives_back(store: &dyn Store) {
    save(store, "b", "op1", vec![(RecordId::settings(), settings("Greeter"))]).await;
    let (before, listed) = (store.load(&id("b")).await, store.list(&Query::default()).await);
    assert_eq!(store.remove(&id("nobody"), 50, "Ben").await, Ok(false));
    assert_eq!(store.remove(&id("b"), 50, "Ben").await, Ok(true));
    assert_eq!(store.remove(&id("b"), 60, "Aiko").await, Ok(false));
    assert_eq!(store.list(&Query::default()).await, Ok(Listing::default()));
    let bin = store.list(&in_bin()).await.expect("the bin").lines;
    assert_eq!((bin.len(), bin[0].name.as_str(), bin[0].changed_ms, bin[0].by.as_str()), (1, "Greeter", 50, "Ben"));
    assert_eq!(store.load(&id("b")).await.expect("an answer").expect("a behaviour").removed_ms, Some(50));
    assert_eq!(store.restore(&id("b")).await, Ok(true));
    assert_eq!(store.restore(&id("b")).await, Ok(false));
    assert_eq!((store.load(&id("b")).await, store.list(&Query::default()).await), (before, listed));
}

async fn the_bin_is_closed_for_changes(store: &dyn Store) {
    let first = change("op1", 1, vec![(RecordId::settings(), settings("B"))]);
    append(store, "b", 1, first.clone()).await;
    assert_eq!(store.remove(&id("b"), 50, "Ben").await, Ok(true));
    assert_eq!(append(store, "b", 2, first).await, Append::Duplicate { revision: 1 });
    let next = change("op2", 2, vec![(key(Kind::Note, "n"), note("late"))]);
    assert_eq!(try_append(store, "b", 2, next.clone()).await, Err(StoreError::Gone));
    assert_eq!(store.restore(&id("b")).await, Ok(true));
    assert_eq!(try_append(store, "b", 2, next).await, Ok(Append::Applied));
}

async fn purging_leaves_nothing_behind(store: &dyn Store) {
    for behaviour in ["old", "new", "kept"] {
        let user = filter(Procedure::body("near(x)"));
        let named = (RecordId::settings(), settings(behaviour));
        let edits = [two_streams(), vec![named, (key(Kind::Connector, "c"), user)]].concat();
        save(store, behaviour, "op1", edits).await;
        save(store, behaviour, "op2", vec![(key(Kind::Stream, "s"), stream("S", 0))]).await;
    }
    assert_eq!(store.remove(&id("old"), 10, "Ben").await, Ok(true));
    assert_eq!(store.remove(&id("new"), 20, "Ben").await, Ok(true));
    assert_eq!(store.purge(10).await, Ok(0), "purged is what was removed before that time");
    assert_eq!(store.purge(20).await, Ok(1));
    assert_eq!(store.load(&id("old")).await, Ok(None));
    assert_eq!(store.history(&id("old"), 0, 9).await, Ok(vec![]));
    assert_eq!(store.restore(&id("old")).await, Ok(false));
    save(store, "old", "op1", vec![(key(Kind::Note, "n"), note("born again"))]).await;
    let again = store.load(&id("old")).await.expect("an answer").expect("a behaviour");
    assert_eq!((again.revision, again.behaviour.records.len()), (1, 1));
    assert_eq!(store.users("near").await.expect("uses").len(), 1);
    assert_eq!(store.restore(&id("new")).await, Ok(true));
    assert_eq!(store.users("near").await.expect("uses").len(), 2);
}

async fn the_library_never_goes(store: &dyn Store) {
    save(store, LIBRARY, "op1", vec![(key(Kind::Helper, "h"), helper("near", "x < 1"))]).await;
    assert_eq!(store.remove(&id(LIBRARY), 1, "Ben").await, Ok(false));
    assert_eq!(store.purge(u64::MAX).await, Ok(0));
    assert_eq!(store.list(&Query::default()).await, Ok(Listing::default()));
    assert_eq!(store.list(&in_bin()).await, Ok(Listing::default()));
}
