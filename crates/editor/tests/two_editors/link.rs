//! The link of a page without a browser: what is sent waits until the world takes it onto a wire.

use editor::{EditorRequest, Link, Purpose};
use protocol::AnyRequest;
use std::collections::BTreeMap;

/// One page's end of its link.
#[derive(Default)]
pub(crate) struct PageLink {
    /// The session on the server, while the link is up.
    pub(crate) session: Option<u64>,
    /// Requests that go to the server now, each with the number of its ask, or 0 if nobody waits for an answer.
    pub(crate) outbox: Vec<(u32, AnyRequest)>,
    asked: BTreeMap<u32, Purpose>,
    asks: u32,
    /// Requests that found the link down.
    unsent: Vec<Purpose>,
}

impl Link for PageLink {
    fn send(&mut self, request: EditorRequest, purpose: Option<Purpose>) {
        match (self.session, purpose) {
            (None, purpose) => self.unsent.extend(purpose),
            (Some(_), None) => self.outbox.push((0, request.into())),
            (Some(_), Some(purpose)) => {
                self.asks += 1;
                self.asked.insert(self.asks, purpose);
                self.outbox.push((self.asks, request.into()));
            }
        }
    }
}

impl PageLink {
    /// Returns the purpose of the ask that is answered, unless nobody waits for that.
    pub(crate) fn answered(&mut self, ask: u32) -> Option<Purpose> {
        self.asked.remove(&ask)
    }

    /// Returns the purposes of what could not be sent since the last call.
    pub(crate) fn unsent(&mut self) -> Vec<Purpose> {
        std::mem::take(&mut self.unsent)
    }

    /// Loses the session and all that is not on its way yet. Returns the purposes of what was asked and is not answered.
    pub(crate) fn lose(&mut self) -> Vec<Purpose> {
        self.session = None;
        self.outbox.clear();
        std::mem::take(&mut self.asked).into_values().collect()
    }

    /// True if everything that was asked is answered.
    pub(crate) fn is_answered(&self) -> bool {
        self.asked.is_empty() && self.outbox.is_empty()
    }
}
