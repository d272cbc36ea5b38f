//! Attacks by clients that were let in.

use crate::stops::{greeted, said};
use crate::target::{Target, fresh, made, note, note_id, nothing};
use behaviour::{Connector, Id, Kind, Procedure, Record, RecordId, Stream, StreamKind, connectors};
use futures_util::future::join_all;
use futures_util::{SinkExt, StreamExt};
use house::Outcome;
use protocol::{LIBRARY, Request, request};
use shell::Client;
use std::time::Duration;

/// Clients that propose.
const PROPOSERS: usize = 4;
/// Procedures in one proposal, and blocks in each: a message of nearly the largest size.
const BODIES: usize = 30;
const BLOCKS: usize = 2_690;
/// Proposals of one client that wait for their answers.
const UNANSWERED: usize = 20;
/// Clients that ask as fast as they can.
const FLOODS: usize = 8;
/// Clients that never read.
const DEAF: usize = 200;
/// Before who was cut off comes again.
const PAUSE: Duration = Duration::from_millis(100);

/// Runs something for many clients at once, again and again.
async fn crowd<F: Future<Output = Outcome<()>> + Send + 'static>(many: usize, one: impl Fn() -> F) {
    let mut all: Vec<_> = (0..many).map(|_| tokio::spawn(one())).collect();
    loop {
        for task in &mut all {
            if task.is_finished() {
                *task = tokio::spawn(one());
            }
        }
        tokio::time::sleep(PAUSE).await;
    }
}

/// Large proposals of procedures that take long to check.
pub(crate) async fn procedures(target: Target) {
    crowd(PROPOSERS, || proposer(target.clone())).await;
}

async fn proposer(target: Target) -> Outcome<()> {
    let client = Client::connect(&target.url(), "Proposer").await?;
    let behaviour = made(&client, "Proposals").await?;
    client.load(&behaviour).await?;
    let proposals = (0..UNANSWERED).map(|_| {
        let change = client.change("Propose", &nothing(), (0..BODIES).flat_map(|_| slow_map()).collect());
        client.ask(request::Propose { behaviour: behaviour.clone(), change, tokens: Vec::new() })
    });
    join_all(proposals).await;
    Ok(())
}

/// A sense, a stream and a map between them whose body nobody has sent yet.
fn slow_map() -> [(RecordId, Option<Record>); 3] {
    let (sense, out, map) = (fresh("s"), fresh("o"), fresh("m"));
    let stream = |kind, name: &Id, device: Option<&str>| {
        Record::Stream(Stream {
            kind,
            name: name.to_string(),
            device: device.map(str::to_owned),
            params: behaviour::Params::new(),
            order: 0,
            resources: None,
            priority: None,
            hold_ms: None,
        })
    };
    let number = map.as_str().rsplit('-').next().unwrap_or_default();
    let body = format!("{}{number}", "{1}".repeat(BLOCKS));
    let operation = connectors::map::SPEC.with(Procedure::body(&body));
    let connector = Connector { operation, inputs: vec![sense.clone()], output: out.clone(), order: 0 };
    [
        (RecordId::new(Kind::Stream, &sense), Some(stream(StreamKind::Sensor, &sense, Some("RedBall")))),
        (RecordId::new(Kind::Stream, &out), Some(stream(StreamKind::Ordinary, &out, None))),
        (RecordId::new(Kind::Connector, &map), Some(Record::Connector(connector))),
    ]
}

/// Requests without a pause, their answers read and thrown away.
pub(crate) async fn floods(target: Target) {
    crowd(FLOODS, || flood(target.clone(), |_| request::Runs {})).await;
}

/// Actions by hand without a pause, with other settings each time.
pub(crate) async fn hands(target: Target) {
    let hand = |ask: u32| {
        let speed = if ask.is_multiple_of(2) { 0.05 } else { 0.06 };
        let params = [("speed".to_owned(), speed.into())].into_iter().collect();
        request::Hand { robot: None, device: "Walk".to_owned(), params, value: 1.into() }
    };
    crowd(FLOODS, || flood(target.clone(), hand)).await;
}

async fn flood<R: Request>(target: Target, request: impl Fn(u32) -> R) -> Outcome<()> {
    let (mut to, from) = greeted(&target).await?.split();
    let reading = tokio::spawn(from.for_each(|_| std::future::ready(())));
    for ask in 2.. {
        if ask % 64 == 0 {
            tokio::task::yield_now().await;
        }
        to.send(said(ask, request(ask))?).await?;
        if reading.is_finished() {
            break;
        }
    }
    Ok(())
}

/// Clients that ask for everything there is and read nothing of it.
pub(crate) async fn unread(target: Target) {
    crowd(DEAF, || deaf(target.clone())).await;
}

async fn deaf(target: Target) -> Outcome<()> {
    let mut socket = greeted(&target).await?;
    for ask in 2..150 {
        socket.send(said(ask, request::List { query: protocol::ListQuery::default() })?).await?;
        socket.send(said(ask, request::Open { behaviour: Id::new("large")? })?).await?;
        socket.send(said(ask, request::Since { behaviour: Id::new("large")?, revision: 0 })?).await?;
    }
    tokio::time::sleep(Duration::from_secs(60)).await;
    Ok(())
}

/// Clients that open a large behaviour and read nothing of it, each at another revision.
pub(crate) async fn openers(target: Target) {
    tokio::spawn(edits(target.clone()));
    crowd(DEAF, || opener(target.clone())).await;
}

/// Edits of a large behaviour without an end.
async fn edits(target: Target) -> Outcome<()> {
    let client = Client::connect(&target.url(), "Editor").await?;
    let large = Id::new("large")?;
    client.load(&large).await?;
    loop {
        client.put("Edit", note_id(&fresh("e")), Some(note("edited"))).await?;
    }
}

async fn opener(target: Target) -> Outcome<()> {
    let mut socket = greeted(&target).await?;
    for ask in 2..100 {
        socket.send(said(ask, request::Open { behaviour: Id::new("large")? })?).await?;
        tokio::time::sleep(PAUSE).await;
    }
    Ok(())
}

/// Notes and helpers, as large and as many as are taken.
pub(crate) async fn growth(target: Target) {
    crowd(2, || grower(target.clone())).await;
}

async fn grower(target: Target) -> Outcome<()> {
    let client = Client::connect(&target.url(), "Grower").await?;
    let behaviour = made(&client, "Growth").await?;
    client.load(&behaviour).await?;
    let library = Id::new(LIBRARY)?;
    loop {
        let notes = (0..20).map(|_| (note_id(&fresh("n")), Some(note(&"n".repeat(4_000))))).collect();
        let change = client.change("Grow", &nothing(), notes);
        let notes = client.ask(request::Propose { behaviour: behaviour.clone(), change, tokens: Vec::new() }).await;
        let change = client.change("Grow", &nothing(), (0..4).map(|_| helper()).collect());
        let helpers = client.ask(request::Propose { behaviour: library.clone(), change, tokens: Vec::new() }).await;
        if notes.is_err() && helpers.is_err() {
            tokio::time::sleep(PAUSE).await;
        }
    }
}

fn helper() -> (RecordId, Option<Record>) {
    let name = fresh("h");
    let helper = behaviour::Helper {
        name: name.as_str().replace('-', "_"),
        params: vec!["x".to_owned()],
        body: format!("x + {}1", " ".repeat(7_000)),
        says: "s".repeat(3_000),
        ..behaviour::Helper::default()
    };
    (RecordId::new(Kind::Helper, &name), Some(Record::Helper(helper)))
}
