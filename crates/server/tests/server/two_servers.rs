//! Two servers on one store: what one of them made is no reason to refuse what has nothing to do with it.

use crate::house::{House, connector_id, id, map, plain, stream_id};
use behaviour::{Kind, Note, Place, Record, RecordId, Refusal};
use protocol::{Refused, request};
use shell::{Client, ClientError};
use std::sync::Arc;
use store::{MemoryStore, Store};

/// Changes that each of the two makes at the same time as the other.
const CHANGES: usize = 40;

async fn two() -> (House, House, Arc<dyn Store>) {
    let store: Arc<dyn Store> = Arc::new(MemoryStore::default());
    (House::on(Arc::clone(&store)).await, House::on(Arc::clone(&store)).await, store)
}

fn note(text: &str) -> Option<Record> {
    Some(Record::Note(Note::new(text.to_owned())))
}

fn note_id(text: &str) -> RecordId {
    RecordId::new(Kind::Note, &id(text))
}

#[tokio::test]
async fn only_what_touches_the_same_records_is_stale() {
    let (one, other, _) = two().await;
    let (aiko, play) = one.maker("Aiko").await;
    aiko.put("Add", stream_id("a"), Some(plain("One"))).await.unwrap();
    let ben = other.person("Ben").await;
    ben.load(&play).await.unwrap();
    aiko.put("Note", note_id("aikos"), note("mine")).await.unwrap();
    aiko.put("Rename", stream_id("a"), Some(plain("Two"))).await.unwrap();
    ben.put("Note", note_id("bens"), note("mine too")).await.expect("nobody touched that note");
    assert_eq!(ben.open().unwrap().revision, 5, "he has hers too");
    aiko.put("Rename", stream_id("a"), Some(plain("Three"))).await.expect("she follows him the same way");
    let late = ben.put("Rename", stream_id("a"), Some(plain("Four"))).await;
    assert_eq!(late, Err(ClientError::No(Refused::Change(Refusal::Stale("“Three”".into())))));
    let taken = ben.put("Add", stream_id("b"), Some(plain("Three"))).await;
    assert_eq!(taken, Err(ClientError::No(Refused::Change(Refusal::NameTaken("Three".into())))));
    aiko.put("Remove", stream_id("a"), None).await.unwrap();
    let gone = ben.put("Connect", connector_id("c"), Some(map("a", "a", "a"))).await;
    assert!(gone.is_err(), "the rules are asked again too: {gone:?}");
    one.close().await;
    other.close().await;
}

#[tokio::test]
async fn a_step_back_goes_on_after_what_another_server_made() {
    let (one, other, _) = two().await;
    let (aiko, play) = one.maker("Aiko").await;
    let ben = other.person("Ben").await;
    ben.load(&play).await.unwrap();
    ben.put("Add", stream_id("b"), Some(plain("Mine"))).await.unwrap();
    aiko.put("Note", note_id("n"), note("hers")).await.unwrap();
    let undone = ben.ask(crate::history::take_back(&play, "undo", false)).await.unwrap();
    assert_eq!(undone.revision, 4);
    one.close().await;
    other.close().await;
}

/// Each moves and notes what is their own, many at once, so that some are saved together.
async fn write(client: Arc<Client>, name: &'static str) {
    let play = client.open().unwrap().behaviour;
    let start = client.open().unwrap().records;
    let mut asks = Vec::new();
    for at in 0..CHANGES {
        let (key, place) = (note_id(&format!("{name}{at}")), RecordId::new(Kind::Place, &id(&format!("{name}{at}"))));
        let moved = Record::Place(Place { x: at as f64, y: 0.0 });
        let change = client.change("Note", &start, vec![(key, note(name)), (place, Some(moved))]);
        let (client, behaviour) = (Arc::clone(&client), play.clone());
        asks.push(tokio::spawn(
            async move { client.ask(request::Propose { behaviour, change, tokens: Vec::new() }).await },
        ));
    }
    for ask in asks {
        let answer = ask.await.unwrap();
        assert!(answer.is_ok(), "{name}: {answer:?}");
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn independent_notes_of_two_servers_are_all_kept() {
    let (one, other, store) = two().await;
    let (aiko, play) = one.maker("Aiko").await;
    let ben = other.person("Ben").await;
    ben.load(&play).await.unwrap();
    let both = [(Arc::new(aiko), "aiko"), (Arc::new(ben), "ben")];
    let writing = both.map(|(client, name)| tokio::spawn(write(client, name)));
    for ended in writing {
        ended.await.unwrap();
    }
    let kept = store.load(&play).await.unwrap().unwrap();
    assert_eq!((kept.revision, kept.behaviour.records.len()), (1 + 2 * CHANGES as u64, 1 + 4 * CHANGES));
    one.close().await;
    other.close().await;
}
