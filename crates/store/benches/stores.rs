//! The costs of a library of ten thousand behaviours, on any store: a page of the list, a search, opening one, saving a
//! move. Prints one line a question with the middle and the slowest hundredth of its times.
//!
//! `cargo xtask bench stores` runs it on SQLite and on a real Neo4j. RRP_BENCH_STORE names another store's address instead,
//! RRP_BENCH_BEHAVIOURS another size.
#![expect(clippy::print_stdout, reason = "a benchmark speaks on standard output")]

#[expect(dead_code, reason = "a benchmark does not kill its server")]
#[path = "../../../tests/neo4j/server.rs"]
mod server;

use behaviour::{
    Behaviour, Change, Committed, Connector, Id, Kind, Parameters, Place, Procedure, Record, RecordId, Settings,
    Stream, StreamKind, connectors,
};
use std::sync::Arc;
use std::time::{Duration, Instant};
use store::{Append, Query, Sort, Store};

/// Streams of each behaviour.
const STREAMS: usize = 60;
/// Questions of each kind.
const TIMES: usize = 200;
/// Behaviours saved at the same time while filling.
const AT_ONCE: usize = 16;
/// The memory of a clinic's database server.
const OF_A_CLINIC: server::Room = server::Room { java: &["-Xmx3g"], page_cache: "2g" };

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

fn words(number: usize) -> [&'static str; 3] {
    const FIRST: [&str; 8] = ["Track", "Greet", "Point at", "Imitate", "Calm", "Count", "Sing with", "Answer"];
    const SECOND: [&str; 7] = ["red", "close", "far", "known", "new", "loud", "slow"];
    const THIRD: [&str; 9] = ["ball", "face", "voice", "hand", "person", "word", "colour", "song", "child"];
    [FIRST[number % 8], SECOND[number / 8 % 7], THIRD[number / 56 % 9]]
}

