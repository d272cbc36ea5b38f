//! Serves connections that want something else than Stop: HTTP with a limit on everything that a client could draw out.
//! Only bytes are moved here; what the requests ask for is done on the server's other threads.

use crate::http::accept::Handed;
use crate::http::door::RequestArrival;
use crate::http::line::{Io, ServedConnection};
use crate::support::places::Places;
use crate::support::tasks::{TaskResult, boxed};
use axum::Router;
use axum::body::Body;
use axum::http::{HeaderValue, Request, Response, StatusCode, header};
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use std::convert::Infallible;
use std::time::Duration;
use tokio::runtime::Handle;
use tokio_io_timeout::TimeoutStream;
use tokio_util::sync::CancellationToken;
use tokio_util::task::{AbortOnDropHandle, TaskTracker};
use tower::ServiceExt;

/// Connections that are served at once, sockets apart; the oldest gives way.
const SERVED_MAX: usize = 256;
/// How long the header of a request may take.
const HEADER_MS: u64 = 5_000;
/// The longest header, in bytes.
const HEADER_MAX_BYTES: usize = 16 << 10;
/// How long a client may take nothing of what is written to it.
const WRITE_MS: u64 = 10_000;

/// Where requests are answered, and where the routes are.
#[derive(Clone)]
pub(crate) struct Routed {
    /// All routes.
    pub(crate) router: Router,
    /// The threads on which they work.
    pub(crate) on: Handle,
}

/// Serves what is handed over until `stopping`; what is under way goes on in `tasks`.
pub(crate) async fn serve(mut handed: Handed, routed: Routed, tasks: TaskTracker, stopping: CancellationToken) {
    let places = Places::of(SERVED_MAX);
    while let Some(Some((line, came))) = stopping.run_until_cancelled(handed.recv()).await {
        let (place, routed, stopping) = (places.take(), routed.clone(), stopping.clone());
        tasks.spawn(boxed(async move {
            match ServedConnection::arrive(line) {
                Ok(stream) => drop(place.hold(one(stream, came, routed, stopping)).await),
                Err(error) => tracing::debug!(%error, "a connection was lost on the way"),
            }
        }));
    }
}

/// One request: every next one comes on a connection of its own, so that a Stop is always seen by the accepting thread.
async fn one(stream: Box<dyn Io>, came: RequestArrival, routed: Routed, stopping: CancellationToken) {
    let mut stream = TimeoutStream::new(stream);
    stream.set_write_timeout(Some(Duration::from_millis(WRITE_MS)));
    let service = service_fn(move |request| answer(routed.clone(), came.clone(), request));
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(Duration::from_millis(HEADER_MS));
    http.max_buf_size(HEADER_MAX_BYTES);
    let connection = http.serve_connection(TokioIo::new(Box::pin(stream)), service).with_upgrades();
    let mut connection = std::pin::pin!(connection);
    let ended = tokio::select! {
        ended = &mut connection => ended,
        () = stopping.cancelled() => {
            connection.as_mut().graceful_shutdown();
            connection.await
        }
    };
    if let Err(error) = ended {
        tracing::debug!(%error, "a connection ended early");
    }
}

/// Answers on the server's other threads; if the client goes, the work is dropped.
async fn answer(
    routed: Routed,
    came: RequestArrival,
    request: Request<Incoming>,
) -> Result<Response<Body>, Infallible> {
    let mut request = request.map(Body::new);
    request.extensions_mut().insert(came);
    let (work, made) = TaskResult::by(routed.router.oneshot(request));
    let answered = made.when(AbortOnDropHandle::new(routed.on.spawn(work))).await;
    let Ok(mut response) = answered.unwrap_or_else(|error| Ok(failed(&error)));
    if response.status() != StatusCode::SWITCHING_PROTOCOLS {
        response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    }
    Ok(response)
}

fn failed(error: &tokio::task::JoinError) -> Response<Body> {
    tracing::error!(%error, "a request failed inside");
    let mut response = Response::new(Body::from("This failed inside. Please tell the people who make rrp.\n"));
    *response.status_mut() = StatusCode::INTERNAL_SERVER_ERROR;
    response
}
