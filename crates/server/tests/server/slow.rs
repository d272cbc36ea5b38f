//! Slow stores and slow readers: they slow nobody else, and never Stop.

use crate::house::{House, make, plain, stream_id};
use crate::http::raw;
use crate::links::socket;
use async_trait::async_trait;
use behaviour::{Behaviour, Checkpoint, Committed, Id, Kind, Note, Record, RecordId};
use futures_util::{SinkExt, StreamExt};
use protocol::{Event, request};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use store::{
    ActionDriver, Append, Contested, FillingSource, HelperUse, Listing, Loaded, MemoryStore, Query, Similar, Store,
    StoreError,
};
use tokio_tungstenite::tungstenite::Message;

/// How often others get their turn while something is looked up in a history.
const LOOK_TURNS: usize = 200;

/// People are answered within 3 s; the rest is for a busy machine. Before, one call was tried twice, and then the next one.
const ANSWERED_MAX: Duration = Duration::from_millis(4_900);

/// A store that can be made to hang.
#[derive(Default)]
pub(crate) struct Hanging {
    inside: MemoryStore,
    hangs: AtomicBool,
    /// A behaviour that cannot be loaded yet.
    holds: Mutex<Option<Id>>,
    /// Lookups in a history that are under way, and the most that ever were.
    looking: AtomicUsize,
    pub(crate) looked_most: AtomicUsize,
}

