//! Answers that end when their reader may not be here any more.

use crate::invitations::Identified;
use axum::body::{Body, Bytes, HttpBody};
use hyper::body::{Frame, SizeHint};
use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};

/// The rest of a body, for who is in like this: for the host as it is, for a guest until their invitation ends.
pub(super) fn until_over(body: Body, entry: Identified) -> Body {
    match entry {
        Identified::Guest(_) if !body.is_end_stream() => {
            let over = Box::pin(async move { entry.until_over().await });
            Body::new(Cut { body, over })
        }
        Identified::Host | Identified::Guest(_) | Identified::Unproven | Identified::Stranger => body,
    }
}

struct Cut {
    body: Body,
    over: Pin<Box<dyn Future<Output = ()> + Send>>,
}

impl HttpBody for Cut {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        if self.over.as_mut().poll(context).is_ready() {
            return Poll::Ready(Some(Err(axum::Error::new(io::Error::from(io::ErrorKind::PermissionDenied)))));
        }
        Pin::new(&mut self.body).poll_frame(context)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}
