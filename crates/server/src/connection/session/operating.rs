//! The requests of a client beside a robot: to pretend, to mark, to record, and about what was recorded.

use super::Session;
use crate::robots::ByHand;
use protocol::{Reply, Request};

impl Session {
    /// Done at once, unless it waits for the disk.
    pub(super) fn operate(&self, ask: u32, request: Request) {
        let (robots, by) = (&self.state().robots, &self.me.name);
        let done = match request {
            Request::Stimulate { behaviour, robot, stream, value } => {
                robots.stimulate(&behaviour, robot.as_ref(), (&stream, &value), by)
            }
            Request::Mark { behaviour, robot, note, ago_ms } => {
                robots.mark(&behaviour, robot.as_ref(), by, (&note, ago_ms))
            }
            Request::EndRecording { behaviour, robot } => robots.end_recording(&behaviour, robot.as_ref(), by),
            Request::Hand { robot, device, params, value } => {
                let (host, hand) = (robots.meant(robot.as_ref()), ByHand { device, params, value, by: by.clone() });
                return self.later(ask, async move { host?.hand(hand).await.map(|()| Reply::Done) });
            }
            other => return self.on_recordings(ask, other),
        };
        self.done(ask, done);
    }

    /// The folder of the recordings, which may take its time.
    fn on_recordings(&self, ask: u32, request: Request) {
        let (state, by) = (self.state(), self.me.name.clone());
        let (recordings, robots) = (state.recordings.clone(), state.robots.clone());
        let done = |()| Reply::Done;
        let work = move || match request {
            Request::Record { behaviour, robot, session } => {
                robots.record(&behaviour, robot.as_ref(), &by, &session).map(done)
            }
            Request::RemoveRecording { file } => recordings.remove(&file).map(done),
            Request::Marks { file } => recordings.marks(&file).map(|marks| Reply::Marks { file, marks }),
            Request::PutMark { file, mark } => recordings.put_mark(&file, *mark, &by).map(done),
            _ => Ok(Reply::Recordings { recordings: recordings.list() }),
        };
        self.on_files(ask, work);
    }
}
