//! Where what a run emits goes: values for actions to the robot's desk, counts to the tally.

use super::desk::{Command, Wanted};
use super::runner::Job;
use super::tally::Tally;
use engine::Emission;
use robot::Use;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::time::Instant;

/// Where what a run emits goes.
pub(super) struct Outcome<'a> {
    /// The run.
    pub(super) job: &'a Job,
    /// What it counted.
    pub(super) tally: Tally,
    /// For every actuator stream its use and device.
    uses: BTreeMap<usize, (Use, String)>,
    /// When the procedure that runs now began, or a little before.
    pub(super) clock: Rc<Cell<Instant>>,
    /// The connector that took too long last.
    pub(super) too_long: Option<usize>,
}

impl<'a> Outcome<'a> {
    /// For a run that commands these devices.
    pub(super) fn new(job: &'a Job, tally: Tally, actions: Vec<Wanted>, clock: Rc<Cell<Instant>>) -> Self {
        let of = |wanted: Wanted| (wanted.index, (Use { run: job.run, stream: wanted.stream }, wanted.device));
        Self { job, tally, uses: actions.into_iter().map(of).collect(), clock, too_long: None }
    }

    /// Takes what the run emits.
    pub(super) fn note(&mut self, emission: Emission) {
        self.clock.set(Instant::now());
        match emission {
            Emission::Value { at, stream, value } => {
                self.tally.carried(stream, at.0);
                if let Some((user, device)) = self.uses.get(&stream) {
                    let command = Command { gate: self.job.gate.clone(), value: value.clone() };
                    self.job.house.desk.command(user.clone(), device, command);
                }
            }
            Emission::Fault { connector, deadline, .. } => {
                self.tally.failed();
                if deadline {
                    self.too_long = Some(connector);
                }
            }
        }
    }
}
