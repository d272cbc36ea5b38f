//! Recordings over HTTP: the list, and a file as it is so far.

use crate::recordings::Recordings;
use crate::support::file_name::disposition;
use crate::support::identity::Sender;
use crate::support::workers::Workers;
use axum::Json;
use axum::body::{Body, Bytes};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use protocol::Refused;
use std::fs::File;
use std::io::Read;

/// Size of a piece, in bytes.
const PIECE_BYTES: usize = 64 << 10;

/// All recordings, newest first.
pub(crate) async fn list(recordings: Recordings, (files, sender): (&Workers, Sender)) -> Response {
    match files.run(sender, move |_| recordings.list()).await {
        Ok(list) => Json(list).into_response(),
        Err(why) => (StatusCode::SERVICE_UNAVAILABLE, format!("{}\n", Refused::from(why))).into_response(),
    }
}

/// One recording, read piece by piece as it is taken.
pub(crate) async fn download(recordings: Recordings, files: (Workers, Sender), name: String) -> Response {
    let wanted = name.clone();
    let open = move |_: &_| recordings.find(&wanted).map(File::open);
    let file = match files.0.run(files.1.clone(), open).await {
        Ok(Some(Ok(file))) => file,
        Ok(Some(Err(error))) => return (StatusCode::INTERNAL_SERVER_ERROR, format!("{error}\n")).into_response(),
        _ => return (StatusCode::NOT_FOUND, format!("{}\n", Refused::NoRecording)).into_response(),
    };
    let headers = [
        (header::CONTENT_TYPE, "application/jsonl".to_owned()),
        (header::CONTENT_DISPOSITION, disposition(name.trim_end_matches(".jsonl"), "jsonl")),
    ];
    (headers, Body::from_stream(futures_util::stream::try_unfold((file, files), next_piece))).into_response()
}

/// The next piece of a file. Nothing waits for the reader: it is read only when it is wanted.
async fn next_piece((file, files): RecordingRead) -> std::io::Result<Option<(Bytes, RecordingRead)>> {
    let read = files.0.run(files.1.clone(), move |_| {
        let mut piece = Vec::with_capacity(PIECE_BYTES);
        (&file).take(PIECE_BYTES as u64).read_to_end(&mut piece)?;
        Ok::<_, std::io::Error>((Bytes::from(piece), file))
    });
    let failed = |why| std::io::Error::other(Refused::from(why).to_string());
    let (piece, file) = read.await.map_err(failed)??;
    Ok((!piece.is_empty()).then_some((piece, (file, files))))
}

/// A file that is read, and by which threads for whom.
type RecordingRead = (File, (Workers, Sender));
