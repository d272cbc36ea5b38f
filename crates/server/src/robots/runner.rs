//! The thread of one run: builds the behaviour, opens its devices, and moves it through logical time until it ends.

use super::cancel_flag::CancelFlag;
use super::command_queue::{ByHand, OpeningRun, WantedDevice};
use super::emission_sink::EmissionSink;
use super::host::StartOrder;
use super::live::LiveValues;
use super::mailbox::{Arrived, Beginning, DoneByHand, Post, ReadingsKept, RunMailbox, Undone};
use super::recent::RecentReadings;
use super::refusal::{RunFailure, StartError};
use super::run_marks::{RunMarks, ToldMark};
use super::run_table::{Applying, PausedMemory, RunEntry, RunSenses};
use super::shared::RobotShared;
use super::successor::{RunHandover, Successor};
use super::surroundings::RecordedSurroundings;
use super::tally::RunTally;
use super::told_times::ToldTimes;
use crate::recordings::{About, NotRecorded, Recorder, Recordings};
use crate::support::lock;
use behaviour::{BehaviourFile, Id, StreamKind};
use engine::{Claim, Limits, Matching, Run};
use phrase::Phrased;
use protocol::{RecordingMark, RunPhase, RunState};
use recording::{Hand, NoteLine, RefusedLine};
use robot::Millis;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::sync_channel;
use std::time::{Duration, Instant};
use tokio::sync::oneshot;

/// The longest a procedure may take, in milliseconds.
pub(super) const PROCEDURE_MAX_MS: u64 = 20;
/// After so many calls of one procedure in a row that took too long the behaviour ends.
const TOO_LONG_MAX_CALLS: u32 = 3;
/// The longest the robot may take to open the devices, in milliseconds.
const OPEN_MAX_MS: u64 = 3_000;
/// The longest that a Start waits for a robot that is being reached just now, and how often it looks, in milliseconds.
const CONNECT_MAX_MS: u64 = 5_000;
const LOOK_MS: u64 = 10;

/// A run to be.
pub(super) struct RunJob {
    /// Its number.
    pub(super) run: u64,
    /// What to run.
    pub(super) start: StartOrder,
    /// What cancels it.
    pub(super) cancel: Arc<CancelFlag>,
    /// What it shares with the robot's thread and the server.
    pub(super) shared: Arc<RobotShared>,
    /// Where it is recorded, if it is.
    pub(super) recordings: Recordings,
    /// Limits of procedures; the hook comes on top.
    pub(super) limits: fn() -> Limits,
    /// The clock of logical time.
    pub(super) clock: fn() -> Instant,
}

/// How a run ended.
pub(super) enum RunnerEnd {
    /// By itself, with the reason.
    Fault(RunFailure),
    /// It was stopped, or did not come to be.
    Stopped,
    /// Another one goes on with its number and its devices.
    Followed,
}

/// Runs to the end; `answer` hears whether it began. A panic ends this behaviour only.
pub(super) fn run(job: &RunJob, answer: oneshot::Sender<Result<RunState, StartError>>) {
    let done = catch_unwind(AssertUnwindSafe(|| match prepare(job) {
        Ok((runner, state)) => {
            drop(answer.send(Ok(state)));
            runner.work()
        }
        Err(reason) => {
            drop(answer.send(Err(reason)));
            RunnerEnd::Stopped
        }
    }));
    clear_away(job, done.ok());
}

/// Works to the end, in place of a run that was followed.
pub(super) fn work(job: &RunJob, runner: Runner) {
    clear_away(job, catch_unwind(AssertUnwindSafe(|| runner.work())).ok());
}

fn clear_away(job: &RunJob, end: Option<RunnerEnd>) {
    let shared = &job.shared;
    let reason = match end {
        Some(RunnerEnd::Followed) => return,
        Some(RunnerEnd::Fault(reason)) => reason,
        // A run that was stopped keeps that as its end; without a reason it came too late for the one who waited.
        Some(RunnerEnd::Stopped) => RunFailure::Late,
        None => RunFailure::Inside,
    };
    lock(&shared.table).withdraw(job.run);
    shared.fault(job.run, &reason);
    job.cancel.cancel();
    shared.queue.close(job.run);
}

