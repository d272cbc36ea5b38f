//! The mark of a store that is being filled: there from the first moment, kept, and the same for every handle.

use super::samples::{id, save, settings};
use crate::{Append, Filling, FillingSource, Store, StoreError, check_whole};
use behaviour::RecordId;
use std::future::Future;
use std::sync::Arc;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    what_is_filled_is_marked_until_its_end(&make().await).await;
    nobody_else_fills_it(&make().await).await;
}

fn from(key: &str) -> FillingSource {
    FillingSource { key: key.to_owned(), again: format!("rrp restore {key} \"赤い\"") }
}

async fn what_is_filled_is_marked_until_its_end(store: &Arc<dyn Store>) {
    assert_eq!((store.filling().await, check_whole(&**store).await), (Ok(None), Ok(())), "a new store is whole");
    let filling = Filling::begin(store, &from("a")).await.expect("begun");
    assert!(!filling.goes_on());
    save(&**store, "b", "op", vec![(RecordId::settings(), settings("B"))]).await;
    assert_eq!(store.filling().await, Ok(Some(from("a"))));
    let refused = check_whole(&**store).await.expect_err("it is a part");
    assert!(refused.to_string().contains(&from("a").again), "{refused}");
    let filling = Filling::begin(store, &from("a")).await.expect("it goes on");
    assert!(filling.goes_on());
    filling.end().await.expect("ended");
    assert_eq!((store.filling().await, store.end_filling().await), (Ok(None), Ok(())), "once more is fine");
    assert!(store.load(&id("b")).await.expect("an answer").is_some(), "what was filled stays");
}

async fn nobody_else_fills_it(store: &Arc<dyn Store>) {
    let filling = Filling::begin(store, &from("a")).await.expect("begun");
    assert_eq!(store.begin_filling(&from("b")).await, Ok(from("a")));
    let refused = Filling::begin(store, &from("b")).await.err();
    assert_eq!(refused, Some(StoreError::Unfinished(from("a").again)));
    assert_eq!(store.filling().await, Ok(Some(from("a"))), "the mark stays that of the first");
    filling.end().await.expect("ended");
    Filling::begin(store, &from("b")).await.expect("now it is free").end().await.expect("ended");
    let saved = super::samples::append(&**store, "b", 1, super::samples::change("op", 1, Vec::new())).await;
    assert_eq!(saved, Append::Applied);
}
