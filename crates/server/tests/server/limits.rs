//! Nobody can lock everybody out: what people make has bounds, and what is beyond them already still opens.

use crate::house::{House, ball, connect, connector_id, id, plain, sentence, stream_id};
use crate::http::{asked, exported, post};
use crate::links::socket;
use behaviour::{
    Accepted, BEHAVIOUR_MAX_BYTES, Behaviour, Change, Helper, Id, Kind, LIBRARY_MAX_BYTES, Note, Procedure, Record,
    RecordId, Refusal, Settings, connectors, record_bytes,
};
use futures_util::{SinkExt, StreamExt};
use protocol::{AnyAnswer, Event, LIBRARY, Message as Told, PART_MAX_BYTES, Refused, answer, request};
use shell::ClientError;
use std::sync::Arc;
use store::{MemoryStore, Store};
use tokio_tungstenite::tungstenite::Message;

fn key(kind: Kind, at: usize) -> RecordId {
    RecordId::new(kind, &id(&format!("x{at}")))
}

fn note(text: &str) -> Record {
    Record::Note(Note::new(text.to_owned()))
}

fn helper(at: usize, body: &str) -> Record {
    let (name, params) = (format!("big{at}"), vec!["v".to_owned()]);
    Record::Helper(Helper { name, params, body: body.to_owned(), ..Helper::default() })
}

/// A body that can run and has so many bytes.
fn body(bytes: usize) -> String {
    format!("v /*{}*/", "x".repeat(bytes - 6))
}

/// Keeps a behaviour as an older server may have left it.
async fn keep(store: &MemoryStore, behaviour: &Id, records: Vec<(RecordId, Record)>) {
    let mut after = Behaviour::default();
    for (revision, part) in (1..).zip(records.chunks(1_000)) {
        let mut change = Change::of(id(&format!("{behaviour}-{revision}")), "Old", "Add");
        change.edits = part.iter().map(|(id, record)| edit(id, record)).collect();
        after.apply(&change);
        store.append(behaviour, &Accepted { revision, change }, &after).await.unwrap();
    }
}

fn edit(id: &RecordId, record: &Record) -> behaviour::Edit {
    behaviour::Edit { id: id.clone(), before: None, after: Some(record.clone()) }
}

/// A library of 3 MB and a behaviour of 7 MB, as they could be made before there were bounds.
pub(crate) async fn too_large() -> House {
    let store = MemoryStore::default();
    let helpers = (0..1_100).map(|at| (key(Kind::Helper, at), helper(at, &body(3_000))));
    keep(&store, &id(LIBRARY), helpers.collect()).await;
    let settings = (RecordId::settings(), Record::Settings(Settings::named("Play")));
    let notes = (0..1_800).map(|at| (key(Kind::Note, at), note(&"n".repeat(4_000))));
    keep(&store, &id("play"), std::iter::once(settings).chain(notes).collect()).await;
    House::on(Arc::new(store)).await
}

#[tokio::test]
async fn what_is_too_large_already_opens_for_everyone_and_can_be_made_smaller() {
    let house = too_large().await;
    let (aiko, ben) = (house.person("Aiko").await, house.person("Ben").await);
    assert_eq!(aiko.library().records.records.len(), 1_100);
    let play = ben.load(&id("play")).await.unwrap();
    assert_eq!(play.records.records.len(), 1_801);
    let library = aiko.library().records;
    let change = aiko.change("Add", &library, vec![(key(Kind::Helper, 9_999), Some(helper(9_999, "v")))]);
    let no = sentence(aiko.ask(request::Propose { behaviour: id(LIBRARY), change, tokens: Vec::new() }).await);
    assert!(no.contains("1000 helpers"), "{no}");
    let no = sentence(ben.put("Add", stream_id("s"), Some(plain("S"))).await);
    assert!(no.contains("6 MB"), "{no}");
    ben.put("Shorten", key(Kind::Note, 3), Some(note("short"))).await.unwrap();
    let fewer = (0..100).map(|at| (key(Kind::Helper, at), None)).collect();
    let change = aiko.change("Remove", &library, fewer);
    // What is removed is told with what it was, in one message: so many bytes at once are too many for a socket.
    assert!(serde_json::to_string(&change).unwrap().len() > protocol::MESSAGE_MAX_BYTES);
    let change = aiko.change("Remove", &library, vec![(key(Kind::Helper, 7), None)]);
    aiko.ask(request::Propose { behaviour: id(LIBRARY), change, tokens: Vec::new() }).await.unwrap();
    assert_eq!(aiko.library().records.records.len(), 1_099);
    house.close().await;
}