fn prepare(job: &RunJob) -> Result<(Runner<'_>, RunState), StartError> {
    let clock = Rc::new(Cell::new(Instant::now()));
    let run = build(job, &clock)?;
    let mailbox = Arc::new(RunMailbox::default());
    let devices = devices(&run, &job.start.file);
    wait_for_robot(job);
    open(job, &mailbox, devices.clone(), false)?;
    begin(job, run, mailbox, &devices, clock)
}

/// Begins a run whose devices are open, where the robot interrupted it if it did.
pub(super) fn begin<'a>(
    job: &'a RunJob,
    run: Run,
    mailbox: Arc<RunMailbox>,
    devices: &[WantedDevice],
    clock: Rc<Cell<Instant>>,
) -> Result<(Runner<'a>, RunState), StartError> {
    let mut entry = entry(job, &run, &mailbox, devices);
    let tally = RunTally::new(entry.live.clone(), &run);
    let mut runner = Runner::new(job, run, mailbox, tally, clock);
    job.shared.order.add(&job.start.behaviour).map_err(StartError::Unordered)?;
    runner.sink.recorder = recorder(job)?;
    entry.state.recording = runner.sink.recorder.as_mut().and_then(Recorder::news);
    runner.began = (job.clock)();
    let kept = lock(&job.shared.table).take_memory(&job.start.behaviour);
    let before = kept.map(|kept| runner.go_on(kept)).unwrap_or_default();
    let memory = (runner.open_ms > 0).then(|| runner.run.handover());
    runner.sink.recent.begin((&job.start.file, job.start.revision), memory, (runner.began, runner.open_ms), false);
    entry.recent = runner.sink.recent.clone();
    entry.marks.begin(runner.began, before);
    runner.marks = entry.marks.clone();
    let state = entry.state.clone();
    if job.shared.begin(entry) {
        return Ok((runner, state));
    }
    runner.sink.end_recording(&StartError::StoppedBefore.to_string(), None);
    Err(StartError::StoppedBefore)
}

/// Somebody has just added the robot, or changed its address: then there is no link for a moment, and that is no reason to
/// refuse a Start. A robot that is not found by then says so itself.
fn wait_for_robot(job: &RunJob) {
    let until = Instant::now() + Duration::from_millis(CONNECT_MAX_MS);
    while job.shared.feed.is_connecting(&job.shared.robot) && !job.cancel.is_cancelled() && Instant::now() < until {
        std::thread::sleep(Duration::from_millis(LOOK_MS));
    }
}

fn recorder(job: &RunJob) -> Result<Option<Recorder>, NotRecorded> {
    let StartOrder { behaviour, revision, file, record, by, session, .. } = &job.start;
    let robot = &job.shared.feed.name(&job.shared.robot);
    let about = About { run: job.run, robot, behaviour, revision: *revision, by, file, session };
    record.then(|| job.recordings.begin(&about)).transpose()
}

/// Compiles what is to run. `clock` says when the procedure that runs began.
pub(super) fn build(job: &RunJob, clock: &Rc<Cell<Instant>>) -> Result<Run, StartError> {
    let cancel = job.cancel.clone();
    let limits = (job.limits)().interrupted_by(interrupt(job.cancel.clone(), clock.clone(), job.clock));
    let limits = limits.stopped_by(move || cancel.is_cancelled());
    Run::build(&job.start.file, limits).map_err(StartError::Faults)
}

/// Ends a procedure at its deadline, or at once when the run is stopped.
fn interrupt(cancel: Arc<CancelFlag>, clock: Rc<Cell<Instant>>, now: fn() -> Instant) -> impl Fn() -> bool {
    let deadline = Duration::from_millis(PROCEDURE_MAX_MS);
    move || cancel.is_cancelled() || now().saturating_duration_since(clock.get()) > deadline
}

