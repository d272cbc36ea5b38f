//! The table of runs: which behaviours run, and the last ones that ended.

use super::cancel_flag::CancelFlag;
use super::live::LiveValues;
use super::mailbox::{ReadingsKept, RunMailbox};
use super::recent::RecentReadings;
use super::run_marks::{PressOutcome, RunMarks};
use super::told_times::ToldTimes;
use behaviour::{BehaviourFile, Id};
use engine::{Handover, StreamIx};
use phrase::Phrase;
use protocol::{RecordingMark, RunPhase, RunState};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Ended runs that are remembered.
const ENDED_MAX_RUNS: usize = 16;
/// Behaviours that may run or prepare at once.
pub(super) const RUNNING_MAX_RUNS: usize = 16;

/// The runs by their numbers; every use of it is short.
#[derive(Debug, Default)]
pub(super) struct RunTable {
    preparing: HashMap<u64, Preparing>,
    runs: BTreeMap<u64, RunEntry>,
    /// Of the runs that the robot interrupted: what they may go on with.
    paused: HashMap<u64, Paused>,
}

/// A run that the robot interrupted.
#[derive(Debug)]
struct Paused {
    /// What a Stop sets.
    cancel: Arc<CancelFlag>,
    /// None until its thread has noticed.
    memory: Option<PausedMemory>,
}

/// What an interrupted run goes on with.
#[derive(Debug)]
pub(super) struct PausedMemory {
    /// What ran.
    pub(super) file: Arc<BehaviourFile>,
    /// What its connectors remember.
    pub(super) memory: Handover,
    /// The next instant of its logical time, which stands still meanwhile.
    pub(super) open_ms: u64,
    /// The times that its senses told last.
    pub(super) times: ToldTimes,
    /// The marks, as they are when it goes on: they can be changed until then. The run that goes on shows them too.
    pub(super) marks: Arc<RunMarks>,
}

/// A run that is not there yet.
#[derive(Debug)]
struct Preparing {
    behaviour: Id,
    cancel: Arc<CancelFlag>,
}

/// The sensor streams of a run by id: their index, and which readings wait.
pub(super) type RunSenses = HashMap<Id, (StreamIx, ReadingsKept)>;

/// Taken while somebody applies an edited behaviour to a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Applying(Arc<AtomicBool>);

impl Applying {
    /// True if nobody else does it.
    pub(super) fn begin(&self) -> bool {
        !self.0.swap(true, Ordering::SeqCst)
    }

    /// The next one may.
    pub(super) fn end(&self) {
        self.0.store(false, Ordering::SeqCst);
    }
}

/// A run.
#[derive(Clone, Debug)]
pub(super) struct RunEntry {
    /// What people see.
    pub(super) state: RunState,
    /// What cancels it.
    pub(super) cancel: Arc<CancelFlag>,
    /// Its mailbox.
    pub(super) mailbox: Arc<RunMailbox>,
    /// Its values.
    pub(super) live: LiveValues,
    /// Its sensor streams by id.
    pub(super) senses: RunSenses,
    /// The marks of the run.
    pub(super) marks: Arc<RunMarks>,
    /// The last minutes of the run.
    pub(super) recent: Arc<RecentReadings>,
    /// What runs.
    pub(super) file: Arc<BehaviourFile>,
    /// True if an edited behaviour is about to follow.
    pub(super) applying: Applying,
    /// True if it can move the robot.
    pub(super) acts: bool,
    /// By which invitation came who started it.
    pub(super) invitation: Option<Id>,
}

impl RunEntry {
    /// Returns the outcome of a press that made or changed this mark.
    pub(super) fn marked(&self, mark: RecordingMark) -> PressOutcome {
        let recording = self.state.recording.as_ref().filter(|recording| recording.trouble.is_none());
        let later = recording.filter(|_| self.marks.is_closed()).map(|recording| recording.file.clone());
        PressOutcome { mark, kept: recording.is_some(), later }
    }
}

impl RunTable {
    /// Announces a new run; false if too many run already.
    pub(super) fn announce(&mut self, run: u64, behaviour: &Id, cancel: &Arc<CancelFlag>) -> bool {
        let has_room = self.preparing.len() + self.running().count() < RUNNING_MAX_RUNS;
        if has_room {
            self.preparing.insert(run, Preparing { behaviour: behaviour.clone(), cancel: cancel.clone() });
        }
        has_room
    }

    /// True if nothing runs, and nothing is about to.
    pub(super) fn is_idle(&self) -> bool {
        self.preparing.is_empty() && self.running().next().is_none()
    }

    /// True if anything runs.
    pub(super) fn runs_any(&self) -> bool {
        self.running().next().is_some()
    }

    /// Forgets a run that did not come to be.
    pub(super) fn withdraw(&mut self, run: u64) {
        self.preparing.remove(&run);
    }

    /// From now on it runs, unless it was stopped meanwhile. What ran of the same behaviour is returned, ended.
    pub(super) fn enter(&mut self, entry: RunEntry) -> Option<Vec<RunEntry>> {
        self.preparing.remove(&entry.state.run)?;
        if entry.cancel.is_cancelled() {
            return None;
        }
        let by = entry.state.by.clone();
        self.give_up(|paused, _| paused.behaviour == entry.state.behaviour, &by);
        let replaced = self.end(Some(&entry.state.behaviour), &RunPhase::Stopped(by));
        self.runs.insert(entry.state.run, entry);
        Some(replaced)
    }

