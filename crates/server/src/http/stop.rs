//! Answers one Stop: reads its head, lets the robots hold, says so, and only then has anything else done.

mod said;
mod words;

pub(super) use said::StopAnswer;

use super::headers::HEADERS;
use crate::http::door::EntryDoor;
use crate::http::origin::NotAllowed;
use crate::robots::Robots;
use axum::extract::Query;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Uri};
use behaviour::Id;
use serde::Deserialize;
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};

/// The longest head, in bytes.
const HEAD_MAX_BYTES: usize = 8 << 10;
/// Header lines in it.
const LINES_MAX: usize = 64;
/// How long each side may take.
const SIDE_MAX_MS: u64 = 1_000;
/// What may follow the head and is thrown away, in bytes.
const REST_MAX_BYTES: usize = 16 << 10;

/// What is to stop: everything on all robots if nothing is named. An id that is none names nothing: better too much than
/// too little.
#[derive(Debug, Default, Deserialize)]
struct StopTarget {
    /// Only this behaviour.
    behaviour: Option<Id>,
    /// Only on this robot.
    robot: Option<Id>,
}

/// Does a Stop unless somebody asks who may not, in whatever way it came in; answers with what is to be said.
pub(super) fn press(door: &EntryDoor, robots: &Robots, uri: &Uri, asked: &HeaderMap) -> StopAnswer {
    let who = door.may_stop(asked);
    if let Ok(by) = &who {
        let which = Query::try_from_uri(uri).map(|Query(which)| which);
        let StopTarget { behaviour, robot } = which.unwrap_or_default();
        robots.stop_now(behaviour.as_ref(), robot.as_ref(), by);
    }
    let answer = StopAnswer::of(&who.map(drop), uri, asked);
    // Whoever reads it presses after all these Stops, whether their link tells of them yet or not.
    answer.with_stops(robots.newest_stop())
}

/// Reads the Stop, does it and answers; the connection ends with that.
pub(super) async fn answer(mut stream: impl AsyncRead + AsyncWrite + Unpin, door: &EntryDoor, robots: &Robots) {
    let Some(head) = within(head(&mut stream)).await.flatten() else { return };
    let said = match asked(&head) {
        Some((uri, asked)) => press(door, robots, &uri, &asked),
        None => StopAnswer::of(&Err(NotAllowed::Unreadable), &Uri::default(), &HeaderMap::new()),
    };
    let said = written(&said);
    let answered = within(async { stream.write_all(&said).await.and(stream.shutdown().await) }).await;
    tracing::info!(?answered, "Stop over HTTP");
    within(drain(&mut stream)).await;
}

async fn within<T>(work: impl Future<Output = T>) -> Option<T> {
    tokio::time::timeout(Duration::from_millis(SIDE_MAX_MS), work).await.ok()
}

/// The request up to the empty line; none if it ends before that or is too long.
async fn head(stream: &mut (impl AsyncRead + Unpin)) -> Option<Vec<u8>> {
    let mut head = Vec::with_capacity(1_024);
    loop {
        if stream.read_buf(&mut head).await.ok()? == 0 || head.len() > HEAD_MAX_BYTES {
            return None;
        }
        if head.windows(4).any(|bytes| bytes == b"\r\n\r\n") {
            return Some(head);
        }
    }
}

/// Where it is sent to and its header; none if it cannot be read.
fn asked(head: &[u8]) -> Option<(Uri, HeaderMap)> {
    let mut lines = [httparse::EMPTY_HEADER; LINES_MAX];
    let mut request = httparse::Request::new(&mut lines);
    request.parse(head).ok()?;
    let uri = request.path.and_then(|path| path.parse::<Uri>().ok()).unwrap_or_default();
    let mut asked = HeaderMap::new();
    for line in request.headers.iter() {
        if let (Ok(name), Ok(value)) = (line.name.parse::<HeaderName>(), HeaderValue::from_bytes(line.value)) {
            asked.append(name, value);
        }
    }
    Some((uri, asked))
}

fn written(said: &StopAnswer) -> Vec<u8> {
    let mut text = format!("HTTP/1.1 {}\r\ncontent-length: {}\r\n", said.status, said.body.len());
    for (name, value) in &said.headers() {
        text.push_str(&format!("{name}: {}\r\n", value.to_str().unwrap_or_default()));
    }
    for (name, value) in HEADERS {
        text.push_str(&format!("{name}: {value}\r\n"));
    }
    text.push_str("connection: close\r\n\r\n");
    text.push_str(&said.body);
    text.into_bytes()
}

/// Reads what the sender still says: closing before that could take the answer away from them.
async fn drain(stream: &mut (impl AsyncRead + Unpin)) {
    let (mut piece, mut rest) = ([0; 1_024], REST_MAX_BYTES);
    while let Ok(count @ 1..) = stream.read(&mut piece).await {
        rest = rest.saturating_sub(count);
        if rest == 0 {
            return;
        }
    }
}
