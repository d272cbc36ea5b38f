//! How a link to a client ends: once, for one reason, which both of its tasks learn.

use std::sync::Arc;
use tokio::sync::watch;

/// Why a link ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CloseReason {
    /// The client went.
    Left,
    /// A new link of the same client took over.
    Replaced,
    /// Another page of the same person took its place.
    GaveWay,
    /// The greeting was missing or of another version.
    Unwelcome,
    /// A message was too large or none of ours.
    TooLarge,
    /// The invitation ended by which the client came.
    Revoked,
    /// The server ends.
    Restart,
    /// The client takes too slowly: it has to fetch everything anew.
    Resync,
}

impl CloseReason {
    /// Whether the client is still there and has to hear why it ends.
    pub(crate) fn is_told(self) -> bool {
        match self {
            Self::Replaced | Self::GaveWay | Self::Revoked | Self::Restart | Self::Resync => true,
            Self::Left | Self::Unwelcome | Self::TooLarge => false,
        }
    }

    /// The code and the word of the closing frame.
    pub(crate) fn words(self) -> (u16, &'static str) {
        match self {
            Self::Left => (1000, "bye"),
            Self::Replaced => (4000, "replaced"),
            Self::GaveWay => (protocol::CLOSE_GAVE_WAY, "gave way"),
            Self::Unwelcome => (1008, "unwelcome"),
            Self::Revoked => (protocol::CLOSE_REVOKED, "revoked"),
            Self::TooLarge => (1009, "too large"),
            Self::Restart => (1012, "restart"),
            Self::Resync => (1013, "resync"),
        }
    }
}

/// Ends a link; the first reason stays.
#[derive(Clone, Debug)]
pub(crate) struct CloseSignal(Arc<watch::Sender<Option<CloseReason>>>);

impl CloseSignal {
    /// The link is not closed yet.
    pub(crate) fn new() -> Self {
        Self(Arc::new(watch::Sender::new(None)))
    }

    /// Closes the link, unless that was done already.
    pub(crate) fn with(&self, why: CloseReason) {
        self.0.send_if_modified(|now| {
            let first = now.is_none();
            now.get_or_insert(why);
            first
        });
    }

    /// Waits until the link is closed.
    pub(crate) async fn wait(&self) -> CloseReason {
        let mut seen = self.0.subscribe();
        let why = seen.wait_for(Option::is_some).await.ok().and_then(|why| *why);
        why.unwrap_or(CloseReason::Left)
    }
}