/// The devices it uses, actions before senses, each in file order.
pub(super) fn devices(run: &Run, file: &BehaviourFile) -> Vec<WantedDevice> {
    let of = |kind: StreamKind| {
        run.streams().enumerate().filter(move |(_, info)| info.kind == kind).filter_map(|(index, info)| {
            let (stream, device) = (Id::new(&info.id).ok()?, info.device.clone()?);
            let (claim, params) = (Claim::of(&file.streams[index.index()]), info.params.clone());
            Some(WantedDevice { stream, index, name: info.name.clone(), device, params, claim })
        })
    };
    of(StreamKind::Actuator).chain(of(StreamKind::Sensor)).collect()
}

/// Asks the robot for devices; a run that follows another takes over the other's.
pub(super) fn open(
    job: &RunJob,
    mailbox: &Arc<RunMailbox>,
    devices: Vec<WantedDevice>,
    follows: bool,
) -> Result<(), StartError> {
    let (answer, opened) = sync_channel(1);
    let behaviour = (job.start.behaviour.clone(), job.start.file.name.clone());
    let (cancel, mailbox) = (job.cancel.clone(), mailbox.clone());
    job.shared.queue.open(OpeningRun { run: job.run, behaviour, cancel, mailbox, devices, follows, answer });
    let waited = opened.recv_timeout(Duration::from_millis(OPEN_MAX_MS));
    waited.unwrap_or(Err(StartError::Silent))
}

/// The sensor streams among the devices.
pub(super) fn senses(run: &Run, devices: &[WantedDevice]) -> RunSenses {
    let is_sense =
        |wanted: &&WantedDevice| run.streams().get(wanted.index).is_some_and(|s| s.kind == StreamKind::Sensor);
    let of = |wanted: &WantedDevice| (wanted.stream.clone(), (wanted.index, ReadingsKept::of(&wanted.device)));
    devices.iter().filter(is_sense).map(of).collect()
}

/// True if it can move the robot.
pub(super) fn acts(run: &Run, devices: &[WantedDevice]) -> bool {
    senses(run, devices).len() < devices.len()
}

fn entry(job: &RunJob, run: &Run, mailbox: &Arc<RunMailbox>, devices: &[WantedDevice]) -> RunEntry {
    let start = &job.start;
    RunEntry {
        state: RunState {
            run: job.run,
            robot: job.shared.robot.clone(),
            behaviour: start.behaviour.clone(),
            name: start.file.name.clone(),
            revision: start.revision,
            fingerprint: start.file.fingerprint(),
            by: start.by.clone(),
            revoked: false,
            phase: RunPhase::Running,
            recording: None,
            place: 0,
            held: Vec::new(),
        },
        cancel: job.cancel.clone(),
        mailbox: mailbox.clone(),
        live: LiveValues::new(job.run, run.streams().len(), run.connectors().len()),
        marks: Arc::default(),
        recent: Arc::default(),
        acts: acts(run, devices),
        senses: senses(run, devices),
        file: start.file.clone(),
        applying: Applying::default(),
        invitation: start.invitation.clone(),
    }
}

/// A run that has begun.
pub(super) struct Runner<'a> {
    run: Run,
    mailbox: Arc<RunMailbox>,
    sink: EmissionSink<'a>,
    began: Instant,
    /// The next instant that still takes readings; everything before is closed.
    open_ms: u64,
    /// Who follows, as soon as no frame is open.
    successor: Option<Successor>,
    /// The times that its senses told last.
    times: ToldTimes,
    /// The state of the robot and its room, as a recording has it.
    surroundings: RecordedSurroundings,
    /// The marks that people make meanwhile.
    marks: Arc<RunMarks>,
    /// The marks with which the recording began, until the next word of each: one that was on its way here then is not written twice.
    begun_with: Vec<RecordingMark>,
}

impl<'a> Runner<'a> {
    /// A run whose logical time begins now.
    pub(super) fn new(
        job: &'a RunJob,
        run: Run,
        mailbox: Arc<RunMailbox>,
        tally: RunTally,
        clock: Rc<Cell<Instant>>,
    ) -> Self {
        let sink = EmissionSink::new(job, tally, &run, clock);
        let (surroundings, begun_with) = (RecordedSurroundings::default(), Vec::new());
        let (marks, times, began) = (Arc::default(), ToldTimes::of(&run), (job.clock)());
        Self { run, mailbox, sink, began, open_ms: 0, successor: None, times, surroundings, marks, begun_with }
    }

