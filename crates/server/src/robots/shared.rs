//! What the robot's thread, the runs' threads and the server share: the command queue, the run table, and what is shown.

use super::camera::CameraView;
use super::cancel_flag::CancelFlags;
use super::command_queue::CommandQueue;
use super::host::StartOrder;
use super::order::RobotOrder;
use super::refusal::RunFailure;
use super::run_table::{RunEntry, RunTable};
use super::status_feed::StatusFeed;
use crate::support::lock;
use behaviour::Id;
use phrase::Phrased;
use protocol::{HeldPart, Recorded, RunPhase, RunState};
use robot::Scene;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use tokio::sync::watch;

/// Everything shared around one robot.
#[derive(Debug)]
pub(super) struct RobotShared {
    /// Which robot.
    pub(super) robot: Id,
    /// What people are shown of all robots.
    pub(super) feed: Arc<StatusFeed>,
    /// What waits for the robot.
    pub(super) queue: CommandQueue,
    /// Which behaviours run; locked only for moments, never while a procedure runs.
    pub(super) table: Mutex<RunTable>,
    /// How many threads of runs live, ended ones included until they notice.
    pub(super) threads: AtomicUsize,
    /// The robot in its room.
    pub(super) scene: watch::Sender<Arc<Scene>>,
    /// What its camera sees.
    pub(super) camera: Arc<CameraView>,
    /// The names under which it remembers faces; told to nobody who does not ask.
    pub(super) faces: Mutex<Arc<[String]>>,
    /// Who wins.
    pub(super) order: RobotOrder,
    /// What Stop sets.
    pub(super) cancel_flags: CancelFlags,
}

impl RobotShared {
    /// Nothing runs and nothing waits.
    pub(super) fn new(robot: Id, feed: Arc<StatusFeed>, order: RobotOrder) -> Self {
        let cancel_flags = CancelFlags::new(feed.stops());
        Self {
            robot,
            feed,
            queue: CommandQueue::default(),
            order,
            table: Mutex::default(),
            threads: AtomicUsize::new(0),
            scene: watch::Sender::new(Arc::default()),
            camera: Arc::default(),
            faces: Mutex::default(),
            cancel_flags,
        }
    }

    /// Lets a prepared run begin, in place of an older one of the same behaviour; false if it was stopped meanwhile.
    pub(super) fn begin(&self, entry: RunEntry) -> bool {
        let mut table = lock(&self.table);
        let Some(replaced) = table.enter(entry) else { return false };
        self.clear_away(&table, &replaced);
        self.show(&table);
        true
    }

    /// Lets nothing of a behaviour, or of anything, reach the robot from now on, and lets the robot hold. Waits for
    /// nobody; true if there was something to stop. [`RobotShared::settle`] does the rest.
    pub(super) fn stop_now(&self, behaviour: Option<&Id>, by: &str) -> bool {
        if behaviour.is_none() {
            self.queue.stop();
        }
        let ran = self.cancel_flags.stop(behaviour, by);
        if behaviour.is_none() {
            // What got past a flag just before it was set.
            self.queue.stop();
        } else if ran {
            // The robot's thread looks which runs are cancelled.
            self.queue.ring();
        }
        ran
    }

    /// Writes down what was stopped, gives its devices back and shows it.
    pub(super) fn settle(&self) {
        let mut table = lock(&self.table);
        let ended = table.end_stopped();
        self.clear_away(&table, &ended);
        self.show(&table);
    }

    /// Ends a run that failed by itself, with its actions safe.
    pub(super) fn fault(&self, run: u64, why: &RunFailure) {
        let mut table = lock(&self.table);
        // Its thread may notice a Stop before it is written down.
        let stopped_by = table.get(run).and_then(|entry| entry.cancel.stopped_by().map(str::to_owned));
        let ended = table.end_run(run, stopped_by.map_or_else(|| RunPhase::Faulted(why.phrase()), RunPhase::Stopped));
        self.clear_away(&table, ended.as_slice());
        self.show(&table);
    }

    /// Interrupts every run, as the robot wants. Each may go on when somebody starts it.
    pub(super) fn pause_all(&self, why: &RunFailure) {
        self.cancel_flags.halted(&self.robot);
        let mut table = lock(&self.table);
        table.cancel_all();
        // What was stopped just before stays stopped.
        let mut ended = table.end_stopped();
        for entry in table.end(None, &RunPhase::Paused(why.phrase())) {
            table.pause(entry.state.run, self.cancel_flags.add(&entry.state.behaviour));
            ended.push(entry);
        }
        self.clear_away(&table, &ended);
        self.show(&table);
    }

    /// Ends every run because the robot failed.
    pub(super) fn fault_all(&self, why: &RunFailure) {
        self.cancel_flags.halted(&self.robot);
        let mut table = lock(&self.table);
        table.cancel_all();
        let ended = table.end(None, &RunPhase::Faulted(why.phrase()));
        self.clear_away(&table, &ended);
        self.show(&table);
    }

    /// Notes that a run goes on with an edited behaviour; none if it does not run any more.
    pub(super) fn applied(&self, run: u64, start: &StartOrder) -> Option<RunState> {
        let mut table = lock(&self.table);
        let entry = table.running_mut(run)?;
        entry.file = start.file.clone();
        (entry.state.revision, entry.state.name) = (start.revision, start.file.name.clone());
        entry.state.fingerprint = start.file.fingerprint();
        let state = entry.state.clone();
        self.show(&table);
        Some(state)
    }

    /// Notes how a recording goes, or that it ended.
    pub(super) fn recorded(&self, run: u64, recording: Option<Recorded>) {
        let mut table = lock(&self.table);
        if let Some(entry) = table.running_mut(run) {
            entry.state.recording = recording;
            self.show(&table);
        }
    }

    /// Notes that the invitation of who started something was revoked.
    pub(super) fn revoked(&self, invitation: &Id) {
        let mut table = lock(&self.table);
        for entry in table.entries_mut().filter(|entry| entry.invitation.as_ref() == Some(invitation)) {
            entry.state.revoked = true;
        }
        self.show(&table);
    }

    /// How many threads of runs still live.
    pub(super) fn threads(&self) -> usize {
        self.threads.load(Ordering::SeqCst)
    }

    /// They are cancelled: now the robot ends what they do, and nobody else's, and their threads notice. With
    /// nobody else left it holds as a whole.
    fn clear_away(&self, table: &RunTable, ended: &[RunEntry]) {
        if ended.iter().any(|entry| entry.acts) && !table.runs_any() {
            self.queue.stop();
        }
        for entry in ended {
            self.queue.close(entry.state.run);
            entry.mailbox.ring();
        }
    }

    /// Puts a behaviour just above another one, or at the end.
    pub(super) fn place(&self, behaviour: &Id, above: Option<&Id>) -> std::io::Result<()> {
        self.order.put(behaviour, above)?;
        self.show(&lock(&self.table));
        Ok(())
    }

    /// Shows which parts of the robot are kept from which runs.
    pub(super) fn held(&self, mut held: HashMap<u64, Vec<HeldPart>>) {
        let mut table = lock(&self.table);
        for entry in table.entries_mut() {
            entry.state.held = held.remove(&entry.state.run).unwrap_or_default();
        }
        self.show(&table);
    }

    fn show(&self, table: &RunTable) {
        let mut states = table.states();
        for state in &mut states {
            state.place = self.order.place(&state.behaviour);
        }
        self.feed.show_runs(&self.robot, states);
    }
}
