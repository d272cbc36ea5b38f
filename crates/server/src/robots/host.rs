//! One robot and what runs on it: a thread for the robot, one for every running behaviour, and a Stop that waits for
//! none of them.

use super::cancel_flag::CancelFlag;
use super::command_queue::{ByHand, Controlling, Handing};
use super::live::LiveValues;
use super::mailbox::Beginning;
use super::order::RobotOrder;
use super::recent::RecentReadings;
use super::refusal::{NotByHand, StartError};
use super::robot_thread::{self, Make};
use super::run_marks::{MarkPress, PressOutcome, RunMarks};
use super::run_table;
use super::runner::{self, RunJob};
use super::shared::RobotShared;
use super::status_feed::StatusFeed;
use super::stops::Presser;
use super::successor;
use crate::recordings::{About, Recordings};
use crate::support::lock;
use crate::support::priority::{self, Priority};
use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use behaviour::{BehaviourFile, Id, Value};
use engine::Limits;
use phrase::{Phrased, phrase};
use protocol::{HAND_MAX_BYTES, MarkEdit, RecordedSession, RecordingMark, Refused, RobotState, RunState, STOP_BUTTON};
use robot::{Control, RobotFault, Scene, SceneEdit};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tokio::sync::{oneshot, watch};

/// Stack of a run's thread in bytes; procedures nest on it.
const STACK_BYTES: usize = 8 * 1024 * 1024;
/// The longest a Start may take, in milliseconds.
const START_MAX_MS: u64 = 10_000;
/// The longest that taking control waits for the robot's thread, in milliseconds.
const CONTROL_MAX_MS: u64 = 5_000;
/// The longest that ending waits for the threads, in milliseconds.
const SHUT_DOWN_MAX_MS: u64 = 2_000;
/// Threads of runs that may live, those included that have not noticed Stop yet.
const THREADS_MAX: usize = 2 * run_table::RUNNING_MAX_RUNS;

/// A robot and the behaviours that run on it. A clone is the same robot.
#[derive(Clone)]
pub(crate) struct Host {
    pub(super) owner: Arc<Owner>,
}

/// What to start.
pub(crate) struct StartOrder {
    /// The behaviour.
    pub(crate) behaviour: Id,
    /// Its revision.
    pub(crate) revision: u64,
    /// The behaviour at that revision, with its helpers.
    pub(crate) file: Arc<BehaviourFile>,
    /// True if it is recorded.
    pub(crate) record: bool,
    /// The session that its recording is part of, and what the recording has.
    pub(crate) session: RecordedSession,
    /// Who starts it.
    pub(crate) by: String,
    /// By which invitation they came; none if they are the host.
    pub(crate) invitation: Option<Id>,
}

/// A run that is about to be; forgotten with its end if it did not come to be.
pub(crate) struct AnnouncedRun {
    run: u64,
    cancel: Arc<CancelFlag>,
    shared: Arc<RobotShared>,
}

impl AnnouncedRun {
    /// True if somebody pressed Stop meanwhile.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// Who pressed Stop meanwhile, if they said who they are.
    pub(crate) fn stopped_by(&self) -> Option<String> {
        self.cancel.stopped_by().filter(|by| *by != STOP_BUTTON).map(str::to_owned)
    }
}

impl Drop for AnnouncedRun {
    fn drop(&mut self) {
        lock(&self.shared.table).withdraw(self.run);
    }
}

/// Whether a run began, or why not.
type BegunRun = Result<RunState, StartError>;

/// Ends the robot's thread with the last clone.
pub(super) struct Owner {
    shared: Arc<RobotShared>,
    pub(super) thread: Mutex<Option<JoinHandle<()>>>,
    limits: fn() -> Limits,
    recordings: Recordings,
    /// Taken while a recording of what runs begins.
    beginning: Mutex<()>,
    /// The robot in its room as a message, made from the newest scene.
    pictures: watch::Sender<Utf8Bytes>,
}

impl Host {
    /// A robot on a thread of its own, with these limits for procedures.
    ///
    /// # Errors
    /// If the thread cannot be made.
    pub(super) fn new(
        state: RobotState,
        feed: Arc<StatusFeed>,
        make: Make,
        limits: fn() -> Limits,
        recordings: Recordings,
        order: RobotOrder,
    ) -> std::io::Result<Self> {
        let shared = Arc::new(RobotShared::new(state.robot.clone(), feed, order));
        let mine = Arc::clone(&shared);
        let thread =
            std::thread::Builder::new().name("robot".into()).spawn(move || robot_thread::keep(&mine, &make))?;
        shared.feed.add(state);
        let pictures = watch::Sender::new(Utf8Bytes::default());
        let (thread, beginning) = (Mutex::new(Some(thread)), Mutex::default());
        Ok(Self { owner: Arc::new(Owner { shared, thread, limits, recordings, beginning, pictures }) })
    }