/// Chains of a sensor, ordinary streams and an actuator, with bodies that differ.
fn behaviour(number: usize) -> Behaviour {
    let mut made = Behaviour::default();
    let name = format!("{} {number}", words(number).join(" "));
    made.records.insert(RecordId::settings(), Record::Settings(Settings::named(&name)));
    for at in 0..STREAMS {
        let (kind, device) = match at % 6 {
            0 => (StreamKind::Sensor, Some(["RedBall", "FaceDetection", "HeadTouch"][number % 3])),
            5 => (StreamKind::Actuator, Some(["Tracker", "SayInput", "EyeLedColor"][number % 3])),
            _ => (StreamKind::Ordinary, None),
        };
        let stream = Stream {
            kind,
            name: format!("{} {at}", words(number + at)[2]),
            device: device.map(str::to_owned),
            params: Default::default(),
            order: at as i64,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        let key = id(&format!("s{number}-{at}"));
        made.records.insert(RecordId::new(Kind::Stream, &key), Record::Stream(stream));
        let place = Place { x: (at % 6) as f64 * 200.0, y: (at / 6) as f64 * 120.0 };
        made.records.insert(RecordId::new(Kind::Place, &key), Record::Place(place));
        if at % 6 != 0 {
            let connector = connector(number, at);
            made.records.insert(RecordId::new(Kind::Connector, &id(&format!("c{number}-{at}"))), connector);
        }
    }
    made
}

fn connector(number: usize, at: usize) -> Record {
    let operation = match at % 6 {
        5 => connectors::subscribe::SPEC.with(()),
        1 => connectors::map::SPEC.with(Procedure::body(&format!("value.x * {number}"))),
        2 => connectors::filter::SPEC.with(Procedure::body(&format!("value < {at}"))),
        3 => connectors::sample::SPEC.with(Parameters::period(100)),
        _ => connectors::timestamp::SPEC.with(()),
    };
    let [from, to] = [at - 1, at].map(|at| id(&format!("s{number}-{at}")));
    Record::Connector(Connector { operation, inputs: vec![from], output: to, order: at as i64 })
}

fn first(number: usize, made: &Behaviour) -> Committed {
    let start = Change { at_ms: number as u64, ..Change::of(id("op1"), "Aiko", "Add") };
    let put = |change: Change, (key, record): (&RecordId, &Record)| {
        change.put(&Behaviour::default(), key.clone(), record.clone())
    };
    Committed { revision: 1, change: made.records.iter().fold(start, put) }
}

async fn fill(store: &Arc<dyn Store>, many: usize) {
    let mut tasks = tokio::task::JoinSet::new();
    for number in 0..many {
        if tasks.len() >= AT_ONCE {
            tasks.join_next().await.expect("a task").expect("it ends well");
        }
        let store = Arc::clone(store);
        tasks.spawn(async move {
            let made = behaviour(number);
            let (name, first) = (id(&format!("b{number}")), first(number, &made));
            // A database that is still warming up may be too slow for its bound: sent again, the op id settles it.
            let answer = loop {
                match store.append(&name, &first, &made).await {
                    Err(error) if error.is_open() => {}
                    answer => break answer,
                }
            };
            assert!(matches!(answer, Ok(Append::Applied | Append::Duplicate { .. })), "{answer:?}");
        });
    }
    while let Some(task) = tasks.join_next().await {
        task.expect("it ends well");
    }
}

/// Asks many times, one after another, and prints how long the answers took.
async fn time<F: Future<Output = usize>>(what: &str, goal: &str, ask: impl Fn(usize) -> F) {
    let mut times = Vec::with_capacity(TIMES);
    let mut found = 0;
    for number in 0..TIMES {
        let start = Instant::now();
        found += ask(number).await;
        times.push(start.elapsed());
    }
    times.sort();
    let ms = |time: Duration| time.as_secs_f64() * 1_000.0;
    let (middle, slow) = (ms(times[TIMES / 2]), ms(times[TIMES * 99 / 100]));
    println!("{what:<28} p50 {middle:>8.2} ms   p99 {slow:>8.2} ms   goal p50 {goal:<9} found {found}");
}

async fn questions(store: &Arc<dyn Store>, many: usize) {
    let page = |query: Query| {
        let store = Arc::clone(store);
        async move { store.list(&query).await.expect("a page").lines.len() }
    };
    time("page of 50, newest", "2 / 10 ms", |_| page(Query { most: 50, ..Query::default() })).await;
    time("page of 50, by name", "2 / 10 ms", |_| page(Query { most: 50, sort: Sort::Name, ..Query::default() })).await;
    let word = |number: usize| format!("{} {}", words(number)[0], words(number)[2]);
    time("search, two words", "20 / 40 ms", |n| page(Query { most: 50, words: word(n), ..Query::default() })).await;
    let one = |number: usize| format!(" {}", number * 37 % many);
    time("search, a number", "20 / 40 ms", |n| page(Query { most: 50, words: one(n), ..Query::default() })).await;
    time("open one", "5 / 20 ms", |n| async move {
        let loaded = store.load(&id(&format!("b{}", n * 41 % many))).await.expect("an answer");
        loaded.expect("it is there").behaviour.records.len()
    })
    .await;
    time("move one stream, durably", "10 / 20 ms", |n| move_one(store, n * 43 % many, n)).await;
    time("similar behaviours", "-", |n| async move {
        store.similar(&id(&format!("b{}", n * 41 % many)), 10).await.expect("an answer").len()
    })
    .await;
}

async fn move_one(store: &Arc<dyn Store>, number: usize, step: usize) -> usize {
    let mut after = behaviour(number);
    let key = RecordId::new(Kind::Place, &id(&format!("s{number}-7")));
    let change = Change { at_ms: 1_000_000, ..Change::of(id(&format!("move{step}")), "Ben", "Move") };
    let change = change.put(&after, key, Record::Place(Place { x: step as f64, y: 1.0 }));
    after.apply(&change);
    let answer = store.append(&id(&format!("b{number}")), &Committed { revision: 2, change }, &after).await;
    usize::from(answer.expect("an answer") == Append::Applied)
}

#[tokio::main]
async fn main() {
    let many = std::env::var("RRP_BENCH_BEHAVIOURS").ok().and_then(|text| text.parse().ok()).unwrap_or(10_000);
    if let Ok(url) = std::env::var("RRP_BENCH_STORE") {
        return measure("the store named", &url, many).await;
    }
    let folder = tempfile::tempdir().expect("a folder");
    measure("SQLite", &folder.path().display().to_string(), many).await;
    if let Some(parts) = server::folder("the benchmark of Neo4j") {
        let neo4j = server::Neo4j::start_in(parts, OF_A_CLINIC);
        measure("Neo4j", &neo4j.url(), many).await;
    }
}

async fn measure(what: &str, url: &str, many: usize) {
    let store = store::open_url(url).await.expect("a store");
    let start = Instant::now();
    fill(&store, many).await;
    let seconds = start.elapsed().as_secs_f64();
    println!("\n{what}: {many} behaviours of {STREAMS} streams saved in {seconds:.1} s");
    questions(&store, many).await;
}