    /// This run with the time, the marks, the times that were told, and the recording of the run that it follows.
    pub(super) fn since(
        mut self,
        (began, open_ms): (Instant, u64),
        (marks, times): (Arc<RunMarks>, &ToldTimes),
        recorder: Option<Recorder>,
    ) -> Self {
        (self.began, self.open_ms, self.marks) = (began, open_ms, marks);
        self.times = self.times.since(times);
        if let Some(mut recorder) = recorder {
            let start = &self.sink.job.start;
            recorder.applied(open_ms.saturating_sub(1), start.revision, &start.file);
            self.sink.recorder = Some(recorder);
        }
        self
    }

    /// This run with the last minutes of the run that it follows.
    pub(super) fn looked_back_at(mut self, recent: Arc<RecentReadings>) -> Self {
        self.sink.recent = recent;
        self
    }

    /// Where the robot interrupted it: what did not change meanwhile keeps its memory, and logical time continues. Answers with
    /// its marks.
    fn go_on(&mut self, kept: PausedMemory) -> Vec<ToldMark> {
        self.run.resume_from(kept.memory, &Matching::between(&kept.file, &self.sink.job.start.file));
        self.times = std::mem::take(&mut self.times).since(&kept.times);
        self.open_ms = kept.open_ms;
        self.began = self.began.checked_sub(Duration::from_millis(kept.open_ms)).unwrap_or(self.began);
        if let Some(recorder) = &mut self.sink.recorder {
            recorder.memory(self.open_ms, self.run.handover());
        }
        kept.marks.kept()
    }

    /// What an interrupted run remembers, unless it was in the middle of a frame.
    fn keep_memory(&self) {
        if self.run.is_between() {
            let job = self.sink.job;
            let memory = || PausedMemory {
                file: job.start.file.clone(),
                memory: self.run.handover(),
                open_ms: self.open_ms,
                times: self.times.clone(),
                marks: Arc::clone(&self.marks),
            };
            lock(&job.shared.table).keep_memory(job.run, memory);
        }
    }

    /// Works until it is cancelled, it ends by itself or another one follows.
    fn work(mut self) -> RunnerEnd {
        let mut reason = None;
        while reason.is_none() && !self.sink.job.cancel.is_cancelled() {
            let post = self.mailbox.take(self.next_wake());
            reason = self.turn(post);
            if reason.is_none()
                && let Some(successor) = self.follower()
            {
                return self.hand_over(successor);
            }
            self.sink.tally.tell(&self.run, self.now_ms(), false);
        }
        self.finish(reason)
    }

    /// Takes what came, and closes the instants up to now; answers with why it ends by itself, if it does.
    pub(super) fn turn(&mut self, post: Post) -> Option<RunFailure> {
        let Post { readings, refused, undone, hands, successor, marks, begin_recording, end_recording } = post;
        // The rest of the post may have come after the recording.
        self.begin_recording(begin_recording);
        for reading in readings {
            self.feed(reading);
        }
        self.sink.tally.refused(refused);
        self.successor = self.successor.take().or(successor);
        self.close_instants();
        self.undone(undone);
        self.hands(hands);
        self.mark(marks);
        self.look_around();
        self.sink.record(end_recording);
        self.failure()
    }

    /// Comes to its end.
    pub(super) fn finish(mut self, reason: Option<RunFailure>) -> RunnerEnd {
        // A request that was answered just before the end counts.
        let ended = self.marks.close(self.now_ms());
        let last = self.mailbox.take(Some(Instant::now()));
        self.begin_recording(last.begin_recording);
        self.undone(last.undone);
        self.hands(last.hands);
        self.mark(last.marks);
        self.mark(ended);
        self.sink.tally.tell(&self.run, self.now_ms(), true);
        self.sink.recent.end((self.sink.job.clock)());
        let (run, dropped) = (self.sink.job.run, self.mailbox.dropped());
        tracing::debug!(run, dropped, "a run ended");
        if reason.is_none() {
            self.keep_memory();
        }
        self.end_recording(reason.as_ref());
        reason.map_or(RunnerEnd::Stopped, RunnerEnd::Fault)
    }

