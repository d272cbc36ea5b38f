//! Where what a run emits goes: values for actions to the robot's queue, counts to the tally.

use super::command_queue::{QueuedCommand, WantedDevice};
use super::recent::RecentReadings;
use super::runner::{RunJob, devices};
use super::tally::RunTally;
use crate::recordings::{RecordedStep, Recorder};
use behaviour::{StreamKind, Value};
use engine::{ConnectorIx, Emission, End, IndexVec, Run, StreamIx};
use robot::{Millis, Use};
use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

/// Where what a run emits goes.
pub(super) struct EmissionSink<'a> {
    /// The run.
    pub(super) job: &'a RunJob,
    /// What it counted.
    pub(super) tally: RunTally,
    /// For every actuator stream its use and device.
    uses: IndexVec<StreamIx, Option<(Use, String)>>,
    /// When the procedure that runs now began, or a little before.
    pub(super) clock: Rc<Cell<Instant>>,
    /// The connector that took too long last.
    pub(super) too_long: Option<ConnectorIx>,
    /// What is recorded, if it is.
    pub(super) recorder: Option<Recorder>,
    /// The last minutes, for who looks back.
    pub(super) recent: Arc<RecentReadings>,
    /// By stream whether it is an action's.
    acts: IndexVec<StreamIx, bool>,
    step: RecordedStep,
    /// Values that took too long in this step.
    late: u64,
    /// True if Stop ended a procedure in this step.
    cut: bool,
}

impl<'a> EmissionSink<'a> {
    /// For a run that commands these devices.
    pub(super) fn new(job: &'a RunJob, tally: RunTally, run: &Run, clock: Rc<Cell<Instant>>) -> Self {
        let acts: IndexVec<StreamIx, bool> =
            run.streams().iter().map(|info| info.kind == StreamKind::Actuator).collect();
        let mut uses: IndexVec<StreamIx, _> = acts.iter().map(|_| None).collect();
        for WantedDevice { index, stream, device, .. } in devices(run, &job.start.file) {
            if acts[index] {
                uses[index] = Some((Use { run: job.run, stream }, device));
            }
        }
        let (recorder, step) = (None, RecordedStep::default());
        let recent = Arc::default();
        Self { job, tally, uses, clock, too_long: None, recorder, recent, acts, step, late: 0, cut: false }
    }

    /// Takes what the run emits.
    pub(super) fn note(&mut self, emission: Emission) {
        self.clock.set((self.job.clock)());
        match emission {
            Emission::Value { at, stream, value, .. } => {
                self.tally.carried(stream, at.0);
                if self.recorder.is_some() && self.acts[stream] {
                    self.step.value(at.0, stream, value);
                }
                if let Some((user, device)) = &self.uses[stream] {
                    let command = QueuedCommand { cancel: self.job.cancel.clone(), value: value.clone() };
                    self.job.shared.queue.command(user.clone(), device, command);
                }
            }
            Emission::Fault { at, connector, error, deadline, .. } => {
                self.tally.failed();
                if self.recorder.is_some() {
                    self.step.fault(at.0, connector, error.to_string());
                }
                if deadline {
                    self.too_long = Some(connector);
                    self.late += 1;
                    self.cut |= self.job.cancel.is_cancelled();
                }
            }
        }
    }

    /// A reading is about to be fed.
    pub(super) fn reading(&mut self, at: Millis, stream: StreamIx, value: &Value, by: Option<&Arc<str>>) {
        if !value.is_finite() {
            return;
        }
        self.recent.reading(at.0, stream, value, by);
        if self.recorder.as_ref().is_some_and(Recorder::has_readings) {
            match by {
                Some(by) => self.step.pretended(at.0, stream, value, by),
                None => self.step.value(at.0, stream, value),
            }
        }
    }

    /// What was fed last was carried to its end, unless Stop cut it short; then nobody knows what it would have done.
    pub(super) fn settle(&mut self, run: &Run) -> bool {
        let cut = std::mem::take(&mut self.cut) || run.ended() == Some(End::Stopped);
        let late = std::mem::take(&mut self.late);
        match &mut self.recorder {
            Some(recorder) if cut => recorder.forget(&mut self.step),
            Some(recorder) => recorder.take(&mut self.step, late),
            None => {}
        }
        !cut
    }

    /// All instants up to one are closed: what that emitted was carried to its end, unless Stop cut it short.
    pub(super) fn settle_until(&mut self, run: &Run, closed_ms: u64) {
        if self.settle(run)
            && let Some(recorder) = &mut self.recorder
        {
            recorder.closed(closed_ms);
        }
    }

    /// Hands on what was recorded, and ends the recording if that is wanted.
    pub(super) fn record(&mut self, ends: Option<String>) {
        let Some(recorder) = &mut self.recorder else { return };
        recorder.flush();
        if let Some(news) = recorder.news() {
            self.job.shared.recorded(self.job.run, Some(news));
        }
        if let Some(by) = ends {
            self.end_recording("the recording was ended", Some(by));
            self.job.shared.recorded(self.job.run, None);
        }
    }

    /// Writes the last line.
    pub(super) fn end_recording(&mut self, why: &str, by: Option<String>) {
        if let Some(recorder) = self.recorder.take() {
            recorder.end(why, by);
        }
    }
}
