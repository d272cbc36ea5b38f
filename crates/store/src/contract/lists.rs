//! Lists: pages that stay whole while others write, orders, owners, words.

use super::samples::{append, change, id, in_bin, key, names, note, now, save, settings, stream};
use crate::{Query, SearchPlace, Sort, Store, Tagged};
use behaviour::{Change, Kind, Record, RecordId, Settings};
use std::collections::BTreeSet;
use std::future::Future;
use std::sync::Arc;

const MANY: u64 = 23;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    for sort in [Sort::Changed, Sort::Name] {
        pages_hold_everything_once_while_others_write(make().await.as_ref(), sort).await;
    }
    names_are_in_order_whatever_their_case(make().await.as_ref()).await;
    owners_are_those_who_made_it(make().await.as_ref()).await;
    words_are_found_in_any_case_and_place(make().await.as_ref()).await;
    hostile_words_find_only_what_they_say(make().await.as_ref()).await;
    what_is_found_follows_the_changes(make().await.as_ref()).await;
    tags_are_kept_found_and_counted(make().await.as_ref()).await;
}

async fn made(store: &dyn Store, behaviour: &str, name: &str, at_ms: u64) {
    append(store, behaviour, 1, change("op1", at_ms, vec![(RecordId::settings(), settings(name))])).await;
}

async fn pages_hold_everything_once_while_others_write(store: &dyn Store, sort: Sort) {
    for number in 0..MANY {
        made(store, &format!("b{number}"), &format!("N{}", number / 3), number / 2).await;
    }
    let (mut seen, mut query) = (Vec::new(), Query { sort, most: 5, ..Query::default() });
    for round in 0.. {
        let page = store.list(&query).await.expect("a page");
        assert_eq!(page.total, MANY + round, "{sort:?}");
        seen.extend(page.lines.into_iter().map(|line| line.id.to_string()));
        made(store, &format!("new{round}"), "A", 1_000 + round).await;
        query.after = page.next;
        if query.after.is_none() {
            break;
        }
    }
    let old: Vec<_> = seen.iter().filter(|id| id.starts_with('b')).collect();
    assert_eq!(old.len() as u64, MANY, "{sort:?}: {seen:?}");
    assert_eq!(seen.iter().collect::<BTreeSet<_>>().len(), seen.len(), "{sort:?}: nothing twice");
}

async fn names_are_in_order_whatever_their_case(store: &dyn Store) {
    for (number, name) in ["b", "A", "a", "É", "C"].into_iter().enumerate() {
        made(store, &format!("id{number}"), name, 1).await;
    }
    let query = Query { sort: Sort::Name, ..Query::default() };
    assert_eq!(names(store, query).await, ["A", "a", "b", "C", "É"]);
}

async fn owners_are_those_who_made_it(store: &dyn Store) {
    made(store, "a", "Hers", 1).await;
    let first = change("op1", 2, vec![(RecordId::settings(), settings("His"))]);
    append(store, "b", 1, Change { author: "Ben".to_owned(), ..first }).await;
    save(store, "b", "op2", vec![(key(Kind::Note, "n"), note("by Aiko"))]).await;
    let of = |owner: &str| Query { owner: Some(owner.to_owned()), ..Query::default() };
    assert_eq!(names(store, of("Aiko")).await, ["Hers"]);
    assert_eq!(names(store, of("Ben")).await, ["His"]);
    assert_eq!(names(store, of("ben")).await, [""; 0]);
}

fn tagged(name: &str, tags: &[&str]) -> (RecordId, Record) {
    let tags = tags.iter().map(|tag| (*tag).to_owned()).collect();
    (RecordId::settings(), Record::Settings(Settings { tags, ..Settings::named(name) }))
}

