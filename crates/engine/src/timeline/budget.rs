//! The budget of the values of one reading, or of one tick: so many turns of connectors, and no further once the caller
//! stops the run.

use crate::cost::Limits;
use std::rc::Rc;

/// Turns of connectors between two questions whether the run is stopped.
const TURNS_PER_QUESTION: i64 = 1_000;

/// The turns that are left for one value.
pub(crate) struct TurnBudget {
    turns_max: i64,
    left: i64,
    /// With so many left or fewer it is asked again; never below 0.
    ask_at: i64,
    stop: Option<Rc<dyn Fn() -> bool>>,
}

/// The reasons why values go no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spent {
    /// The caller stopped the run.
    Stopped,
    /// There were too many turns.
    Turns,
}

impl TurnBudget {
    /// For a graph with so many turns if every connector takes one value of each input.
    pub(crate) fn of(limits: &Limits, turns_once: usize) -> Self {
        let turns_max = i64::try_from(limits.handed.max(turns_once as u64)).unwrap_or(i64::MAX);
        let stop = limits.stop.clone();
        Self { turns_max, left: turns_max, ask_at: (turns_max - TURNS_PER_QUESTION).max(0), stop }
    }

    /// Returns the most turns that there may be.
    pub(crate) fn turns_max(&self) -> u64 {
        self.turns_max.unsigned_abs()
    }

    /// Another reading, or another tick, begins. How soon it is asked does not change.
    #[inline]
    pub(crate) fn begin(&mut self) {
        self.ask_at = (self.ask_at + (self.turns_max - self.left)).max(0);
        self.left = self.turns_max;
    }

    /// Takes the turns that so many connectors are about to have.
    #[inline(always)]
    pub(crate) fn take(&mut self, turns: u32) -> Option<Spent> {
        self.left -= i64::from(turns);
        if self.left < self.ask_at { self.ask() } else { None }
    }

    #[cold]
    fn ask(&mut self) -> Option<Spent> {
        self.ask_at = (self.left - TURNS_PER_QUESTION).max(0);
        if self.left < 0 {
            return Some(Spent::Turns);
        }
        self.stop.as_ref().is_some_and(|stop| stop()).then_some(Spent::Stopped)
    }
}
