//! One change after the other: saved once, in order, and read back as it was.

use super::samples::{
    append, change, every_connector, group, id, in_bin, key, note, now, pad, save, settings, stream, try_append,
    two_streams,
};
use crate::{Append, Listing, Query, Store, StoreError};
use behaviour::{Change, Committed, Kind, Note, Place, Record, RecordId, Settings};
use std::future::Future;
use std::sync::Arc;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    nothing_is_there_at_first(make().await.as_ref()).await;
    a_change_sent_twice_is_saved_once(make().await.as_ref()).await;
    an_op_id_counts_in_its_behaviour_only(make().await.as_ref()).await;
    only_the_next_revision_is_saved(make().await.as_ref()).await;
    changes_that_follow_each_other_are_saved_together(make().await.as_ref()).await;
    two_streams_swap_their_names(make().await.as_ref()).await;
    every_script_is_kept(make().await.as_ref()).await;
    every_connector_is_kept(make().await.as_ref()).await;
    what_stands_around_the_graph_is_kept(make().await.as_ref()).await;
    what_would_not_read_back_is_refused(make().await.as_ref()).await;
    history_comes_in_pages(make().await.as_ref()).await;
    the_list_shows_the_newest_first(make().await.as_ref()).await;
}

async fn nothing_is_there_at_first(store: &dyn Store) {
    assert_eq!(store.load(&id("b")).await, Ok(None));
    assert_eq!(store.list(&Query::default()).await, Ok(Listing::default()));
    assert_eq!(store.list(&in_bin()).await, Ok(Listing::default()));
    assert_eq!(store.history(&id("b"), 0, 10).await, Ok(vec![]));
    assert_eq!(store.where_used("near").await, Ok(vec![]));
}

async fn a_change_sent_twice_is_saved_once(store: &dyn Store) {
    let first = change("op1", 5, vec![(RecordId::settings(), settings("One"))]);
    assert_eq!(append(store, "b", 1, first.clone()).await, Append::Applied);
    save(store, "b", "op2", vec![(key(Kind::Note, "n"), note("two"))]).await;
    let before = store.load(&id("b")).await;
    for revision in [1, 2, 3, 9] {
        assert_eq!(append(store, "b", revision, first.clone()).await, Append::Duplicate { revision: 1 });
    }
    let again = Change { author: "Ben".to_owned(), ..change("op2", 6, vec![(key(Kind::Note, "n"), note("two"))]) };
    assert_eq!(
        append(store, "b", 3, again.clone()).await,
        Append::Duplicate { revision: 2 },
        "who and when is not asked"
    );
    let other = change("op2", 6, vec![(RecordId::settings(), settings("Other"))]);
    let undo = Change { undoes: Some(id("op1")), ..again };
    for other in [other, undo, change("op2", 6, vec![])] {
        for revision in [0, 2, 3] {
            assert_eq!(
                append(store, "b", revision, other.clone()).await,
                Append::Reused { revision: 2 },
                "another change"
            );
        }
    }
    assert_eq!(store.load(&id("b")).await, before);
    assert_eq!(store.history(&id("b"), 0, 10).await.expect("history").len(), 2);
}

async fn an_op_id_counts_in_its_behaviour_only(store: &dyn Store) {
    for behaviour in ["a", "b"] {
        save(store, behaviour, "op", vec![(RecordId::settings(), settings(behaviour))]).await;
    }
    assert_eq!(store.list(&Query::default()).await.expect("a page").total, 2);
}

async fn only_the_next_revision_is_saved(store: &dyn Store) {
    let named = |op: &str| change(op, 1, vec![(RecordId::settings(), settings(op))]);
    for revision in [0, 2, u64::MAX] {
        assert_eq!(append(store, "b", revision, named("early")).await, Append::Conflict { head: 0 });
    }
    assert_eq!(store.load(&id("b")).await, Ok(None), "a conflict creates nothing");
    save(store, "b", "one", vec![(RecordId::settings(), settings("one"))]).await;
    save(store, "b", "two", vec![(RecordId::settings(), settings("two"))]).await;
    for revision in [0, 1, 2, 4, u64::MAX] {
        assert_eq!(append(store, "b", revision, named("stale")).await, Append::Conflict { head: 2 });
    }
    let loaded = store.load(&id("b")).await.expect("an answer").expect("a behaviour");
    assert_eq!((loaded.revision, loaded.behaviour.name()), (2, "two"));
    assert_eq!(append(store, "b", 3, named("stale")).await, Append::Applied, "a refused op id is not used up");
}

