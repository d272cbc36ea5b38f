//! Accepts connections: without Nagle's delay, with a time limit for headers and a limit on how many there are.

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

/// Connections that may be open. More than sockets may, so that Stop always finds a place.
const CONNECTIONS_MAX: usize = crate::hub::SOCKETS_MAX + 128;
/// How long the header of a request may take.
const HEADER_MS: u64 = 5_000;
/// How long to rest after accepting failed.
const REST_MS: u64 = 50;

/// Serves until `stopping`; what is under way goes on in `tasks`.
pub(crate) async fn accept(listener: TcpListener, router: Router, tasks: TaskTracker, stopping: CancellationToken) {
    let places = Arc::new(Semaphore::new(CONNECTIONS_MAX));
    loop {
        let Some(Ok(place)) = stopping.run_until_cancelled(Arc::clone(&places).acquire_owned()).await else { return };
        let stream = match stopping.run_until_cancelled(listener.accept()).await {
            None => return,
            Some(Ok((stream, _))) => stream,
            Some(Err(error)) => {
                tracing::warn!(%error, "a connection could not be accepted");
                tokio::time::sleep(Duration::from_millis(REST_MS)).await;
                continue;
            }
        };
        let (router, stopping) = (router.clone(), stopping.clone());
        tasks.spawn(async move {
            serve(stream, router, stopping).await;
            drop(place);
        });
    }
}

async fn serve(stream: TcpStream, router: Router, stopping: CancellationToken) {
    if let Err(error) = stream.set_nodelay(true) {
        tracing::debug!(%error, "no quick answers on this connection");
    }
    let service = TowerToHyperService::new(router);
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(Duration::from_millis(HEADER_MS));
    let mut connection = std::pin::pin!(http.serve_connection(TokioIo::new(stream), service).with_upgrades());
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