impl Hanging {
    async fn wait(&self) {
        while self.hangs.load(Ordering::SeqCst) {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }
}

#[async_trait]
impl Store for Hanging {
    async fn append(&self, behaviour: &Id, committed: &Committed, after: &Behaviour) -> Result<Append, StoreError> {
        self.wait().await;
        self.inside.append(behaviour, committed, after).await
    }
    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError> {
        self.wait().await;
        while self.holds.lock().unwrap().as_ref() == Some(behaviour) {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        self.inside.load(behaviour).await
    }
    async fn list(&self, query: &Query) -> Result<Listing, StoreError> {
        self.inside.list(query).await
    }

    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError> {
        let looking = self.looking.fetch_add(1, Ordering::SeqCst) + 1;
        self.looked_most.fetch_max(looking, Ordering::SeqCst);
        // Whatever may go on meanwhile does.
        for _ in 0..LOOK_TURNS {
            tokio::task::yield_now().await;
        }
        self.wait().await;
        self.looking.fetch_sub(1, Ordering::SeqCst);
        self.inside.history(behaviour, since, most).await
    }
    async fn checkpoints(&self, behaviour: &Id) -> Result<Vec<Checkpoint>, StoreError> {
        self.inside.checkpoints(behaviour).await
    }
    async fn keep_checkpoint(&self, behaviour: &Id, checkpoint: &Checkpoint) -> Result<bool, StoreError> {
        self.wait().await;
        self.inside.keep_checkpoint(behaviour, checkpoint).await
    }
    async fn drop_checkpoint(&self, behaviour: &Id, name: &str) -> Result<(), StoreError> {
        self.wait().await;
        self.inside.drop_checkpoint(behaviour, name).await
    }
    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        self.inside.remove(behaviour, now_ms, by).await
    }
    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        self.inside.restore(behaviour).await
    }
    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        self.inside.purge(removed_before_ms).await
    }
    async fn users(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
        self.inside.users(helper).await
    }

    async fn drivers(&self, actuator: &str) -> Result<Vec<ActionDriver>, StoreError> {
        self.inside.drivers(actuator).await
    }

    async fn contested(&self) -> Result<Vec<Contested>, StoreError> {
        self.inside.contested().await
    }

    async fn similar(&self, behaviour: &Id, most: u32) -> Result<Vec<Similar>, StoreError> {
        self.inside.similar(behaviour, most).await
    }

    async fn raise_epoch(&self, least: u64) -> Result<(), StoreError> {
        self.inside.raise_epoch(least).await
    }
    async fn next_epoch(&self) -> Result<u64, StoreError> {
        self.inside.next_epoch().await
    }
    async fn filling(&self) -> Result<Option<FillingSource>, StoreError> {
        self.inside.filling().await
    }
    async fn begin_filling(&self, source: &FillingSource) -> Result<FillingSource, StoreError> {
        self.inside.begin_filling(source).await
    }
    async fn end_filling(&self) -> Result<(), StoreError> {
        self.inside.end_filling().await
    }
    async fn healthy(&self) -> Result<(), StoreError> {
        self.wait().await;
        Ok(())
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn stop_and_greetings_work_while_the_store_hangs_and_the_edit_is_saved_after() {
    let store = Arc::new(Hanging::default());
    let house = House::on(store.clone()).await;
    let (aiko, play) = house.maker("Aiko").await;
    store.hangs.store(true, Ordering::SeqCst);
    let mut ben = house.person("Ben").await;
    let editing = tokio::spawn(async move {
        let answer = aiko.put("Add", stream_id("a"), Some(plain("One"))).await;
        (aiko, answer)
    });
    tokio::time::sleep(Duration::from_millis(100)).await;
    ben.load(&play).await.expect("an open room lets people in while it saves");
    let start = Instant::now();
    let stop =
        format!("POST /stop HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Length: 0\r\n\r\n", house.address);
    assert!(raw(&house, &stop).await.contains("\"stopped\":true"));
    assert!(ben.ask(request::Stop { behaviour: None, robot: None }).await.is_ok());
    assert!(start.elapsed() < Duration::from_secs(4), "Stop waited for the store: {:?}", start.elapsed());
    store.hangs.store(false, Ordering::SeqCst);
    let (aiko, answer) = editing.await.unwrap();
    assert!(answer.is_ok(), "{answer:?}");
    ben.until(|reply| matches!(reply, Event::Accepted { .. })).await.unwrap();
    assert_eq!(aiko.open(), ben.open());
    house.close().await;
}

/// Who opens another program while one is still being loaded is told of the other one, also when the first comes late.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_program_that_opens_late_does_not_take_the_place_of_the_one_that_is_wanted() {
    let store = Arc::new(Hanging::default());
    let house = House::on(store.clone()).await;
    let aiko = house.person("Aiko").await;
    let [late, wanted] = [make(&aiko, "Late", None).await, make(&aiko, "Wanted", None).await];
    *store.holds.lock().unwrap() = Some(late.clone());
    let mut link = socket(&house).await;
    let version = protocol::VERSION;
    let asks = [
        format!(r#"{{"ask":1,"request":{{"is":"hello","version":{version},"client":"ben","name":"Ben"}}}}"#),
        format!(r#"{{"ask":2,"request":{{"is":"open","behaviour":"{late}"}}}}"#),
        format!(r#"{{"ask":3,"request":{{"is":"open","behaviour":"{wanted}"}}}}"#),
    ];
    for ask in asks {
        link.send(Message::text(ask)).await.unwrap();
    }
    let opened = |of: &Id| format!(r#""opened":{{"behaviour":"{of}""#);
    until(&mut link, &opened(&wanted)).await;
    *store.holds.lock().unwrap() = None;
    until(&mut link, &opened(&late)).await;
    let ping = until(&mut link, r#""ping""#).await;
    assert!(ping.contains(wanted.as_str()) && !ping.contains(late.as_str()), "{ping}");
    house.close().await;
}

/// The next message with these characters in it.
async fn until(link: &mut crate::links::Socket, wanted: &str) -> String {
    loop {
        let text = link.next().await.unwrap().unwrap().into_text().unwrap_or_default();
        if text.contains(wanted) {
            return text.to_string();
        }
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_edit_that_hung_too_long_is_refused_and_the_room_recovers() {
    let store = Arc::new(Hanging::default());
    let house = House::on(store.clone()).await;
    let (aiko, play) = house.maker("Aiko").await;
    store.hangs.store(true, Ordering::SeqCst);
    let start = Instant::now();
    let note = || Some(Record::Note(Note::new("mine".into())));
    let key = |name: &str| RecordId::new(Kind::Note, &crate::house::id(name));
    // Each of its own kind: alone, together with others, of the past, and a new program.
    let (stream, one, two) = (
        aiko.put("Add", stream_id("a"), Some(plain("One"))),
        aiko.put("Note", key("n1"), note()),
        aiko.put("Note", key("n2"), note()),
    );
    let undo = crate::history::take_back(&play, "undo", false);
    let create = request::Create { behaviour: crate::house::id("new"), name: "New".into(), template: None };
    let (stream, one, two, undo, new) = tokio::join!(stream, one, two, aiko.ask(undo), aiko.ask(create));
    for answer in [stream.map(drop), one.map(drop), two.map(drop), undo.map(drop), new.map(drop)] {
        assert!(matches!(&answer, Err(shell::ClientError::No(protocol::Refused::Store(_)))), "{answer:?}");
    }
    assert!(start.elapsed() < ANSWERED_MAX, "it took {:?}", start.elapsed());
    let mut aiko = aiko;
    aiko.until(|reply| matches!(reply, Event::Store { away: Some(_) })).await.unwrap();
    let answer = aiko.put("Add", stream_id("b"), Some(plain("Two"))).await;
    assert!(matches!(&answer, Err(shell::ClientError::No(protocol::Refused::Store(_)))), "{answer:?}");
    store.hangs.store(false, Ordering::SeqCst);
    aiko.until(|reply| matches!(reply, Event::Store { away: None })).await.unwrap();
    aiko.put("Add", stream_id("b"), Some(plain("Two"))).await.unwrap();
    house.close().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_slow_reader_is_cut_off_and_slows_nobody() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut slow = socket(&house).await;
    slow.send(Message::text(format!(
        r#"{{"ask":1,"request":{{"is":"hello","version":{},"client":"slow","name":"Slow"}}}}"#,
        protocol::VERSION
    )))
    .await
    .unwrap();
    slow.send(Message::text(format!(r#"{{"ask":2,"request":{{"is":"open","behaviour":"{play}"}}}}"#))).await.unwrap();
    let mut ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    let mut writers = vec![aiko];
    for number in 0..7 {
        let writer = house.person(&format!("Writer {number}")).await;
        writer.load(&play).await.unwrap();
        writers.push(writer);
    }
    for at in 0..1_500_usize {
        let writer = &writers[at % writers.len()];
        // Everyone edits notes of their own, which their mirror knows for certain.
        let records = writer.open().expect("it is open").records;
        let change = writer.change("Note", &records, big(at % writers.len(), at));
        let answer = writer.ask(request::Propose { behaviour: play.clone(), change, tokens: Vec::new() }).await;
        assert!(answer.is_ok(), "{at}: {answer:?}");
    }
    let last = |reply: &Event| matches!(reply, Event::Accepted { accepted, .. } if accepted.revision == 1_501);
    ben.until(last).await.unwrap();
    assert_eq!(cut_off(slow).await, Some(1013));
    house.close().await;
}

/// Five long notes of one writer.
fn big(writer: usize, at: usize) -> Vec<(RecordId, Option<Record>)> {
    let id = |part: usize| RecordId::new(Kind::Note, &crate::house::id(&format!("n{writer}-{part}")));
    let note = Record::Note(Note::new(format!("{at} {}", "x".repeat(3_900))));
    (0..5).map(|part| (id(part), Some(note.clone()))).collect()
}

/// Reads what is left and answers with the code of the end; a link that was simply cut says nothing.
async fn cut_off(mut slow: crate::links::Socket) -> Option<u16> {
    let end = async {
        while let Some(message) = slow.next().await {
            match message {
                Ok(Message::Close(frame)) => return frame.map(|frame| frame.code.into()),
                Ok(_) => {}
                Err(_) => return Some(1013),
            }
        }
        Some(1013)
    };
    tokio::time::timeout(Duration::from_secs(10), end).await.expect("it was cut off")
}
