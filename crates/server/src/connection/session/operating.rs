//! The requests of a client beside a robot: to pretend, to mark, to record, and about what was recorded.

use super::Session;
use crate::robots::ByHand;
use behaviour::{Id, Params, Value};
use protocol::{Press, Refused, Reply, Request};
use std::sync::Arc;

impl Session {
    /// Done at once, unless it waits for the disk.
    pub(super) fn operate(&self, ask: u32, request: Request) {
        let (robots, by) = (&self.state().robots, &self.me.name);
        let done = match request {
            Request::Stimulate { behaviour, robot, stream, value } => {
                let done = robots.stimulate(&behaviour, robot.as_ref(), (&stream, &value), by);
                let press = Press { pretended: true, ..self.press(robot, stream, Params::default(), value) };
                self.connections.topics.pressed(with_outcome(press, &done));
                done
            }
            Request::Mark { behaviour, robot, note, ago_ms } => {
                robots.mark(&behaviour, robot.as_ref(), by, (&note, ago_ms))
            }
            Request::EndRecording { behaviour, robot } => robots.end_recording(&behaviour, robot.as_ref(), by),
            Request::Hand { robot, device, params, value } => {
                // What no action is called like has no press that anybody could be shown.
                let press = Id::new(&device).ok().map(|what| self.press(robot.clone(), what, params.clone(), value.clone()));
                let (host, hand) = (robots.meant(robot.as_ref()), ByHand { device, params, value, by: by.clone() });
                let all = Arc::clone(&self.connections);
                return self.later(ask, async move {
                    let done = host?.hand(hand).await;
                    press.into_iter().for_each(|press| all.topics.pressed(with_outcome(press, &done)));
                    done.map(|()| Reply::Done)
                });
            }
            other => return self.on_recordings(ask, other),
        };
        self.done(ask, done);
    }

    fn press(&self, robot: Option<Id>, what: Id, params: Params, value: Value) -> Press {
        let (client, by) = (self.me.client.clone(), self.me.name.clone());
        Press { robot, client, by, what, pretended: false, params, value, why: None }
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

/// A press with what became of it.
fn with_outcome(press: Press, done: &Result<(), Refused>) -> Press {
    Press { why: done.as_ref().err().map(ToString::to_string), ..press }
}
