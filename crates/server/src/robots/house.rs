//! What the robot's thread, the runs' threads and the server share: the desk, the book, and what is shown.

use super::board::Board;
use super::book::{Book, Entry};
use super::desk::Desk;
use super::gate::Gates;
use super::host::Start;
use super::order::Order;
use crate::support::lock;
use behaviour::Id;
use protocol::{HeldPart, Recorded, RunPhase, RunState};
use robot::Scene;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use tokio::sync::watch;

/// Everything shared around one robot.
#[derive(Debug)]
pub(super) struct House {
    /// Which robot.
    pub(super) robot: Id,
    /// What people are shown of all robots.
    pub(super) board: Arc<Board>,
    /// What waits for the robot.
    pub(super) desk: Desk,
    /// Which behaviours run; locked only for moments, never while a procedure runs.
    pub(super) book: Mutex<Book>,
    /// How many threads of runs live, ended ones included until they notice.
    pub(super) threads: AtomicUsize,
    /// The robot in its room.
    pub(super) scene: watch::Sender<Arc<Scene>>,
    /// Who wins.
    pub(super) order: Order,
    /// What Stop closes.
    pub(super) gates: Gates,
}

impl House {
    /// A house with nothing in it.
    pub(super) fn new(robot: Id, board: Arc<Board>, order: Order) -> Self {
        Self {
            robot,
            board,
            desk: Desk::default(),
            order,
            book: Mutex::default(),
            threads: AtomicUsize::new(0),
            scene: watch::Sender::new(Arc::default()),
            gates: Gates::default(),
        }
    }

    /// Lets a prepared run begin, in place of an older one of the same behaviour; false if it was stopped meanwhile.
    pub(super) fn begin(&self, entry: Entry) -> bool {
        let mut book = lock(&self.book);
        let Some(replaced) = book.enter(entry) else { return false };
        self.clear_away(&book, &replaced);
        self.show(&book);
        true
    }

    /// Lets nothing of a behaviour, or of anything, reach the robot from now on, and lets the robot hold. Waits for
    /// nobody; true if there was something to stop. [`House::settle`] does the rest.
    pub(super) fn stop_now(&self, behaviour: Option<&Id>, by: &str) -> bool {
        if behaviour.is_none() {
            self.desk.stop();
        }
        let ran = self.gates.stop(behaviour, by);
        if behaviour.is_none() {
            // What passed a gate just before it closed.
            self.desk.stop();
        } else if ran {
            // The robot's thread looks which gates are closed.
            self.desk.ring();
        }
        ran
    }

    /// Writes down what was stopped, gives its devices back and shows it.
    pub(super) fn settle(&self) {
        let mut book = lock(&self.book);
        let ended = book.end_stopped();
        self.clear_away(&book, &ended);
        self.show(&book);
    }

    /// Ends a run that failed by itself, with its actions safe.
    pub(super) fn fault(&self, run: u64, reason: String) {
        let mut book = lock(&self.book);
        // Its thread may notice a Stop before it is written down.
        let stopped_by = book.get(run).and_then(|entry| entry.gate.stopped_by().map(str::to_owned));
        let ended = book.end_run(run, stopped_by.map_or(RunPhase::Faulted(reason), RunPhase::Stopped));
        self.clear_away(&book, ended.as_slice());
        self.show(&book);
    }

    /// Ends every run because the robot failed.
    pub(super) fn fault_all(&self, reason: &str) {
        let mut book = lock(&self.book);
        book.cancel_all();
        let ended = book.end(None, &RunPhase::Faulted(reason.to_owned()));
        self.clear_away(&book, &ended);
        self.show(&book);
    }

    /// Notes that a run goes on with an edited behaviour; none if it does not run any more.
    pub(super) fn applied(&self, run: u64, start: &Start) -> Option<RunState> {
        let mut book = lock(&self.book);
        let entry = book.running_mut(run)?;
        entry.file = start.file.clone();
        (entry.state.revision, entry.state.name) = (start.revision, start.file.name.clone());
        entry.state.fingerprint = start.file.fingerprint();
        let state = entry.state.clone();
        self.show(&book);
        Some(state)
    }

    /// Notes how a recording goes, or that it ended.
    pub(super) fn recorded(&self, run: u64, recording: Option<Recorded>) {
        let mut book = lock(&self.book);
        if let Some(entry) = book.running_mut(run) {
            entry.state.recording = recording;
            self.show(&book);
        }
    }

    /// How many threads of runs still live.
    pub(super) fn threads(&self) -> usize {
        self.threads.load(Ordering::SeqCst)
    }

    /// Their gates are closed: now the robot ends what they do, and nobody else's, and their threads notice. With
    /// nobody else left it holds as a whole.
    fn clear_away(&self, book: &Book, ended: &[Entry]) {
        if ended.iter().any(|entry| entry.acts) && !book.runs_any() {
            self.desk.stop();
        }
        for entry in ended {
            self.desk.close(entry.state.run);
            entry.mailbox.ring();
        }
    }

    /// Puts a behaviour just above another one, or at the end.
    pub(super) fn place(&self, behaviour: &Id, above: Option<&Id>) -> std::io::Result<()> {
        self.order.put(behaviour, above)?;
        self.show(&lock(&self.book));
        Ok(())
    }

    /// Shows which parts of the robot are kept from which runs.
    pub(super) fn held(&self, mut held: BTreeMap<u64, Vec<HeldPart>>) {
        let mut book = lock(&self.book);
        for entry in book.entries_mut() {
            entry.state.held = held.remove(&entry.state.run).unwrap_or_default();
        }
        self.show(&book);
    }

    fn show(&self, book: &Book) {
        let mut states = book.states();
        for state in &mut states {
            state.place = self.order.place(&state.behaviour);
        }
        self.board.show_runs(&self.robot, states);
    }
}
