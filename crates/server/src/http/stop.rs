//! Answers one Stop: reads its head, lets the robots hold, says so, and only then has anything else done.

use super::headers::HEADERS;
use crate::http::door::Door;
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

/// What is to stop: everything on all robots if nothing is named.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct StopTarget {
    /// Only this behaviour.
    pub(crate) behaviour: Option<Id>,
    /// Only on this robot.
    pub(crate) robot: Option<Id>,
}

/// Reads the Stop, does it and answers; the connection ends with that.
pub(super) async fn answer(mut stream: impl AsyncRead + AsyncWrite + Unpin, door: &Door, robots: &Robots) {
    let Some(head) = within(head(&mut stream)).await.flatten() else { return };
    let said = match asked(&head, door) {
        Ok(which) => {
            robots.stop_now(which.behaviour.as_ref(), which.robot.as_ref(), "the Stop button");
            response("200 OK", "application/json", "{\"stopped\":true}")
        }
        Err(why) => response("403 Forbidden", "text/plain; charset=utf-8", &format!("Refused: {why}.\n")),
    };
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

/// What is to stop, unless somebody asks who may not. An id that is none stops everything: better too much than too
/// little.
fn asked(head: &[u8], door: &Door) -> Result<StopTarget, NotAllowed> {
    let mut lines = [httparse::EMPTY_HEADER; LINES_MAX];
    let mut request = httparse::Request::new(&mut lines);
    request.parse(head).map_err(|_| NotAllowed::Unreadable)?;
    let line = |line: &httparse::Header| {
        Some((line.name.parse::<HeaderName>().ok()?, HeaderValue::from_bytes(line.value).ok()?))
    };
    let headers: HeaderMap = request.headers.iter().filter_map(line).collect();
    door.may_stop(&headers)?;
    let uri = request.path.and_then(|path| path.parse::<Uri>().ok()).unwrap_or_default();
    Ok(Query::try_from_uri(&uri).map(|Query(which)| which).unwrap_or_default())
}

fn response(status: &str, kind: &str, body: &str) -> Vec<u8> {
    let mut text = format!("HTTP/1.1 {status}\r\ncontent-type: {kind}\r\ncontent-length: {}\r\n", body.len());
    for (name, value) in HEADERS {
        text.push_str(&format!("{name}: {value}\r\n"));
    }
    text.push_str("connection: close\r\n\r\n");
    text.push_str(body);
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
