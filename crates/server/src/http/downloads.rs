//! Downloads: a few at once, shared out between people, each kept only until it was taken. A reader that stops reading loses
//! its place to another download of the same person, and its connection soon.

use crate::invitations::Identified;
use crate::support::shares::{ShareLimits, SharedPlace, SharedPlaces};
use axum::body::{Body, Bytes, HttpBody};
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use hyper::body::{Frame, SizeHint};
use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

/// Downloads that may be under way. One of which nothing was taken for two seconds gives way to another of the same person.
const DOWNLOADS: ShareLimits = ShareLimits { all: 8, guest: 2, host: 8, reserved: 2, still_ms: 2_000 };
/// What who comes beyond that is told.
const TOO_MANY: &str = "Too much is being downloaded just now. Try again in a moment.\n";

/// The places for downloads.
#[derive(Clone, Debug)]
pub(crate) struct Downloads(Arc<SharedPlaces>);

impl Default for Downloads {
    fn default() -> Self {
        Self(SharedPlaces::within(DOWNLOADS))
    }
}

/// Answers if there is a place, which is free again once the answer was sent to its end or given up.
pub(crate) async fn few_at_once(State(downloads): State<Downloads>, request: Request, next: Next) -> Response {
    let person = request.extensions().get::<Identified>().unwrap_or(&Identified::Stranger).identity();
    let too_many = || (StatusCode::SERVICE_UNAVAILABLE, TOO_MANY).into_response();
    let Some(place) = downloads.0.take(&person) else { return too_many() };
    let Some(answer) = place.hold(next.run(request)).await else { return too_many() };
    let lost = Box::pin(place.loss().cancelled_owned());
    answer.map(|body| Body::new(HeldBody { body, lost, place }))
}

/// A body with the place that it takes.
struct HeldBody {
    body: Body,
    lost: Pin<Box<dyn Future<Output = ()> + Send>>,
    place: SharedPlace,
}

impl HttpBody for HeldBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        if self.lost.as_mut().poll(context).is_ready() {
            return Poll::Ready(Some(Err(axum::Error::new(io::Error::from(io::ErrorKind::TimedOut)))));
        }
        let next = Pin::new(&mut self.body).poll_frame(context);
        if next.is_ready() {
            self.place.moved();
        }
        next
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}
