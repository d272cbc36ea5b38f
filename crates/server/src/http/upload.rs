//! Behaviours as files, into the server: a file is taken whole, in one of few places and within a time.

use crate::library::LibraryService;
use crate::library::import::{NotImported, import};
use crate::support::identity::Sender;
use crate::support::shares::SharedPlace;
use axum::Json;
use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use behaviour::Id;
use phrase::Phrased;
use protocol::Refused;
use serde::Deserialize;
use std::sync::Arc;
use std::time::Duration;
use store::files::{Import, ImportMode};

/// How long a file may take to come.
const UPLOAD_MS: u64 = 20_000;

/// How a file is to be imported.
#[derive(Debug, Default, Deserialize)]
pub(super) struct ImportHow {
    #[serde(default)]
    pub(super) mode: UploadWanted,
    /// What the host wants to be called as who imports it.
    #[serde(default)]
    pub(super) by: String,
    /// The id that a copy gets; sent twice, there is one.
    pub(super) behaviour: Option<Id>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum UploadWanted {
    #[default]
    Copy,
    Restore,
}

/// Takes a file in this place, imports it for this sender and says what became of it.
pub(super) async fn upload(
    library: &Arc<LibraryService>,
    place: &SharedPlace,
    sender: Sender,
    how: ImportHow,
    request: Request,
) -> Response {
    let taken = tokio::time::timeout(Duration::from_millis(UPLOAD_MS), Bytes::from_request(request, &()));
    match place.hold(taken).await {
        Some(Ok(Ok(body))) => answer(bring(library, sender, how, body).await),
        Some(Ok(Err(error))) if error.status() == StatusCode::PAYLOAD_TOO_LARGE => answer(Err(NotImported::TooLarge)),
        Some(Ok(Err(_)) | Err(_)) | None => answer(Err(NotImported::NotWhole)),
    }
}

async fn bring(
    library: &Arc<LibraryService>,
    sender: Sender,
    how: ImportHow,
    body: Bytes,
) -> Result<Import, NotImported> {
    let mode = match how.mode {
        UploadWanted::Copy => ImportMode::Copy,
        UploadWanted::Restore => ImportMode::Restore,
    };
    import(library, sender, (mode, how.behaviour), &how.by, body).await
}

fn answer(imported: Result<Import, NotImported>) -> Response {
    match imported {
        Ok(Import { behaviour, name, renamed, changes, .. }) => {
            tracing::info!(%behaviour, "a behaviour was imported");
            let was_here = changes.is_empty();
            let told = serde_json::json!(
                {"id": behaviour, "name": name, "renamedHelpers": renamed, "wasHere": was_here}
            );
            Json(told).into_response()
        }
        Err(why) => {
            (status(&why), Json(serde_json::json!({ "error": why.to_string(), "why": why.phrase() }))).into_response()
        }
    }
}

fn status(why: &NotImported) -> StatusCode {
    match why {
        NotImported::Fault(_) => StatusCode::BAD_REQUEST,
        NotImported::Present => StatusCode::CONFLICT,
        NotImported::TooLarge => StatusCode::PAYLOAD_TOO_LARGE,
        NotImported::NotWhole => StatusCode::REQUEST_TIMEOUT,
        NotImported::Refused(Refused::Store(_) | Refused::TooFast) => StatusCode::SERVICE_UNAVAILABLE,
        NotImported::Refused(_) => StatusCode::UNPROCESSABLE_ENTITY,
    }
}
