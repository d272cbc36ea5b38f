//! The routes, and what every answer carries.

use crate::door::{self, Origin};
use crate::hub::Hub;
use crate::{carry, page, recordings, session, start};
use axum::body::Bytes;
use axum::extract::rejection::{BytesRejection, QueryRejection};
use axum::extract::{DefaultBodyLimit, Path, Query, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, Uri, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::{any, get, post};
use axum::{Json, Router};
use behaviour::Id;
use protocol::MESSAGE_MAX_BYTES;
use serde::Deserialize;
use std::sync::Arc;
use store::files::FILE_MAX_BYTES;

/// What may wait to be written to one socket, in bytes: some large messages; then its writer waits.
const WRITE_MAX_BYTES: usize = 16 << 20;

/// What every answer carries.
const HEADERS: [(&str, &str); 5] = [
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
    port: u16,
}

/// All routes of a server that listens on `port`.
pub(crate) fn routes(hub: Arc<Hub>, port: u16) -> Router {
    let porch = Porch { hub, port };
    Router::new()
        .route(protocol::PATH, any(socket))
        .route(protocol::STOP_PATH, post(stop))
        .route("/healthz", get(|| async { "ok\n" }))
        .route("/readyz", get(readyz))
        .route("/api/behaviours", get(list))
        .route("/api/behaviours/{file}", get(download))
        .route("/api/backup", get(backup))
        .route(protocol::RECORDINGS_PATH, get(list_recordings))
        .route(&format!("{}/{{file}}", protocol::RECORDINGS_PATH), get(recording))
        .route("/api/import", post(upload).layer(DefaultBodyLimit::max(FILE_MAX_BYTES)))
        .fallback(get(files))
        .layer(middleware::from_fn_with_state(porch.clone(), guard))
        .with_state(porch)
}

/// Lets in only whom the door lets in, and puts the headers on every answer.
async fn guard(State(porch): State<Porch>, request: Request, next: Next) -> Response {
    let mut response = match may_enter(porch.port, &request) {
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

fn may_enter(port: u16, request: &Request) -> Result<(), &'static str> {
    let of = |name: HeaderName| request.headers().get(name).map(|value| value.to_str().unwrap_or("?"));
    let path = request.uri().path();
    let talks = !request.method().is_safe() || path == protocol::PATH;
    let origin = if talks { of(header::ORIGIN) } else { None };
    // Stop is never refused to somebody without a browser; other posts must say where they come from.
    let free = !talks || path == protocol::PATH || path == protocol::STOP_PATH;
    let need = if free { Origin::Optional } else { Origin::Required };
    door::check(port, of(header::HOST), origin, need)
}

async fn socket(State(porch): State<Porch>, upgrade: WebSocketUpgrade) -> Response {
    let Ok(place) = Arc::clone(&porch.hub.sockets).try_acquire_owned() else {
        return (StatusCode::SERVICE_UNAVAILABLE, "Too many pages are open. Close some.\n").into_response();
    };
    let upgrade = upgrade.max_message_size(MESSAGE_MAX_BYTES).max_frame_size(MESSAGE_MAX_BYTES);
    let upgrade = upgrade.write_buffer_size(0).max_write_buffer_size(WRITE_MAX_BYTES);
    upgrade.on_upgrade(move |socket| async move {
        let hub = porch.hub;
        let _ = hub.tasks.clone().spawn(session::run(hub, socket)).await;
        drop(place);
    })
}

#[derive(Default, Deserialize)]
struct Which {
    behaviour: Option<Id>,
    robot: Option<Id>,
}

/// Passes nothing that could wait. An id that is none stops everything: better too much than too little.
async fn stop(State(porch): State<Porch>, which: Result<Query<Which>, QueryRejection>) -> Response {
    let which = which.map(|Query(which)| which).unwrap_or_default();
    start::stop(&porch.hub, which.behaviour.as_ref(), which.robot.as_ref(), "the Stop button");
    Json(serde_json::json!({ "stopped": true })).into_response()
}

async fn readyz(State(porch): State<Porch>) -> Response {
    match crate::hub::bounded(porch.hub.store.healthy()).await {
        Ok(()) => "ready\n".into_response(),
        Err(error) => (StatusCode::SERVICE_UNAVAILABLE, format!("{error}\n")).into_response(),
    }
}

async fn list(State(porch): State<Porch>) -> Response {
    carry::list(&porch.hub).await
}

async fn backup(State(porch): State<Porch>) -> Response {
    carry::backup(&porch.hub)
}

async fn list_recordings(State(porch): State<Porch>) -> Response {
    recordings::list(&porch.hub).await
}

async fn recording(State(porch): State<Porch>, Path(file): Path<String>) -> Response {
    recordings::download(&porch.hub, file).await
}

async fn download(State(porch): State<Porch>, Path(file): Path<String>) -> Response {
    carry::download(&porch.hub, &file).await
}

async fn upload(
    State(porch): State<Porch>,
    Query(how): Query<carry::How>,
    body: Result<Bytes, BytesRejection>,
) -> Response {
    carry::upload(&porch.hub, how, body).await
}

async fn files(method: Method, uri: Uri, asked: HeaderMap) -> Response {
    debug_assert!(method.is_safe());
    page::answer(uri.path(), &asked)
}