    /// Which robot.
    pub(crate) fn id(&self) -> &Id {
        &self.shared().robot
    }

    /// True if nothing runs on it, and nothing is about to.
    pub(super) fn is_idle(&self) -> bool {
        lock(&self.shared().table).is_idle()
    }

    /// Announces that a behaviour is about to start: from now on a Stop of it counts, and it may not be removed. Who presses
    /// had heard of Stops up to `stops`.
    ///
    /// # Errors
    /// If too many run already, or if the robot was stopped since.
    pub(crate) fn announce(&self, behaviour: &Id, stops: Option<u64>) -> Result<AnnouncedRun, StartError> {
        let shared = self.shared().clone();
        if let Some(other) = shared.feed.same_as(&shared.robot) {
            return Err(StartError::Twin(other));
        }
        if shared.threads() >= THREADS_MAX {
            return Err(StartError::TooMany);
        }
        let cancel = shared.cancel_flags.add_pressed(behaviour, stops)?;
        let run = shared.feed.next_run();
        let announced = AnnouncedRun { run, cancel, shared };
        let has_room = lock(&announced.shared.table).announce(run, behaviour, &announced.cancel);
        if has_room { Ok(announced) } else { Err(StartError::TooMany) }
    }

    /// Starts an announced behaviour; one that runs already is replaced as soon as the new one is ready.
    ///
    /// # Errors
    /// Why it cannot start.
    pub(crate) async fn start_announced(&self, announced: &AnnouncedRun, start: StartOrder) -> BegunRun {
        let job = self.job(announced.run, start, announced.cancel.clone());
        let (answer, answered) = oneshot::channel();
        self.thread(job, move |job| runner::run(job, answer))?;
        match tokio::time::timeout(Duration::from_millis(START_MAX_MS), answered).await {
            Ok(answered) => answered.unwrap_or(Err(StartError::Unprepared)),
            Err(_) => {
                announced.cancel.cancel();
                Err(StartError::Late)
            }
        }
    }

    /// Announces and starts a behaviour.
    #[cfg(test)]
    pub(super) async fn start(&self, start: StartOrder) -> BegunRun {
        let announced = self.announce(&start.behaviour, None)?;
        self.start_announced(&announced, start).await
    }

    fn job(&self, run: u64, start: StartOrder, cancel: Arc<CancelFlag>) -> RunJob {
        let (shared, recordings) = (self.shared().clone(), self.owner.recordings.clone());
        RunJob { run, start, cancel, shared, recordings, limits: self.owner.limits, clock: Instant::now }
    }

    /// A thread for a run.
    fn thread(&self, job: RunJob, work: impl FnOnce(&RunJob) + Send + 'static) -> Result<(), StartError> {
        let shared = self.shared().clone();
        shared.threads.fetch_add(1, Ordering::SeqCst);
        let thread = std::thread::Builder::new().name(format!("run-{}", job.run)).stack_size(STACK_BYTES);
        let spawned = thread.spawn(move || {
            priority::of_this_thread(Priority::Run);
            work(&job);
            job.shared.threads.fetch_sub(1, Ordering::SeqCst);
        });
        spawned.map(drop).map_err(|error| {
            shared.threads.fetch_sub(1, Ordering::SeqCst);
            StartError::NoThread(error)
        })
    }

    /// Lets the running behaviour go on with what `start` has, between two instants; what did not change keeps its
    /// memory. If it cannot, what runs goes on as it is. Who presses had heard of Stops up to `stops`.
    ///
    /// # Errors
    /// Why it was not applied.
    pub(crate) async fn apply(&self, start: StartOrder, stops: Option<u64>) -> BegunRun {
        let answered = self.launch_successor(start, stops)?;
        match tokio::time::timeout(Duration::from_millis(START_MAX_MS), answered).await {
            Ok(answered) => answered.unwrap_or(Err(StartError::Unprepared)),
            Err(_) => Err(StartError::StillApplying),
        }
    }

