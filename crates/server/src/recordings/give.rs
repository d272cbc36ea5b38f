//! Recordings over HTTP: the list, and a file as it is so far.

use crate::hub::Hub;
use axum::Json;
use axum::body::{Body, Bytes};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use protocol::SaidNo;
use std::fs::File;
use std::io::Read;
use std::path::PathBuf;
use std::sync::Arc;
use tokio::sync::mpsc;

/// Pieces of a file that wait to be sent.
const PIECES_MAX: usize = 4;
/// Size of a piece, in bytes.
const PIECE_BYTES: usize = 64 << 10;

/// All recordings, newest first.
pub(crate) async fn list(hub: &Arc<Hub>) -> Response {
    let recordings = hub.recordings.clone();
    match tokio::task::spawn_blocking(move || recordings.list()).await {
        Ok(list) => Json(list).into_response(),
        Err(error) => (StatusCode::INTERNAL_SERVER_ERROR, format!("{error}\n")).into_response(),
    }
}

/// One recording.
pub(crate) async fn download(hub: &Arc<Hub>, name: String) -> Response {
    let (recordings, wanted) = (hub.recordings.clone(), name.clone());
    let Ok(Some(path)) = tokio::task::spawn_blocking(move || recordings.find(&wanted)).await else {
        return (StatusCode::NOT_FOUND, format!("{}\n", SaidNo::NoRecording)).into_response();
    };
    let (send, sent) = mpsc::channel(PIECES_MAX);
    // Nobody waits for its end: a reader that stopped ends it with the next piece.
    drop(tokio::task::spawn_blocking(move || read(path, &send)));
    let pieces = futures_util::stream::unfold(sent, async |mut sent| {
        let piece: std::io::Result<Bytes> = sent.recv().await?;
        Some((piece, sent))
    });
    let headers = [
        (header::CONTENT_TYPE, "application/jsonl".to_owned()),
        (header::CONTENT_DISPOSITION, format!("attachment; filename=\"{name}\"")),
    ];
    (headers, Body::from_stream(pieces)).into_response()
}

fn read(path: PathBuf, to: &mpsc::Sender<std::io::Result<Bytes>>) {
    let mut file = match File::open(path) {
        Ok(file) => file,
        Err(error) => return drop(to.blocking_send(Err(error))),
    };
    loop {
        let mut piece = vec![0; PIECE_BYTES];
        let read = file.read(&mut piece).map(|bytes| {
            piece.truncate(bytes);
            Bytes::from(piece)
        });
        let last = read.as_ref().map_or(true, Bytes::is_empty);
        if to.blocking_send(read).is_err() || last {
            return;
        }
    }
}
