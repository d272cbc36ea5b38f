//! A document of 4 MB.

use super::samples::{append, change, id, key, note, save};
use crate::{Append, Store};
use behaviour::{Behaviour, Committed, Kind};

const NOTES: usize = 1_050;
const NOTE_CHARS: usize = 4_000;

pub(super) async fn check(store: &dyn Store) {
    let text = |number: usize| {
        format!("{number} ").chars().chain("note é ".chars().cycle()).take(NOTE_CHARS).collect::<String>()
    };
    let notes = (0..NOTES).map(|number| (key(Kind::Note, &format!("n{number}")), note(&text(number)))).collect();
    let made = change("large", 1, notes);
    assert_eq!(append(store, "b", 1, made.clone()).await, Append::Applied);
    save(store, "b", "small", vec![(key(Kind::Note, "n0"), note("short"))]).await;
    let mut wanted = Behaviour::default();
    wanted.apply(&made);
    wanted.records.insert(key(Kind::Note, "n0"), note("short"));
    let loaded = store.load(&id("b")).await.expect("an answer").expect("a behaviour");
    assert!(loaded.behaviour == wanted, "a large behaviour reads back as it was");
    let first = store.history(&id("b"), 0, 1).await.expect("history");
    assert!(first == [Committed { revision: 1, change: made }], "so does a large change");
}