    /// Cancels a behaviour's runs, or all, and returns what ran.
    pub(super) fn end(&mut self, behaviour: Option<&Id>, phase: &RunPhase) -> Vec<RunEntry> {
        let is_meant = |entry: &RunEntry| behaviour.is_none_or(|id| entry.state.behaviour == *id);
        let meant: Vec<u64> = self.running().filter(|entry| is_meant(entry)).map(|entry| entry.state.run).collect();
        meant.into_iter().filter_map(|run| self.end_run(run, phase.clone())).collect()
    }

    /// Ends one run; none if it had ended already.
    pub(super) fn end_run(&mut self, run: u64, phase: RunPhase) -> Option<RunEntry> {
        let entry = self.runs.get_mut(&run).filter(|entry| entry.state.phase == RunPhase::Running)?;
        entry.cancel.cancel();
        entry.state.phase = phase;
        let ended = entry.clone();
        self.forget_old();
        Some(ended)
    }

    /// Ends what Stop cancelled already, and returns what ran.
    pub(super) fn end_stopped(&mut self) -> Vec<RunEntry> {
        let by =
            |entry: &RunEntry| entry.cancel.stopped_by().filter(|_| entry.cancel.is_cancelled()).map(str::to_owned);
        let stopped: Vec<_> = self.running().filter_map(|entry| Some((entry.state.run, by(entry)?))).collect();
        let given_up: Vec<_> = self
            .paused
            .iter()
            .filter_map(|(run, paused)| Some((*run, paused.cancel.stopped_by()?.to_owned())))
            .collect();
        for (run, by) in given_up {
            self.give_up(|_, paused| paused == run, &by);
        }
        stopped.into_iter().filter_map(|(run, by)| self.end_run(run, RunPhase::Stopped(by))).collect()
    }

    /// An ended run may go on, until `cancel` is set.
    pub(super) fn pause(&mut self, run: u64, cancel: Arc<CancelFlag>) {
        self.paused.insert(run, Paused { cancel, memory: None });
    }

    /// Returns the reason why the robot interrupted a run; none if it did not.
    pub(super) fn halted(&self, run: u64) -> Option<Phrase> {
        match &self.get(run)?.state.phase {
            RunPhase::Paused(why) => Some(why.clone()),
            RunPhase::Running | RunPhase::Stopped(_) | RunPhase::Faulted(_) => None,
        }
    }

    /// What an interrupted run remembers; of any other run that is not kept.
    pub(super) fn keep_memory(&mut self, run: u64, memory: impl FnOnce() -> PausedMemory) {
        if let Some(paused) = self.paused.get_mut(&run) {
            paused.memory = Some(memory());
        }
    }

    /// What a behaviour goes on with, if the robot interrupted it and nobody pressed Stop since.
    pub(super) fn take_memory(&mut self, behaviour: &Id) -> Option<PausedMemory> {
        let of_it = |run: &u64| self.runs.get(run).is_some_and(|entry| entry.state.behaviour == *behaviour);
        let run = self.paused.keys().filter(|run| of_it(run)).max().copied()?;
        let paused = self.paused.get_mut(&run).filter(|paused| !paused.cancel.is_cancelled())?;
        paused.memory.take()
    }

    /// Interrupted runs do not go on any more.
    fn give_up(&mut self, is_meant: impl Fn(&RunState, u64) -> bool, by: &str) {
        for (run, entry) in &mut self.runs {
            if is_meant(&entry.state, *run)
                && let Some(paused) = self.paused.remove(run)
            {
                // Nobody needs to set it any more.
                paused.cancel.cancel();
                entry.state.phase = RunPhase::Stopped(by.to_owned());
            }
        }
    }

    /// Cancels all that is only being prepared.
    pub(super) fn cancel_all(&mut self) {
        self.preparing.values().for_each(|waiting| {
            waiting.cancel.cancel();
        });
    }

    /// True if a behaviour runs or is about to.
    pub(super) fn has(&self, behaviour: &Id) -> bool {
        let prepares = |waiting: &Preparing| waiting.behaviour == *behaviour && !waiting.cancel.is_cancelled();
        self.running_of(behaviour).is_some() || self.preparing.values().any(prepares)
    }

    /// The running one of a behaviour.
    pub(super) fn running_of(&self, behaviour: &Id) -> Option<&RunEntry> {
        self.running().find(|entry| entry.state.behaviour == *behaviour)
    }

    /// The newest one of a behaviour, running or ended.
    pub(super) fn newest_of(&self, behaviour: &Id) -> Option<&RunEntry> {
        self.runs.values().rev().find(|entry| entry.state.behaviour == *behaviour)
    }

    /// One run, if it runs.
    pub(super) fn running_mut(&mut self, run: u64) -> Option<&mut RunEntry> {
        self.runs.get_mut(&run).filter(|entry| entry.state.phase == RunPhase::Running)
    }

    /// All runs.
    pub(super) fn entries_mut(&mut self) -> impl Iterator<Item = &mut RunEntry> {
        self.runs.values_mut()
    }

    /// One run, running or ended.
    pub(super) fn get(&self, run: u64) -> Option<&RunEntry> {
        self.runs.get(&run)
    }

    /// All that people see, oldest first.
    pub(super) fn states(&self) -> Vec<RunState> {
        self.runs.values().map(|entry| entry.state.clone()).collect()
    }

    fn running(&self) -> impl Iterator<Item = &RunEntry> {
        self.runs.values().filter(|entry| entry.state.phase == RunPhase::Running)
    }

    fn forget_old(&mut self) {
        let ended = self.runs.values().filter(|entry| entry.state.phase != RunPhase::Running);
        let ended: Vec<u64> = ended.map(|entry| entry.state.run).collect();
        for run in ended.iter().take(ended.len().saturating_sub(ENDED_MAX_RUNS)) {
            self.runs.remove(run);
            if let Some(paused) = self.paused.remove(run) {
                paused.cancel.cancel();
            }
        }
    }
}