#[tokio::test]
async fn no_message_of_a_large_behaviour_is_large() {
    let house = too_large().await;
    let mut socket = socket(&house).await;
    let hello = format!(r#"{{"ask":1,"request":{{"is":"hello","version":{},"name":"A"}}}}"#, protocol::VERSION);
    socket.send(Message::text(hello)).await.unwrap();
    socket.send(Message::text(r#"{"ask":2,"request":{"is":"open","behaviour":"play"}}"#)).await.unwrap();
    let (mut parts, mut done) = (Vec::new(), 0);
    while done < 2 {
        let Message::Text(text) = socket.next().await.unwrap().unwrap() else { continue };
        match serde_json::from_str::<Told>(&text).unwrap() {
            Told::Answer {
                answer:
                    AnyAnswer::Welcome(answer::Welcome { library: records, more, .. })
                    | AnyAnswer::Opened(answer::Opened { records, more, .. }),
                ..
            } => {
                assert!(more && !records.records.is_empty());
                parts.push((0, text.len()));
            }
            Told::Records { part, more, .. } => {
                assert_eq!(part, parts.last().unwrap().0 + 1);
                parts.push((part, text.len()));
                done += usize::from(!more);
            }
            Told::Event(Event::Accepted { .. }) => panic!("nothing comes in between"),
            _ => {}
        }
    }
    let largest = parts.iter().map(|(_, length)| *length).max().unwrap();
    assert!(parts.len() > 70 && largest <= PART_MAX_BYTES + 64 * 1024, "{} parts, {largest}", parts.len());
    house.close().await;
}

#[tokio::test]
async fn a_change_while_somebody_is_still_told_the_whole_is_not_lost() {
    let house = too_large().await;
    let aiko = house.person("Aiko").await;
    aiko.load(&id("play")).await.unwrap();
    let ben = house.person("Ben").await;
    let writing = async {
        for at in 0..20 {
            aiko.put("Shorten", key(Kind::Note, at), Some(note("short"))).await.unwrap();
        }
    };
    let play = id("play");
    let (loaded, ()) = tokio::join!(ben.load(&play), writing);
    loaded.unwrap();
    let now = aiko.open().unwrap();
    let last = (key(Kind::Note, 50), Some(note("the last")));
    let (change, behaviour) = (aiko.change("Shorten", &now.records, vec![last]), id("play"));
    ben.ask(request::Propose { behaviour, change, tokens: Vec::new() }).await.unwrap();
    assert_eq!(ben.open(), aiko_when(&aiko, now.revision + 1).await);
    house.close().await;
}

/// What somebody has open once it has this revision.
async fn aiko_when(client: &shell::Client, revision: u64) -> Option<shell::Mirror> {
    for _ in 0..1_000 {
        if client.open().is_some_and(|open| open.revision == revision) {
            return client.open();
        }
        tokio::time::sleep(std::time::Duration::from_millis(10)).await;
    }
    panic!("revision {revision} was not told")
}

#[tokio::test]
async fn large_changes_that_were_missed_come_in_pages() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    for at in 0..60 {
        let notes = (0..10).map(|one| (key(Kind::Note, at * 10 + one), Some(note(&"n".repeat(4_000)))));
        let change = aiko.change("Add", &aiko.open().unwrap().records, notes.collect());
        while aiko.ask(request::Propose { behaviour: play.clone(), change: change.clone(), tokens: Vec::new() }).await
            == Err(ClientError::No(Refused::TooFast))
        {
            tokio::time::sleep(std::time::Duration::from_millis(50)).await;
        }
    }
    let (mut known, mut pages, mut records) = (0, 0, Behaviour::default());
    loop {
        let since = request::Since { behaviour: play.clone(), revision: known };
        let missed = aiko.ask(since).await.unwrap();
        let bytes = serde_json::to_string(&AnyAnswer::from(missed.clone())).unwrap().len();
        let answer::Newer::Missed(answer::Missed { changes, more, .. }) = missed else { panic!() };
        assert!(!changes.is_empty() && bytes < 192 * 1024, "{bytes}");
        for accepted in changes {
            known += 1;
            assert_eq!(accepted.revision, known);
            records.apply(&accepted.change);
        }
        pages += 1;
        if !more {
            break;
        }
    }
    assert!(pages > 10, "{pages}");
    assert_eq!(records, aiko.open().unwrap().records);
    house.close().await;
}

#[tokio::test]
async fn names_that_hide_something_are_refused_wherever_one_is_given() {
    let house = House::open().await;
    let (aiko, _) = house.maker("Ai\u{202e}ko").await;
    assert_eq!(aiko.you().name, "Aiko");
    let create = request::Create { behaviour: id("hidden"), name: "Pl\u{200b}ay".into(), template: None };
    let unseen = ClientError::No(Refused::Change(Refusal::Unseen("Play".into())));
    assert_eq!(aiko.ask(create).await.unwrap_err(), unseen);
    assert_eq!(aiko.put("Add", stream_id("s"), Some(plain("Pl\u{2067}ay"))).await.unwrap_err(), unseen);
    let robot = request::AddRobot { robot: id("r"), name: "NAO\u{202e}".into(), real: None };
    assert!(sentence(aiko.ask(robot).await).contains("all of which are seen"));
    house.close().await;
}

/// A behaviour and a library as large as the rules allow; each helper is used.
async fn as_large_as_may_be() -> (MemoryStore, House) {
    let (store, mut helpers, mut bytes) = (MemoryStore::default(), Vec::new(), 0);
    while bytes < LIBRARY_MAX_BYTES - 9_000 {
        let helper = (key(Kind::Helper, helpers.len()), helper(helpers.len(), &body(8_000)));
        bytes += record_bytes(&helper.0, &helper.1);
        helpers.push(helper);
    }
    let settings = (RecordId::settings(), Record::Settings(Settings::named("Play")));
    let mut records = vec![settings, (stream_id("ball"), ball("Ball"))];
    for at in 0..helpers.len() {
        let by = connectors::map::SPEC.with(Procedure::Helper(format!("big{at}")));
        records.push((stream_id(&format!("s{at}")), plain(&format!("S{at}"))));
        records.push((connector_id(&format!("c{at}")), connect(by, &["ball"], &format!("s{at}"))));
    }
    let mut bytes: usize = records.iter().map(|(id, record)| record_bytes(id, record)).sum();
    for at in 0.. {
        let note = (key(Kind::Note, at), note(&"n".repeat(4_000)));
        bytes += record_bytes(&note.0, &note.1);
        if bytes > BEHAVIOUR_MAX_BYTES {
            break;
        }
        records.push(note);
    }
    keep(&store, &id(LIBRARY), helpers).await;
    keep(&store, &id("play"), records).await;
    let house = House::on(Arc::new(store.clone())).await;
    (store, house)
}

#[tokio::test]
async fn the_largest_that_is_allowed_is_exported_imported_and_restored() {
    let (store, house) = as_large_as_may_be().await;
    let other = House::open().await;
    let file = exported(&house, "play", "json").await;
    assert!(file.len() > 7 << 20, "{} bytes", file.len());
    let (mut status, mut answer) = asked(&other, &post(&other, "/api/import", &file)).await;
    // What a busy computer has no time for it asks to send again.
    for _ in 0..10 {
        if !answer.contains("takes too long; try again") {
            break;
        }
        (status, answer) = asked(&other, &post(&other, "/api/import", &file)).await;
    }
    assert_eq!(status, "200", "{answer}");
    let aiko = house.person("Aiko").await;
    let play = aiko.load(&id("play")).await.unwrap();
    assert_eq!(sentence(aiko.put("Add", key(Kind::Note, 9_999), Some(note(&"n".repeat(4_000)))).await), {
        Refusal::Full("program".into(), BEHAVIOUR_MAX_BYTES).to_string()
    });
    let lines = std::sync::Mutex::new(String::new());
    let put = |line: String| {
        lines.lock().unwrap().push_str(&line);
        std::future::ready(Ok(()))
    };
    store::backup::backup(&store, 1, &[], put, &|_, _| {}).await.unwrap();
    let empty: Arc<dyn Store> = Arc::new(MemoryStore::default());
    let text = std::io::Cursor::new(lines.into_inner().unwrap());
    let backup = store::backup::read(text, &*empty).await.unwrap();
    let filling = store::Filling::begin(&empty, &backup.source("rrp restore")).await.unwrap();
    store::backup::restore(backup, &filling, &|_, _| {}).await.unwrap();
    filling.end().await.unwrap();
    let restored = empty.load(&id("play")).await.unwrap().unwrap();
    assert_eq!(restored.behaviour, play.records);
    for house in [house, other] {
        house.close().await;
    }
}