async fn changes_that_follow_each_other_are_saved_together(store: &dyn Store) {
    save(store, "b", "one", vec![(RecordId::settings(), settings("One"))]).await;
    let mut after = now(store, "b").await;
    let mut follow = |op: &str, revision, edits| {
        let committed = Committed { revision, change: change(op, 7, edits) };
        after.apply(&committed.change);
        (committed, after.clone())
    };
    let renamed = follow("two", 2, vec![(RecordId::settings(), settings("Two"))]);
    let noted = follow("three", 3, vec![(key(Kind::Note, "n"), note("three"))]);
    let again = (Committed { revision: 4, ..renamed.0.clone() }, renamed.1.clone());
    let never = follow("five", 5, vec![(key(Kind::Note, "n"), note("five"))]);
    let all = [renamed, noted.clone(), again, never.clone()];
    let answers = vec![Append::Applied, Append::Applied, Append::Duplicate { revision: 2 }];
    assert_eq!(store.append_all(&id("b"), &all).await, Ok(answers));
    let loaded = store.load(&id("b")).await.expect("an answer").expect("a behaviour");
    assert_eq!((loaded.revision, &loaded.behaviour), (3, &noted.1));
    let listed = store.list(&Query::default()).await.expect("a page");
    assert_eq!(listed.lines.first().map(|line| line.name.as_str()), Some("Two"));
    assert_eq!(store.history(&id("b"), 0, 10).await.expect("history").len(), 3);
    assert_eq!(store.append_all(&id("b"), &[never]).await, Ok(vec![Append::Conflict { head: 3 }]));
    assert_eq!(store.append_all(&id("b"), &[]).await, Ok(vec![]));
    store.remove(&id("b"), 1, "Aiko").await.expect("an answer");
    let late = follow("late", 4, vec![(key(Kind::Note, "n"), note("late"))]);
    assert_eq!(store.append_all(&id("b"), &[late]).await, Err(StoreError::Gone));
}

async fn two_streams_swap_their_names(store: &dyn Store) {
    let (s0, s1) = (key(Kind::Stream, "s0"), key(Kind::Stream, "s1"));
    save(store, "b", "one", vec![(s0.clone(), stream("Left", 0)), (s1.clone(), stream("Right", 1))]).await;
    let start = store.load(&id("b")).await.expect("an answer").expect("a behaviour").behaviour;
    let swap = Change::of(id("swap"), "Ben", "Swap");
    let swap = swap.put(&start, s0.clone(), stream("Right", 0)).put(&start, s1, stream("Left", 1));
    assert_eq!(append(store, "b", 2, swap.clone()).await, Append::Applied);
    let swapped = store.load(&id("b")).await.expect("an answer").expect("a behaviour").behaviour;
    assert_eq!(swapped.records[&s0], stream("Right", 0));
    assert_eq!(append(store, "b", 3, swap.swapped(id("undo"), "Undo")).await, Append::Applied);
    assert_eq!(store.load(&id("b")).await.expect("an answer").expect("a behaviour").behaviour, start);
}

async fn every_script_is_kept(store: &dyn Store) {
    let names = [
        "赤いボール",
        "כדור אדום",
        "الكرة الحمراء",
        "👩‍🔬 e\u{301}",
        "'; DROP TABLE op; --",
        "a\u{0}b\u{202e}\"\\\n",
        "",
    ];
    for (number, name) in names.iter().enumerate() {
        let edits = vec![(RecordId::settings(), settings(name)), (key(Kind::Stream, "s"), stream(name, 0))];
        let made = Change { author: (*name).to_owned(), label: (*name).into(), ..change("op", 1, edits) };
        let behaviour = format!("b{number}");
        assert_eq!(append(store, &behaviour, 1, made.clone()).await, Append::Applied, "{name:?}");
        let loaded = store.load(&id(&behaviour)).await.expect("an answer").expect("a behaviour");
        assert_eq!(loaded.behaviour.name(), *name);
        let history = store.history(&id(&behaviour), 0, 1).await;
        assert_eq!(history, Ok(vec![Committed { revision: 1, change: made }]));
    }
    let listed = store.list(&Query::default()).await.expect("a page").lines;
    let listed: Vec<_> = listed.into_iter().rev().collect();
    assert_eq!(listed.iter().map(|line| line.name.as_str()).collect::<Vec<_>>(), names);
    assert_eq!(listed.iter().map(|line| line.by.as_str()).collect::<Vec<_>>(), names);
}

async fn every_connector_is_kept(store: &dyn Store) {
    let edits = [two_streams(), every_connector()].concat();
    save(store, "b", "op1", edits.clone()).await;
    assert_eq!(now(store, "b").await.records, edits.clone().into_iter().collect());
    let made = store.history(&id("b"), 0, 1).await.expect("history");
    assert_eq!(made[0].change.edits.len(), edits.len());
    // Each of them becomes the next one, which may be kept in another form.
    let (keys, mut records): (Vec<_>, Vec<_>) = every_connector().into_iter().unzip();
    records.rotate_left(1);
    let turned: Vec<_> = keys.into_iter().zip(records).collect();
    let change = turned.iter().cloned().fold(Change::of(id("op2"), "Ben", "Turn"), {
        let before = now(store, "b").await;
        move |made, (key, record)| made.put(&before, key, record)
    });
    assert_eq!(append(store, "b", 2, change).await, Append::Applied);
    assert_eq!(now(store, "b").await.records, [two_streams(), turned].concat().into_iter().collect());
}