    /// Writes the last line of its recording: why it ended, and who ended it.
    fn end_recording(&mut self, reason: Option<&RunFailure>) {
        let job = self.sink.job;
        let by = job.cancel.stopped_by().map(str::to_owned);
        let halt = lock(&job.shared.table).halted(job.run);
        if let (Some(halt), Some(recorder)) = (&halt, &mut self.sink.recorder) {
            self.surroundings.halt(job, &halt.to_string(), self.open_ms, recorder);
        }
        let why = reason
            .map(RunFailure::to_string)
            .or(halt.map(|halt| halt.to_string()))
            .unwrap_or_else(|| "it was stopped".to_owned());
        self.sink.end_recording(&why, by.filter(|_| reason.is_none()));
    }

    /// True if it is recorded.
    #[cfg(test)]
    pub(super) fn is_recorded(&self) -> bool {
        self.sink.recorder.is_some()
    }

    /// Returns the run that follows, if another run may follow just now.
    pub(super) fn follower(&mut self) -> Option<Successor> {
        let may_follow = self.run.is_between() && !self.sink.job.cancel.is_cancelled();
        self.successor.take_if(|_| may_follow)
    }

    pub(super) fn hand_over(self, to: Successor) -> RunnerEnd {
        let handover = RunHandover {
            memory: self.run.handover(),
            tally: self.sink.tally,
            recorder: self.sink.recorder,
            marks: self.marks,
            times: self.times,
            recent: self.sink.recent,
            began: self.began,
            open_ms: self.open_ms,
        };
        if to.take(handover) { RunnerEnd::Followed } else { RunnerEnd::Fault(RunFailure::NotFollowed) }
    }

    /// The live rule: a reading counts when it arrived, but never in an instant that is closed.
    fn feed(&mut self, reading: Arrived) {
        if self.sink.job.cancel.is_cancelled() || self.run.ended().is_some() {
            return;
        }
        if reading.by.is_none() && !self.times.is_news(reading.stream, &reading.value) {
            return;
        }
        let arrived_ms = self.ms_at(reading.at);
        self.open_ms = self.open_ms.max(arrived_ms);
        self.close_before_reading();
        let (sink, at) = (&mut self.sink, Millis(self.open_ms));
        sink.reading(at, reading.stream, &reading.value, reading.by.as_ref());
        // After that, which may wait for who looks back.
        sink.clock.set((sink.job.clock)());
        let told = reading.value.clone();
        self.run.feed(at, reading.stream, reading.value, &mut |emission| sink.note(emission));
        if sink.settle(&self.run) && !sink.job.cancel.is_cancelled() {
            self.times.note(reading.stream, told);
        }
    }

    /// What is due before a reading comes before it in the recording too.
    fn close_before_reading(&mut self) {
        let sink = &mut self.sink;
        if let (Some(_), Some(before)) = (&sink.recorder, self.open_ms.checked_sub(1)) {
            sink.clock.set((sink.job.clock)());
            self.run.until(Millis(before), &mut |emission| sink.note(emission));
            sink.settle_until(&self.run, before);
        }
    }

    /// Closes the instants up to now: their ticks run. An instant that is ahead of its time stays open, however many
    /// readings it takes, so that logical time does not run away; only another run that goes on here closes it.
    fn close_instants(&mut self) {
        let until_ms = if self.successor.is_some() { self.now_ms().max(self.open_ms) } else { self.now_ms() };
        if until_ms < self.open_ms || self.sink.job.cancel.is_cancelled() {
            return;
        }
        let sink = &mut self.sink;
        sink.clock.set((sink.job.clock)());
        self.run.until(Millis(until_ms), &mut |emission| sink.note(emission));
        sink.settle_until(&self.run, until_ms);
        self.open_ms = until_ms + 1;
        let run = &self.run;
        let may = run.is_between() && run.ended().is_none();
        let due_ms = run.next_due().map(|due| due.0);
        sink.recent.closed(until_ms, due_ms, || may.then(|| run.handover()));
    }