    fn launch_successor(
        &self,
        start: StartOrder,
        stops: Option<u64>,
    ) -> Result<oneshot::Receiver<BegunRun>, StartError> {
        let before = lock(&self.shared().table).running_of(&start.behaviour).cloned();
        // A Stop that comes after this sets the flag of what runs.
        self.shared().cancel_flags.check(&start.behaviour, stops)?;
        let before = before.ok_or(StartError::Ended)?;
        if self.shared().threads() >= THREADS_MAX {
            return Err(StartError::TooMany);
        }
        if !before.applying.begin() {
            return Err(StartError::AppliedJustNow);
        }
        let job = self.job(before.state.run, start, before.cancel.clone());
        let (answer, answered) = oneshot::channel();
        let applying = before.applying.clone();
        let thread = self.thread(job, move |job| successor::follow(job, &before, answer));
        thread.inspect_err(|_| applying.end())?;
        Ok(answered)
    }

    /// Stops a behaviour, or everything, and lets the robot hold safely: nothing passes any more. Waits for nobody,
    /// whatever the procedures do; true if something ran. [`Host::settle`] has to follow.
    pub(super) fn stop_now(&self, behaviour: Option<&Id>, by: &str) -> bool {
        self.shared().stop_now(behaviour, by)
    }

    /// True if a behaviour was stopped on it since somebody had heard of Stops up to `stops`.
    pub(super) fn is_stopped_since(&self, behaviour: &Id, stops: Option<u64>) -> bool {
        self.shared().cancel_flags.check(behaviour, stops).is_err()
    }

    /// Writes down what was stopped and shows it.
    pub(super) fn settle(&self) {
        self.shared().settle();
    }

    /// Stops a behaviour, or everything, with all that follows; true if something ran.
    pub(super) fn stop(&self, behaviour: Option<&Id>, by: &str) -> bool {
        let ran = self.stop_now(behaviour, by);
        self.settle();
        ran
    }

