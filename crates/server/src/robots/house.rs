//! What the robot's thread, the runs' threads and the server share: the desk, the book, and what is shown.

use super::board::Board;
use super::book::{Book, Entry};
use super::desk::Desk;
use super::host::Start;
use super::order::Order;
use crate::lock;
use behaviour::Id;
use protocol::{HeldPart, Recorded, RunPhase, RunState};
use robot::Scene;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
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
    /// Grows with every Stop, so that a Start under way notices.
    pub(super) stops: AtomicU64,
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
            stops: AtomicU64::new(0),
        }
    }

    /// Lets a prepared run begin, in place of an older one of the same behaviour; false if it was stopped meanwhile.
    pub(super) fn begin(&self, entry: Entry) -> bool {
        let mut book = lock(&self.book);
        let Some(replaced) = book.enter(entry) else { return false };
        self.clear_away(&replaced);
        self.show(&book);
        true
    }

    /// Stops a behaviour, or everything. Takes only the book's lock; true if there was something to stop.
    pub(super) fn stop(&self, behaviour: Option<&Id>, by: &str) -> bool {
        self.stops.fetch_add(1, Ordering::SeqCst);
        if behaviour.is_none() {
            self.desk.stop();
        }
        let mut book = lock(&self.book);
        let cancelled = book.cancel(behaviour);
        let ended = book.end(behaviour, &RunPhase::Stopped(by.to_owned()));
        self.clear_away(&ended);
        self.show(&book);
        drop(book);
        if behaviour.is_none() {
            self.desk.stop();
        }
        cancelled || !ended.is_empty()
    }

    /// Ends a run that failed by itself, with its actions safe.
    pub(super) fn fault(&self, run: u64, reason: String) {
        let mut book = lock(&self.book);
        let ended = book.end_run(run, RunPhase::Faulted(reason));
        self.clear_away(ended.as_slice());
        self.show(&book);
    }

    /// Ends every run because the robot failed.
    pub(super) fn fault_all(&self, reason: &str) {
        let mut book = lock(&self.book);
        book.cancel(None);
        let ended = book.end(None, &RunPhase::Faulted(reason.to_owned()));
        self.clear_away(&ended);
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

    /// Their gates are closed: now the robot holds, gives their devices back, and their threads notice.
    fn clear_away(&self, ended: &[Entry]) {
        if ended.iter().any(|entry| entry.acts) {
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
