//! The live values of the behaviour that a client has open, at the client's own pace.

use crate::connection::Connections;
use crate::robots::{LiveValues, Seen};
use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use behaviour::Id;
use protocol::{Reply, RunState};

/// What one client has seen of one run.
#[derive(Default)]
pub(super) struct Watching {
    run: Option<(u64, LiveValues, Seen)>,
}

impl Watching {
    /// What changed since the last call in the newest run on this robot, or on any, as a message.
    pub(super) fn news(&mut self, connections: &Connections, behaviour: &Id, robot: Option<&Id>) -> Option<Utf8Bytes> {
        let is_meant = |run: &&RunState| run.behaviour == *behaviour && robot.is_none_or(|robot| run.robot == *robot);
        let newest = connections.topics.states.borrow().iter().filter(is_meant).map(|run| run.run).max()?;
        if self.run.as_ref().is_none_or(|(run, ..)| *run != newest) {
            self.run = connections.state.robots.values(newest).map(|live| (newest, live, Seen::default()));
        }
        let (_, live, seen) = self.run.as_mut()?;
        let values = live.since(seen)?;
        Some(encode(None, Reply::Values { values: Box::new(values) }))
    }
}
