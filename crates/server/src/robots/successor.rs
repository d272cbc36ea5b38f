//! Applying an edited behaviour to the robot that runs it: the new graph is compiled beside the old one on a thread of
//! its own, then takes over between two instants. Until then, and if it is refused, the old one goes on.

use super::mailbox::RunMailbox;
use super::recent::RecentReadings;
use super::refusal::StartError;
use super::run_marks::RunMarks;
use super::run_table::{RunEntry, RunSenses};
use super::runner::{self, RunJob, Runner, devices, open, senses};
use super::shared::RobotShared;
use super::tally::RunTally;
use super::told_times::ToldTimes;
use crate::recordings::Recorder;
use crate::support::lock;
use engine::{Handover, Matching, Run};
use protocol::RunState;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::Instant;
use tokio::sync::oneshot;

/// Where a run hands over to the one that follows it.
#[derive(Debug)]
pub(super) struct Successor(pub(super) SyncSender<RunHandover>);

/// What one run hands over to the next.
pub(super) struct RunHandover {
    /// What its connectors remember.
    pub(super) memory: Handover,
    /// What it counted.
    pub(super) tally: RunTally,
    /// What is recorded, if it is.
    pub(super) recorder: Option<Recorder>,
    /// The marks of the run.
    pub(super) marks: Arc<RunMarks>,
    /// The times that its senses told last.
    pub(super) times: ToldTimes,
    /// The last minutes of the run.
    pub(super) recent: Arc<RecentReadings>,
    /// Logical time 0.
    pub(super) began: Instant,
    /// The next instant that still takes readings.
    pub(super) open_ms: u64,
}

impl Successor {
    /// Hands over; false if nobody is there to take it.
    pub(super) fn take(self, handover: RunHandover) -> bool {
        self.0.send(handover).is_ok()
    }
}

/// Follows the run of `before`; `answer` hears whether it took over. A panic before that leaves the old one running.
pub(super) fn follow(job: &RunJob, before: &RunEntry, answer: oneshot::Sender<Result<RunState, StartError>>) {
    let took = catch_unwind(AssertUnwindSafe(|| take_over(job, before)));
    match took.unwrap_or_else(|_| Err(StartError::Inside)) {
        Ok((runner, state)) => {
            before.applying.end();
            drop(answer.send(Ok(state)));
            runner::work(job, runner);
        }
        Err(reason) => {
            before.applying.end();
            drop(answer.send(Err(reason)));
        }
    }
}

fn take_over<'a>(job: &'a RunJob, before: &RunEntry) -> Result<(Runner<'a>, RunState), StartError> {
    let clock = Rc::new(Cell::new(Instant::now()));
    let run = runner::build(job, &clock)?;
    let matching = Matching::between(&before.file, &job.start.file);
    let mailbox = Arc::new(RunMailbox::default());
    open(job, &mailbox, devices(&run, &job.start.file), true)?;
    let handover = handover(job, &run, &mailbox)?;
    let state = job.shared.applied(job.run, &job.start).ok_or(StartError::StoppedMeanwhile)?;
    Ok((go_on(job, run, handover, &matching, mailbox, clock), state))
}

/// From now on readings go to the new run, where they wait; the old one hands over after its last ones.
fn handover(job: &RunJob, run: &Run, mailbox: &Arc<RunMailbox>) -> Result<RunHandover, StartError> {
    let (hand, handed) = sync_channel(1);
    let devices = devices(run, &job.start.file);
    let (senses, acts) = (senses(run, &devices), runner::acts(run, &devices));
    let old = job.shared.redirect(job.run, mailbox, senses, acts).ok_or(StartError::StoppedMeanwhile)?;
    old.succeed(Successor(hand));
    handed.recv().map_err(|_| StartError::StoppedMeanwhile)
}

pub(super) fn go_on<'a>(
    job: &'a RunJob,
    mut run: Run,
    handover: RunHandover,
    matching: &Matching,
    mailbox: Arc<RunMailbox>,
    clock: Rc<Cell<Instant>>,
) -> Runner<'a> {
    let RunHandover { memory, tally, recorder, marks, times, recent, began, open_ms } = handover;
    run.resume_from(memory, matching);
    let tally = tally.succeeded(&run, matching);
    recent.begin((&job.start.file, job.start.revision), Some(run.handover()), (began, open_ms), true);
    let runner = Runner::new(job, run, mailbox, tally, clock).since((began, open_ms), (marks, &times), recorder);
    runner.looked_back_at(recent)
}

impl RobotShared {
    /// Sends what comes for a run to another mailbox; answers with the one before, or none if it does not run.
    fn redirect(&self, run: u64, to: &Arc<RunMailbox>, senses: RunSenses, acts: bool) -> Option<Arc<RunMailbox>> {
        let mut table = lock(&self.table);
        let entry = table.running_mut(run)?;
        (entry.senses, entry.acts) = (senses, acts);
        Some(std::mem::replace(&mut entry.mailbox, to.clone()))
    }
}