async fn tags_are_kept_found_and_counted(store: &dyn Store) {
    save(store, "a", "op1", vec![tagged("Ball", &["group b", "赤"])]).await;
    save(store, "b", "op1", vec![tagged("Greet", &["it's \"x\" %", "group b"])]).await;
    made(store, "c", "Plain", 1).await;
    assert_eq!(now(store, "a").await.settings().expect("settings").tags, ["group b", "赤"]);
    let of = |tag: &str| Query { tag: Some(tag.to_owned()), sort: Sort::Name, ..Query::default() };
    assert_eq!(names(store, of("group b")).await, ["Ball", "Greet"]);
    assert_eq!(names(store, of("it's \"x\" %")).await, ["Greet"]);
    for none in ["group", "Group B", "", "group b\u{0}"] {
        assert_eq!(names(store, of(none)).await, [""; 0], "{none:?}");
    }
    assert_eq!(names(store, Query { most: 1, ..of("group b") }).await, ["Ball"]);
    assert_eq!(names(store, with("赤")).await, ["Ball"], "tags are searched too");
    let line = store.list(&of("赤")).await.expect("a page").lines.remove(0);
    assert_eq!(line.tags, ["group b", "赤"]);
    let counted = |told: Vec<Tagged>| told.into_iter().map(|one| (one.tag, one.count)).collect::<Vec<_>>();
    let told = counted(store.tags().await.expect("the tags"));
    assert_eq!(told, [("group b".into(), 2), ("it's \"x\" %".into(), 1), ("赤".into(), 1)]);
    save(store, "a", "op2", vec![tagged("Ball", &[])]).await;
    assert!(store.remove(&id("b"), 9, "Aiko").await.expect("an answer"));
    assert_eq!(counted(store.tags().await.expect("the tags")), []);
    assert_eq!(names(store, Query { place: SearchPlace::Bin, ..of("group b") }).await, ["Greet"]);
    assert_eq!(now(store, "a").await.settings().expect("settings").tags, [""; 0]);
}

fn with(words: &str) -> Query {
    Query { words: words.to_owned(), ..Query::default() }
}

async fn words_are_found_in_any_case_and_place(store: &dyn Store) {
    let edits = vec![
        (RecordId::settings(), settings("Follow the Ball")),
        (key(Kind::Stream, "s"), stream("赤いボール", 0)),
        (key(Kind::Note, "n"), note("for Élodie's first session")),
    ];
    save(store, "a", "op1", edits).await;
    made(store, "b", "Greet", 1).await;
    let found = ["", " \t", "BALL", "all fol", "élod", "ボール", "い", "a", "session ball e"];
    for words in found {
        assert!(names(store, with(words)).await.contains(&"Follow the Ball".to_owned()), "{words:?}");
    }
    for words in ["balls", "ball greet", "赤ボ", "0"] {
        assert_eq!(names(store, with(words)).await, [""; 0], "{words:?}");
    }
    assert_eq!(names(store, with("greet")).await, ["Greet"]);
}

async fn hostile_words_find_only_what_they_say(store: &dyn Store) {
    let hostile = [
        "100% sure_",
        "\"quoted\"",
        "it's",
        "AND",
        "a OR b",
        "near*",
        "NOT (x)",
        "[a-z]",
        "\\d+",
        "{}",
        "col:um",
        "--",
        "/*c*/",
        "a\u{0}b",
        "^~!?",
        "+-&|",
    ];
    for (number, name) in hostile.iter().enumerate() {
        made(store, &format!("b{number}"), name, 1).await;
    }
    made(store, "plain", "zzz", 1).await;
    for name in hostile {
        let found = names(store, with(name)).await;
        assert!(found.contains(&name.to_owned()) && !found.contains(&"zzz".to_owned()), "{name:?}: {found:?}");
        let needles = with(name).needles();
        let says = |other: &String| needles.iter().all(|word| behaviour::as_looks(other).to_lowercase().contains(word));
        assert!(found.iter().all(says), "{name:?}: {found:?}");
    }
    assert_eq!(names(store, with("%")).await, ["100% sure_"]);
    assert_eq!(names(store, with(&"long ".repeat(100))).await, [""; 0]);
}

async fn what_is_found_follows_the_changes(store: &dyn Store) {
    let stream_key = key(Kind::Stream, "s");
    let edits = vec![(RecordId::settings(), settings("B")), (stream_key.clone(), stream("Before", 0))];
    save(store, "b", "op1", edits).await;
    save(store, "b", "op2", vec![(stream_key.clone(), stream("Afterwards", 0))]).await;
    assert_eq!(names(store, with("before")).await, [""; 0]);
    assert_eq!(names(store, with("after")).await, ["B"]);
    assert_eq!(store.remove(&id("b"), 5, "Ben").await, Ok(true));
    assert_eq!(names(store, with("after")).await, [""; 0]);
    assert_eq!(names(store, Query { words: "after".to_owned(), ..in_bin() }).await, ["B"]);
    assert_eq!(store.purge(6).await, Ok(1));
    assert_eq!(names(store, Query { words: "after".to_owned(), ..in_bin() }).await, [""; 0]);
}
