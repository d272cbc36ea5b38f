//! The requests of a client beside a robot: to pretend, to do something by hand, to mark.

use super::ClientSession;
use crate::robots::{ByHand, MarkPress, PressOutcome, Presser};
use behaviour::{Id, Params, Value};
use phrase::Phrased;
use protocol::{AGO_MAX_MS, HAND_MAX_BYTES, MarkEdit, RecordingMark, Refused, Request, answer, request};
use std::sync::Arc;
use std::time::{Duration, Instant};
use uuid::Uuid;

impl ClientSession {
    pub(super) fn stimulate(&mut self, of: request::Stimulate) -> Result<(), Refused> {
        let request::Stimulate { behaviour, robot, stream, value } = of;
        let presser = Presser { by: &self.me.name, stops: self.stops };
        let done = self.state().robots.stimulate(&behaviour, robot.as_ref(), (&stream, &value), presser);
        let press = protocol::Press { pretended: true, ..self.pressed(robot, stream, Params::default(), value) };
        self.connections.topics.pressed(with_outcome(press, &done));
        done
    }

    pub(super) fn hand(&self, ask: u32, of: request::Hand) {
        // A name that no action has makes no press that anybody could be shown.
        let fits = recording::json(&of.params).len() <= HAND_MAX_BYTES;
        let press = Id::new(&of.device)
            .ok()
            .filter(|_| fits)
            .map(|what| self.pressed(of.robot.clone(), what, of.params.clone(), of.value.clone()));
        let all = Arc::clone(&self.connections);
        self.later(ask, of, move |state, who, of| {
            let request::Hand { robot, device, params, value } = of;
            let (host, hand) = (state.robots.meant(robot.as_ref()), ByHand { device, params, value, by: who.name });
            async move {
                let done = host?.hand(hand, who.stops).await;
                press.into_iter().for_each(|press| all.topics.pressed(with_outcome(press, &done)));
                done
            }
        });
    }

    /// Returns the press as everyone is told of it. A value that no action would take is not told: it is of no tile.
    fn pressed(&self, robot: Option<Id>, what: Id, params: Params, value: Value) -> protocol::Press {
        let large = recording::json(&value).len() > HAND_MAX_BYTES;
        let value = if large { Value::Null } else { value };
        let (client, by) = (self.me.client.clone(), self.me.name.clone());
        protocol::Press { robot, client, by, what, pretended: false, params, value, why: None }
    }

    pub(super) fn mark(&mut self, ask: u32, of: request::Mark) {
        let request::Mark { behaviour, robot, run, id, word, sort, span, note, ago_ms } = of.clone();
        let id = id.unwrap_or_else(|| Id::from_uuid(Uuid::new_v4()));
        let (until, by, at) = (None, String::new(), String::new());
        let mark = RecordingMark { id, t: 0, until, word, sort, note, by, at, open: span, gone: false };
        let (robots, press) = (&self.state().robots, self.mark_press(ago_ms.min(AGO_MAX_MS)));
        let marked = match run {
            Some(run) => robots.mark_in(run, &mark, press).map(|marked| vec![marked]),
            None => robots.mark(&behaviour, robot.as_ref(), &mark, press),
        };
        self.marked(ask, of, marked);
    }

    pub(super) fn edit_mark(&mut self, ask: u32, of: request::EditMark) {
        // Taking back moves nothing in time: only whether it came soon after the mark counts, however long the link was lost.
        let ago_ms = if of.edit == MarkEdit::Undo { of.ago_ms } else { of.ago_ms.min(AGO_MAX_MS) };
        let press = self.mark_press(ago_ms);
        let marked = self.state().robots.edit_mark(of.run, &of.id, &of.edit, press).map(|marked| vec![marked]);
        self.marked(ask, of, marked);
    }

    fn mark_press(&self, ago_ms: u64) -> MarkPress<'_> {
        let now = Instant::now();
        let at = now.checked_sub(Duration::from_millis(ago_ms)).unwrap_or(now);
        MarkPress { by: &self.me.name, client: &self.me.client, at }
    }

    /// Answers at once. Only what comes after the end of its run waits for the disk.
    fn marked<R: Request<Answer = answer::Marked>>(
        &mut self,
        ask: u32,
        of: R,
        marked: Result<Vec<PressOutcome>, Refused>,
    ) {
        let first = |marked: Vec<PressOutcome>| {
            let PressOutcome { mark, kept, .. } = marked.into_iter().next().ok_or(Refused::NotRunning)?;
            Ok(answer::Marked { mark: Box::new(mark), kept })
        };
        match marked {
            Ok(marked) if marked.iter().any(|one| one.later.is_some()) => self.on_files(ask, of, move |state, _, _| {
                for PressOutcome { mark, later, .. } in &marked {
                    later.iter().try_for_each(|file| state.recordings.put_mark(file, mark.clone(), &mark.by))?;
                }
                first(marked)
            }),
            done => self.now(ask, of, |_, _| done.and_then(first)),
        }
    }
}

/// A press with what became of it.
fn with_outcome(press: protocol::Press, done: &Result<(), Refused>) -> protocol::Press {
    protocol::Press { why: done.as_ref().err().map(Phrased::phrase), ..press }
}