    /// Gives a value to a sensor stream of a running behaviour, as if the robot had sensed it; a recording says who did.
    ///
    /// # Errors
    /// If the behaviour does not run, if it has no such sensor stream, or if the robot was stopped since the press.
    pub(crate) fn stimulate<'a>(
        &self,
        behaviour: &Id,
        stream: &Id,
        value: Value,
        presser: impl Into<Presser<'a>>,
    ) -> Result<(), Refused> {
        let Presser { by, stops } = presser.into();
        let table = lock(&self.shared().table);
        let entry = table.running_of(behaviour);
        // A Stop that comes after this sets the flag of what runs.
        self.shared().cancel_flags.check(behaviour, stops)?;
        let entry = entry.ok_or(Refused::NotRunning)?;
        let &(index, _) = entry.senses.get(stream).ok_or(Refused::NoSensor)?;
        entry.mailbox.pretend(index, value, by);
        Ok(())
    }

    /// Puts a behaviour just above another one in the order on the robot, or at the end.
    ///
    /// # Errors
    /// If it never ran here, or if that could not be kept.
    pub(crate) fn place(&self, behaviour: &Id, above: Option<&Id>) -> Result<(), Refused> {
        if !self.shared().order.has(behaviour) {
            return Err(Refused::NotRunning);
        }
        self.shared().place(behaviour, above).map_err(|error| Refused::NotKept(error.phrase()))
    }

    /// Marks the moment of a press in the newest run of a behaviour. One that has ended takes what was pressed before its end.
    ///
    /// # Errors
    /// If the behaviour did not run then, if a text is too long, or if that was too much at once.
    pub(super) fn mark(&self, behaviour: &Id, mark: RecordingMark, press: MarkPress) -> Result<PressOutcome, Refused> {
        let table = lock(&self.shared().table);
        let entry = table.newest_of(behaviour).ok_or(Refused::NotRunning)?;
        entry.marks.put(mark, press, &entry.mailbox).map(|mark| entry.marked(mark))
    }

    /// Marks the moment of a press in a run; none if that run is of another robot, or is forgotten.
    pub(super) fn mark_in(
        &self,
        run: u64,
        mark: RecordingMark,
        press: MarkPress,
    ) -> Option<Result<PressOutcome, Refused>> {
        let table = lock(&self.shared().table);
        let entry = table.get(run)?;
        Some(entry.marks.put(mark, press, &entry.mailbox).map(|mark| entry.marked(mark)))
    }

    /// Changes a mark of a run; none if that run is of another robot, or is forgotten.
    pub(super) fn edit_mark(
        &self,
        run: u64,
        id: &Id,
        edit: MarkEdit,
        press: MarkPress,
    ) -> Option<Result<PressOutcome, Refused>> {
        let table = lock(&self.shared().table);
        let entry = table.get(run)?;
        Some(entry.marks.edit(id, edit, press, &entry.mailbox).map(|mark| entry.marked(mark)))
    }

    /// The last minutes of a run, also of one that ended lately.
    pub(super) fn recent(&self, run: u64) -> Option<Arc<RecentReadings>> {
        lock(&self.shared().table).get(run).map(|entry| entry.recent.clone())
    }

    /// The marks of a run, also of one that ended lately.
    pub(crate) fn marks(&self, run: u64) -> Option<Arc<RunMarks>> {
        lock(&self.shared().table).get(run).map(|entry| entry.marks.clone())
    }

    /// Records a running behaviour from now on; one that is recorded stays so. Waits for the disk.
    ///
    /// # Errors
    /// If the behaviour does not run, or why it cannot be recorded.
    pub(crate) fn record(&self, behaviour: &Id, by: &str, session: &RecordedSession) -> Result<(), Refused> {
        // One at a time, so that nothing is recorded twice.
        let _beginning = lock(&self.owner.beginning);
        let shared = self.shared();
        let entry = lock(&shared.table).running_of(behaviour).cloned().ok_or(Refused::NotRunning)?;
        if entry.state.recording.is_some() {
            return Ok(());
        }
        let (run, revision, file) = (entry.state.run, entry.state.revision, entry.file);
        let robot = &shared.feed.name(&shared.robot);
        let about = About { run, robot, behaviour, revision, by, file: &file, session };
        let mut recorder = self.owner.recordings.begin(&about)?;
        let news = recorder.news();
        match lock(&shared.table).running_mut(run) {
            Some(entry) => entry.mailbox.begin_recording(Beginning { recorder, file }),
            None => {
                recorder.end("it did not run any more", None);
                return Err(Refused::NotRunning);
            }
        }
        shared.recorded(run, news);
        Ok(())
    }

    /// Ends the recording of a running behaviour.
    ///
    /// # Errors
    /// If the behaviour does not run.
    pub(crate) fn end_recording(&self, behaviour: &Id, by: &str) -> Result<(), Refused> {
        let table = lock(&self.shared().table);
        table.running_of(behaviour).ok_or(Refused::NotRunning)?.mailbox.end_recording(by);
        Ok(())
    }

    /// Has the robot do what a person presses. What runs is stopped before it is given back or rests; a robot on which
    /// something runs neither wakes up, stands nor sits, nor one that was stopped since the press.
    ///
    /// # Errors
    /// Why not.
    pub(crate) async fn control<'a>(&self, control: Control, presser: impl Into<Presser<'a>>) -> Result<(), Refused> {
        let Presser { by, stops } = presser.into();
        if control.ends_runs() {
            self.stop(None, by);
        }
        let shared = self.shared();
        let stops = stops.filter(|_| control.moves_body());
        shared.cancel_flags.check(&shared.robot, stops)?;
        if control.needs_quiet() && !lock(&shared.table).is_idle() {
            let why = phrase!("server.a_program_runs_on_it", "a program runs on it; press Stop first");
            return Err(Refused::RobotCannot(RobotFault::NotNow(why).phrase()));
        }
        let cancel = shared.cancel_flags.add_pressed(&shared.robot, stops)?;
        let (answer, answered) = oneshot::channel();
        shared.queue.control(Controlling { control, cancel: cancel.clone(), answer });
        let answered = tokio::time::timeout(Duration::from_millis(CONTROL_MAX_MS), answered).await;
        cancel.cancel();
        match answered {
            Ok(Ok(done)) => done.map_err(|fault| Refused::RobotCannot(fault.phrase())),
            Ok(Err(_)) => Err(Refused::TooFast),
            Err(_) => Err(Refused::RobotCannot(StartError::Silent.phrase())),
        }
    }

    /// The names under which it remembers faces.
    pub(crate) fn faces(&self) -> Vec<String> {
        lock(&self.shared().faces).to_vec()
    }

    /// Has the robot do something by hand, above what runs on it. A Stop that comes before it makes it void. Who presses had
    /// heard of Stops up to `stops`.
    ///
    /// # Errors
    /// If the robot was stopped since, has another one's body, refuses it or is silent for 5 s, or if the values are too
    /// large or many.
    pub(crate) async fn hand(&self, hand: ByHand, stops: Option<u64>) -> Result<(), Refused> {
        let shared = self.shared();
        if let Some(other) = shared.feed.same_as(&shared.robot) {
            return Err(NotByHand::Twin(other).refused());
        }
        if recording::json(&hand.value).len() + recording::json(&hand.params).len() > HAND_MAX_BYTES {
            return Err(NotByHand::Large.refused());
        }
        let cancel = shared.cancel_flags.add_pressed(&shared.robot, stops)?;
        let (answer, answered) = oneshot::channel();
        shared.queue.hand(Handing { hand, cancel: cancel.clone(), answer });
        let answered = tokio::time::timeout(Duration::from_millis(CONTROL_MAX_MS), answered).await;
        // An action that was answered, or is not waited for, is not stopped any more by its flag.
        cancel.cancel();
        match answered {
            Ok(Ok(done)) => done.map_err(NotByHand::refused),
            Ok(Err(_)) => Err(Refused::TooFast),
            Err(_) => Err(NotByHand::Silent.refused()),
        }
    }

    /// Makes the robot anew, as its settings are by now.
    pub(super) fn renew(&self) {
        self.shared().queue.renew();
    }

    /// Shows of what runs that the invitation of who started it was revoked.
    pub(super) fn revoked(&self, invitation: &Id) {
        self.shared().revoked(invitation);
    }

    /// Moves something in the room.
    pub(crate) fn edit_scene(&self, edit: SceneEdit) {
        self.shared().queue.edit(edit);
    }

    /// The robot in its room: the newest picture, about 30 a second while anything changes.
    pub(crate) fn scene(&self) -> watch::Receiver<Arc<Scene>> {
        self.shared().scene.subscribe()
    }

    /// What runs and what ended lately, oldest first.
    #[cfg(test)]
    pub(super) fn runs(&self) -> watch::Receiver<Arc<Vec<RunState>>> {
        self.shared().feed.runs()
    }

    /// The next picture of its camera, as JPEG; none if it has none, or if none comes within two seconds.
    pub(crate) async fn camera(&self) -> Option<Bytes> {
        self.shared().camera.next(self.id(), &self.shared().feed).await
    }

    /// The newest picture of the robot in its room as a message, made elsewhere.
    pub(crate) fn pictures(&self) -> &watch::Sender<Utf8Bytes> {
        &self.owner.pictures
    }

    /// The live values of a run, also of one that ended lately.
    pub(crate) fn values(&self, run: u64) -> Option<LiveValues> {
        lock(&self.shared().table).get(run).map(|entry| entry.live.clone())
    }

    /// True if a behaviour runs.
    pub(crate) fn is_running(&self, behaviour: &Id) -> bool {
        lock(&self.shared().table).running_of(behaviour).is_some()
    }

    /// True if a behaviour runs or is about to.
    pub(super) fn has(&self, behaviour: &Id) -> bool {
        lock(&self.shared().table).has(behaviour)
    }

    /// Stops everything and wants the threads to end.
    pub(super) fn end(&self) {
        self.stop(None, "the server");
        self.shared().queue.end();
    }

    /// Is gone for good: with its order, and from what people are shown.
    pub(super) fn leave(&self) {
        self.end();
        self.shared().order.forget();
        self.shared().feed.remove(self.id());
    }

    /// Stops everything and ends the threads; waits at most two seconds.
    pub(super) fn shut_down(&self) {
        self.end();
        let until = Instant::now() + Duration::from_millis(SHUT_DOWN_MAX_MS);
        let thread = lock(&self.owner.thread).take();
        let is_working = || self.shared().threads() > 0 || thread.as_ref().is_some_and(|thread| !thread.is_finished());
        while is_working() && Instant::now() < until {
            std::thread::sleep(Duration::from_millis(5));
        }
        // A thread that did not notice in time is left to the end of the process.
        if let Some(thread) = thread.filter(JoinHandle::is_finished) {
            drop(thread.join());
        }
    }

    pub(super) fn shared(&self) -> &Arc<RobotShared> {
        &self.owner.shared
    }
}

impl Drop for Owner {
    fn drop(&mut self) {
        self.shared.stop_now(None, "the server");
        self.shared.settle();
        self.shared.queue.end();
    }
}