    /// Records marks that are new or changed.
    fn mark(&mut self, marks: Vec<RecordingMark>) {
        if let Some(recorder) = &mut self.sink.recorder {
            for mark in marks {
                let written = self.begun_with.iter().position(|known| known.id == mark.id);
                if written.map(|at| self.begun_with.swap_remove(at)).as_ref() != Some(&mark) {
                    recorder.note(NoteLine::from(mark));
                }
            }
        }
    }

    /// Records what the robot did not do.
    fn undone(&mut self, undone: BTreeMap<Undone, (Instant, u64)>) {
        for (Undone { stream, why, with }, (at, count)) in undone {
            let (at_ms, count) = (self.ms_at(at), Some(count).filter(|count| *count > 1));
            if let Some(recorder) = &mut self.sink.recorder {
                recorder.refused(RefusedLine { at_ms, refused: stream, why, with, count });
            }
        }
    }

    /// Records what people had the robot do beside it.
    fn hands(&mut self, hands: Vec<DoneByHand>) {
        for DoneByHand { at, hand: ByHand { device, params, value, by }, why } in hands {
            let at_ms = self.ms_at(at);
            if let Some(recorder) = &mut self.sink.recorder {
                recorder.hand(Hand { at_ms, hand: device, params, value, by, why });
            }
        }
    }

    /// Is recorded from here on: what it remembers comes first, so that the recording alone gives its actions again. The marks
    /// that were made before are kept too.
    fn begin_recording(&mut self, beginning: Option<Beginning>) {
        let Some(Beginning { mut recorder, file }) = beginning else { return };
        let start = &self.sink.job.start;
        if !Arc::ptr_eq(&file, &start.file) {
            recorder.applied(self.open_ms.saturating_sub(1), start.revision, &start.file);
        }
        recorder.memory(self.open_ms, self.run.handover());
        self.surroundings = RecordedSurroundings::default();
        self.sink.recorder = Some(recorder);
        let all = self.marks.all();
        self.begun_with.clear();
        self.mark(all.clone());
        self.begun_with = all;
    }

    /// Records how the robot and its room are, if that is new.
    fn look_around(&mut self) {
        let at_ms = self.now_ms();
        if let Some(recorder) = &mut self.sink.recorder {
            self.surroundings.look(self.sink.job, at_ms, recorder);
        }
    }

    fn next_wake(&self) -> Option<Instant> {
        let due = self.run.next_due().map(|due| self.began + Duration::from_millis(due.0));
        let recorder = self.sink.recorder.as_ref();
        let recorded = recorder.and_then(Recorder::next_look).map(|look| Instant::now() + look);
        let around = recorder.and(self.surroundings.next_ms()).map(|ms| self.began + Duration::from_millis(ms));
        [due, self.sink.tally.next_telling(), recorded, around].into_iter().flatten().min()
    }

    /// Why it ends by itself now, if it does.
    fn failure(&mut self) -> Option<RunFailure> {
        let fault = self.run.fault().map(|reason| RunFailure::Engine(reason.phrase()));
        fault.or_else(|| self.took_too_long())
    }

    fn took_too_long(&mut self) -> Option<RunFailure> {
        let connector = self.sink.too_long.take()?;
        let in_a_row = self.run.stats().connectors.get(connector)?.deadlines_in_a_row;
        let info = self.run.connectors().get(connector)?;
        let name = &self.run.streams().get(info.output)?.name;
        (in_a_row >= TOO_LONG_MAX_CALLS).then(|| RunFailure::TooLong(name.clone()))
    }

    fn now_ms(&self) -> u64 {
        self.ms_at((self.sink.job.clock)())
    }

    fn ms_at(&self, at: Instant) -> u64 {
        u64::try_from(at.saturating_duration_since(self.began).as_millis()).unwrap_or(u64::MAX)
    }
}
