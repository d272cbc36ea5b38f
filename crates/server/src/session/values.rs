//! The live values of the behaviour that a client has open, at the client's own pace.

use crate::hub::Hub;
use crate::outbox::encode;
use crate::robots::{LiveValues, Seen};
use axum::extract::ws::Utf8Bytes;
use behaviour::Id;
use protocol::Reply;

/// What one client has seen of one run.
#[derive(Default)]
pub(super) struct Watching {
    run: Option<(u64, LiveValues, Seen)>,
}

impl Watching {
    /// What changed since the last call, as a message.
    pub(super) fn news(&mut self, hub: &Hub, behaviour: &Id) -> Option<Utf8Bytes> {
        let newest =
            hub.topics.states.borrow().iter().filter(|run| run.behaviour == *behaviour).map(|run| run.run).max();
        let newest = newest?;
        if self.run.as_ref().is_none_or(|(run, ..)| *run != newest) {
            self.run = hub.robots.values(newest).map(|live| (newest, live, Seen::default()));
        }
        let (_, live, seen) = self.run.as_mut()?;
        let values = live.since(seen)?;
        Some(encode(None, Reply::Values { values: Box::new(values) }))
    }
}
