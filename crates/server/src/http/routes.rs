//! The routes, and what every answer carries.

use super::stop::Which;
use super::{page, recordings, transfer};
use crate::connection::session;
use crate::http::downloads::{Downloads, few_at_once};
use crate::http::origin::Guard;
use crate::library::import;
use crate::state::Hub;
use crate::support::places::Places;
use axum::body::Bytes;
use axum::extract::rejection::QueryRejection;
use axum::extract::{DefaultBodyLimit, FromRequest, Path, Query, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, Uri};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::{any, get, post};
use axum::{Json, Router};
use protocol::MESSAGE_MAX_BYTES;
use std::sync::Arc;
use std::time::Duration;
use store::files::FILE_MAX_BYTES;
use tokio::runtime::Handle;
use tower_http::timeout::{RequestBodyTimeoutLayer, TimeoutLayer};

/// What may wait to be written to one socket, in bytes: some large messages; then its writer waits.
const WRITE_MAX_BYTES: usize = 16 << 20;

/// How long a request may take to be answered; a download may take longer once it began.
const REQUEST_MS: u64 = 60_000;
/// How long a file may take to come.
const UPLOAD_MS: u64 = 20_000;
/// Files that may be on their way to us; the oldest gives way.
const UPLOADS_MAX: usize = 8;
/// How long the next piece of a request may take to come.
const PIECE_MS: u64 = 5_000;

/// What every answer carries.
pub(crate) const HEADERS: [(&str, &str); 5] = [
    (
        "content-security-policy",
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; img-src 'self' data:; \
         style-src 'self'; font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'self'; \
         frame-ancestors 'none'",
    ),
    ("x-content-type-options", "nosniff"),
    ("referrer-policy", "no-referrer"),
    ("cross-origin-opener-policy", "same-origin"),
    ("permissions-policy", "camera=(), microphone=(), geolocation=()"),
];

#[derive(Clone)]
struct Porch {
    hub: Arc<Hub>,
    guard: Guard,
    /// Files that are being sent to us.
    uploads: Arc<Places>,
    /// The threads that carry messages.
    messages: Handle,
}

/// All routes; sockets are served on `messages`.
pub(crate) fn routes(hub: Arc<Hub>, guard: Guard, messages: Handle) -> Router {
    let porch = Porch { hub, guard, uploads: Places::of(UPLOADS_MAX), messages };
    Router::new()
        .route(protocol::PATH, any(socket))
        .route(protocol::STOP_PATH, post(stop))
        .route("/healthz", get(|| async { "ok\n" }))
        .route("/readyz", get(readyz))
        .merge(files_to_keep())
        .route("/api/import", post(upload).layer(DefaultBodyLimit::max(FILE_MAX_BYTES)))
        .fallback(get(files))
        .layer(RequestBodyTimeoutLayer::new(Duration::from_millis(PIECE_MS)))
        .layer(TimeoutLayer::with_status_code(StatusCode::REQUEST_TIMEOUT, Duration::from_millis(REQUEST_MS)))
        .layer(middleware::from_fn_with_state(porch.clone(), guard_all))
        .with_state(porch)
}

/// What people download.
fn files_to_keep() -> Router<Porch> {
    Router::new()
        .route("/api/behaviours", get(list))
        .route("/api/behaviours/{file}", get(download))
        .route("/api/backup", get(backup))
        .route(protocol::RECORDINGS_PATH, get(list_recordings))
        .route(&format!("{}/{{file}}", protocol::RECORDINGS_PATH), get(recording))
        .layer(middleware::from_fn_with_state(Downloads::default(), few_at_once))
}

/// Lets in only whom the guard lets in, and puts the headers on every answer.
async fn guard_all(State(porch): State<Porch>, request: Request, next: Next) -> Response {
    let mut response = match porch.guard.may_enter(&request) {
        Ok(()) => next.run(request).await,
        Err(why) => {
            tracing::warn!(why, "a request was turned away");
            (StatusCode::FORBIDDEN, format!("Refused: {why}.\n")).into_response()
        }
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(HeaderName::from_static(name), HeaderValue::from_static(value));
    }
    response
}

async fn socket(State(porch): State<Porch>, upgrade: WebSocketUpgrade) -> Response {
    let Ok(place) = Arc::clone(&porch.hub.sockets).try_acquire_owned() else {
        return (StatusCode::SERVICE_UNAVAILABLE, "Too many pages are open. Close some.\n").into_response();
    };
    let upgrade = upgrade.max_message_size(MESSAGE_MAX_BYTES).max_frame_size(MESSAGE_MAX_BYTES);
    let upgrade = upgrade.write_buffer_size(0).max_write_buffer_size(WRITE_MAX_BYTES);
    upgrade.on_upgrade(move |socket| async move {
        let hub = porch.hub;
        let _ = hub.tasks.clone().spawn_on(session::run(hub, socket), &porch.messages).await;
        drop(place);
    })
}

/// The accepting thread answers almost every Stop; this one is for requests that are written in another way.
async fn stop(State(porch): State<Porch>, which: Result<Query<Which>, QueryRejection>) -> Response {
    let which = which.map(|Query(which)| which).unwrap_or_default();
    porch.hub.robots.stop_now(which.behaviour.as_ref(), which.robot.as_ref(), "the Stop button");
    Json(serde_json::json!({ "stopped": true })).into_response()
}

async fn readyz(State(porch): State<Porch>) -> Response {
    match crate::support::store_call::bounded(porch.hub.store.healthy()).await {
        Ok(()) => "ready\n".into_response(),
        Err(error) => (StatusCode::SERVICE_UNAVAILABLE, format!("{error}\n")).into_response(),
    }
}

async fn list(State(porch): State<Porch>) -> Response {
    transfer::list(&porch.hub).await
}

async fn backup(State(porch): State<Porch>) -> Response {
    transfer::backup(&porch.hub)
}

async fn list_recordings(State(porch): State<Porch>) -> Response {
    recordings::list(&porch.hub).await
}

async fn recording(State(porch): State<Porch>, Path(file): Path<String>) -> Response {
    recordings::download(&porch.hub, file).await
}

async fn download(State(porch): State<Porch>, Path(file): Path<String>) -> Response {
    transfer::download(&porch.hub, &file).await
}

/// A file is taken whole before anything is done with it, in one of few places and within a time.
async fn upload(State(porch): State<Porch>, Query(how): Query<import::How>, request: Request) -> Response {
    let place = porch.uploads.take();
    let taken = tokio::time::timeout(Duration::from_millis(UPLOAD_MS), Bytes::from_request(request, &()));
    match place.hold(taken).await {
        Some(Ok(Err(error))) if error.status() != StatusCode::PAYLOAD_TOO_LARGE => not_whole(),
        Some(Ok(body)) => import::upload(&porch.hub, how, body.ok()).await,
        Some(Err(_)) | None => not_whole(),
    }
}

fn not_whole() -> Response {
    let sentence = "The file did not come whole, or took too long. Try again.";
    (StatusCode::REQUEST_TIMEOUT, Json(serde_json::json!({ "error": sentence }))).into_response()
}

async fn files(method: Method, uri: Uri, asked: HeaderMap) -> Response {
    debug_assert!(method.is_safe());
    page::answer(uri.path(), &asked)
}
