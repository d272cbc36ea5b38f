//! The requests of a client beside a robot: to pretend, to mark, to record, and about what was recorded.

use super::ClientSession;
use crate::robots::{ByHand, MarkPress, PressOutcome};
use behaviour::{Id, Params, Value};
use protocol::{AGO_MAX_MS, HAND_MAX_BYTES, RecordingMark, Refused, Reply, Request};
use std::sync::Arc;
use std::time::{Duration, Instant};
use uuid::Uuid;

impl ClientSession {
    /// Done at once, unless it waits for the disk.
    pub(super) fn operate(&self, ask: u32, request: Request) {
        let (robots, by) = (&self.state().robots, &self.me.name);
        let done = match request {
            Request::Stimulate { behaviour, robot, stream, value } => {
                let done = robots.stimulate(&behaviour, robot.as_ref(), (&stream, &value), by);
                let press =
                    protocol::Press { pretended: true, ..self.pressed(robot, stream, Params::default(), value) };
                self.connections.topics.pressed(with_outcome(press, &done));
                done
            }
            Request::Mark { .. } | Request::EditMark { .. } => return self.mark(ask, request),
            Request::EndRecording { behaviour, robot } => robots.end_recording(&behaviour, robot.as_ref(), by),
            Request::Hand { robot, device, params, value } => {
                // A name that no action has makes no press that anybody could be shown.
                let fits = recording::json(&params).len() <= HAND_MAX_BYTES;
                let press = Id::new(&device)
                    .ok()
                    .filter(|_| fits)
                    .map(|what| self.pressed(robot.clone(), what, params.clone(), value.clone()));
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

    /// Returns the press as everyone is told of it. A value that no action would take is not told: it is of no tile.
    fn pressed(&self, robot: Option<Id>, what: Id, params: Params, value: Value) -> protocol::Press {
        let large = recording::json(&value).len() > HAND_MAX_BYTES;
        let value = if large { Value::Null } else { value };
        let (client, by) = (self.me.client.clone(), self.me.name.clone());
        protocol::Press { robot, client, by, what, pretended: false, params, value, why: None }
    }

    /// Marks at once. Only what comes after the end of its run waits for the disk.
    fn mark(&self, ask: u32, request: Request) {
        let (robots, by) = (&self.state().robots, &self.me.name);
        let press = |ago_ms: u64| {
            let now = Instant::now();
            MarkPress { by, at: now.checked_sub(Duration::from_millis(ago_ms.min(AGO_MAX_MS))).unwrap_or(now) }
        };
        let marked = match request {
            Request::Mark { behaviour, robot, run, id, word, sort, span, note, ago_ms } => {
                let id = id.unwrap_or_else(|| Id::from_uuid(Uuid::new_v4()));
                let (until, by, at) = (None, String::new(), String::new());
                let mark = RecordingMark { id, t: 0, until, word, sort, note, by, at, open: span, gone: false };
                match run {
                    Some(run) => robots.mark_in(run, &mark, press(ago_ms)).map(|marked| vec![marked]),
                    None => robots.mark(&behaviour, robot.as_ref(), &mark, press(ago_ms)),
                }
            }
            Request::EditMark { run, id, edit, ago_ms } => {
                robots.edit_mark(run, &id, &edit, press(ago_ms)).map(|marked| vec![marked])
            }
            _ => Err(Refused::NotRunning),
        };
        let answer = |PressOutcome { mark, kept, .. }| Reply::Marked { mark: Box::new(mark), kept };
        match marked {
            Ok(marked) if marked.iter().any(|one| one.later.is_some()) => {
                let recordings = self.state().recordings.clone();
                self.on_files(ask, move || {
                    for PressOutcome { mark, later, .. } in &marked {
                        later.iter().try_for_each(|file| recordings.put_mark(file, mark.clone(), &mark.by))?;
                    }
                    marked.into_iter().next().map(answer).ok_or(Refused::NotRunning)
                });
            }
            done => {
                let first = done.and_then(|marked| marked.into_iter().next().ok_or(Refused::NotRunning));
                self.outbox.say(Some(ask), first.map_or_else(|no| Reply::No { no }, answer));
            }
        }
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
            Request::PutMark { file, mark } => recordings.change_mark(&file, *mark, &by).map(done),
            _ => Ok(Reply::Recordings { recordings: recordings.list() }),
        };
        self.on_files(ask, work);
    }
}

/// A press with what became of it.
fn with_outcome(press: protocol::Press, done: &Result<(), Refused>) -> protocol::Press {
    protocol::Press { why: done.as_ref().err().map(ToString::to_string), ..press }
}
