//! The live values and the marks of the behaviour that a client has open, at the client's own pace.

use crate::connection::Connections;
use crate::robots::{LiveValues, RunMarks, SeenLive};
use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use behaviour::Id;
use protocol::{Event, RunState};
use std::sync::Arc;

/// The part of one run that a client has seen.
#[derive(Default)]
pub(super) struct Watching {
    run: Option<WatchedRun>,
}

struct WatchedRun {
    run: u64,
    live: Option<(LiveValues, SeenLive)>,
    /// The marks, and up to which of their changes they were told.
    marks: Option<(Arc<RunMarks>, u64)>,
}

impl Watching {
    /// Returns what changed since the last call in the newest run on this robot, or on any, as messages: marks, and values if
    /// those are wanted.
    pub(super) fn news(
        &mut self,
        connections: &Connections,
        behaviour: &Id,
        (robot, values): (Option<&Id>, bool),
    ) -> Vec<Utf8Bytes> {
        let is_meant = |run: &&RunState| run.behaviour == *behaviour && robot.is_none_or(|robot| run.robot == *robot);
        let newest = connections.topics.states.borrow().iter().filter(is_meant).map(|run| run.run).max();
        let Some(run) = newest else { return Vec::new() };
        if self.run.as_ref().is_none_or(|watched| watched.run != run) {
            let robots = &connections.state.robots;
            let live = robots.values(run).map(|live| (live, SeenLive::default()));
            self.run = Some(WatchedRun { run, live, marks: robots.marks(run).map(|marks| (marks, 0)) });
        }
        let Some(watched) = &mut self.run else { return Vec::new() };
        let marks = watched.marks.as_mut().map(|(marks, seen)| (marks.since(seen), marks.now_ms()));
        let marks = marks.filter(|(marks, _)| !marks.is_empty());
        let marks = marks.map(|(marks, at_ms)| Event::LiveMarks { run, at_ms, marks });
        let live = watched.live.as_mut().filter(|_| values).and_then(|(live, seen)| live.since(seen));
        let live = live.map(|values| Event::Values { values: Box::new(values) });
        marks.into_iter().chain(live).map(encode).collect()
    }
}