async fn what_stands_around_the_graph_is_kept(store: &dyn Store) {
    let begun = |exercise: Option<&str>| {
        Record::Settings(Settings { exercise: exercise.map(str::to_owned), ..Settings::named("Play") })
    };
    let signed = Note { text: "Look".to_owned(), by: "Aiko 赤".to_owned(), at_ms: 1_764_000_000_123 };
    let first = vec![
        (RecordId::settings(), begun(Some("Brighter when nearer"))),
        (key(Kind::Note, "n"), Record::Note(signed)),
        (key(Kind::Group, "g"), group("近くのボール", &["s0", "gone"])),
        (key(Kind::Group, "empty"), group("", &[])),
        (RecordId::pad(), pad("Well done")),
    ];
    save(store, "b", "op1", first.clone()).await;
    assert_eq!(now(store, "b").await.records, first.into_iter().collect());
    let then = vec![
        (RecordId::settings(), begun(None)),
        (key(Kind::Note, "n"), note("Look")),
        (key(Kind::Group, "g"), group("Near", &["s1"])),
    ];
    save(store, "b", "op2", then.clone()).await;
    let beside = [(key(Kind::Group, "empty"), group("", &[])), (RecordId::pad(), pad("Well done"))];
    assert_eq!(now(store, "b").await.records, then.clone().into_iter().chain(beside.clone()).collect());
    let found = store.list(&Query { words: "near".to_owned(), ..Query::default() }).await.expect("an answer");
    assert_eq!(found.total, 1, "a group is found by its title");
    let gone = change("op3", 3, Vec::new()).take(&now(store, "b").await, RecordId::pad());
    assert_eq!(append(store, "b", 3, gone).await, Append::Applied);
    let left = then.into_iter().chain(beside.into_iter().take(1));
    assert_eq!(now(store, "b").await.records, left.collect(), "a pad goes");
}

async fn what_would_not_read_back_is_refused(store: &dyn Store) {
    let nowhere = Record::Place(Place { x: f64::NAN, y: 0.0 });
    let bad = change("op", 1, vec![(RecordId::settings(), settings("B")), (key(Kind::Place, "p"), nowhere)]);
    let answer = try_append(store, "b", 1, bad).await;
    assert!(matches!(answer, Err(StoreError::Refused(_))), "{answer:?}");
    assert_eq!(store.load(&id("b")).await, Ok(None), "nothing is half saved");
}

async fn history_comes_in_pages(store: &dyn Store) {
    for number in 1..=5 {
        save(store, "b", &format!("op{number}"), vec![(key(Kind::Note, "n"), note(&number.to_string()))]).await;
    }
    for (since, most, wanted) in
        [(0, 2, vec![1, 2]), (2, 2, vec![3, 4]), (4, 9, vec![5]), (5, 9, vec![]), (u64::MAX, 9, vec![]), (0, 0, vec![])]
    {
        let page = store.history(&id("b"), since, most).await.expect("history");
        assert_eq!(page.iter().map(|made| made.revision).collect::<Vec<_>>(), wanted);
    }
}

async fn the_list_shows_the_newest_first(store: &dyn Store) {
    for (behaviour, at_ms) in [("a", 10), ("c", 30), ("b", 20), ("b2", 20)] {
        let edits = vec![(RecordId::settings(), settings(behaviour)), (key(Kind::Stream, "s"), stream("S", 0))];
        append(store, behaviour, 1, change("op", at_ms, edits)).await;
    }
    save(store, crate::LIBRARY, "op", vec![(key(Kind::Helper, "h"), super::samples::helper("near", "x < 1"))]).await;
    let start = store.load(&id("a")).await.expect("an answer").expect("a behaviour").behaviour;
    let take = Change { at_ms: 40, ..Change::of(id("take"), "Ben", "Remove S") };
    append(store, "a", 2, take.take(&start, key(Kind::Stream, "s"))).await;
    let listed = store.list(&Query::default()).await.expect("a page").lines;
    let lines: Vec<_> =
        listed.iter().map(|l| (l.id.as_str(), l.revision, l.changed_ms, l.by.as_str(), l.streams)).collect();
    let wanted = [("a", 2, 40, "Ben", 0), ("c", 1, 30, "Aiko", 1), ("b2", 1, 20, "Aiko", 1), ("b", 1, 20, "Aiko", 1)];
    assert_eq!(lines, wanted);
}
