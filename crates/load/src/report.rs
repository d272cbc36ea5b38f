//! The report of a load.

use crate::compare::{ExpectedBehaviours, Wrong};
use crate::editor::EditorTally;
use crate::plan::LoadPlan;
use crate::times::Durations;
use std::fmt;
use std::time::Duration;

/// Things that are wrong which are shown; of more only how many there are.
const WRONG_SHOWN_MAX: usize = 20;

/// The report of a load. [`std::fmt::Display`] says it in a few lines.
#[derive(Clone, Debug)]
pub struct Report {
    /// The plan that was done.
    pub plan: LoadPlan,
    /// From when an edit was due until its sender was told that it is saved.
    pub echo: Durations,
    /// Until others were told.
    pub spread: Durations,
    /// Edits that are saved.
    pub acknowledged: u64,
    /// The time until the last was.
    pub took: Duration,
    /// Edits that had to be sent again.
    pub again: u64,
    /// Links that were made anew.
    pub links: u64,
    /// The number of times that the server cut off a client that read nothing.
    pub cut_off: u64,
    /// The behaviours as they are in the end.
    pub known: ExpectedBehaviours,
    /// The faults that must not be; empty if all is well.
    pub wrong: Vec<Wrong>,
}

impl Report {
    pub(crate) fn of(plan: LoadPlan) -> Self {
        let (echo, spread, known, wrong) = Default::default();
        Self { plan, echo, spread, acknowledged: 0, took: Duration::ZERO, again: 0, links: 0, cut_off: 0, known, wrong }
    }

    pub(crate) fn add(&mut self, tally: EditorTally) {
        self.echo.add(&tally.echo);
        self.spread.add(&tally.spread);
        self.acknowledged += tally.acknowledged;
        self.again += tally.again;
        self.links += tally.links;
        self.wrong.extend(tally.wrong);
    }

    /// Edits a second.
    #[must_use]
    pub fn per_second(&self) -> f64 {
        self.acknowledged as f64 / self.took.as_secs_f64().max(f64::EPSILON)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let LoadPlan { clients, behaviours, stalled, kills, seconds, edits_per_10_s, .. } = &self.plan;
        let each = f64::from(*edits_per_10_s) / 10.0;
        writeln!(to, "{clients} clients in {behaviours} behaviours, {each} edits a second each, for {seconds} s")?;
        let took = self.took.as_secs_f64();
        writeln!(
            to,
            "saved     {} edits in {took:.1} s, {:.0} a second; {} sent again",
            self.acknowledged,
            self.per_second(),
            self.again
        )?;
        writeln!(to, "echo      {}", self.echo)?;
        writeln!(to, "to others {}", self.spread)?;
        writeln!(
            to,
            "links     {} made anew, {kills} of them ended here; {stalled} read nothing and were cut off {} times",
            self.links, self.cut_off
        )?;
        match self.wrong.len() {
            0 => write!(to, "in the end all clients and who comes anew have the same, byte by byte"),
            many => {
                write!(to, "WRONG     {many} things:")?;
                self.wrong.iter().take(WRONG_SHOWN_MAX).try_for_each(|wrong| write!(to, "\n  {wrong}"))
            }
        }
    }
}
