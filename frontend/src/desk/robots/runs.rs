//! The run of the open behaviour on the robot that this tab looks at.

use super::RobotsPanel;
use crate::browser;
use leptos::prelude::*;
use protocol::{RunPhase, RunState};

impl RobotsPanel {
    /// The run of the open behaviour on the robot that this tab looks at, if it runs there. Reactive.
    pub(crate) fn running(&self) -> Option<RunState> {
        self.document.open.track();
        self.chosen.track();
        self.runs.track();
        self.run_of_open()
    }

    /// Returns the answer of [`RobotsPanel::running`], without being told when it changes.
    pub(super) fn run_of_open(&self) -> Option<RunState> {
        let open = self.document.open.get_untracked()?;
        let here = self.chosen_id()?;
        let is_it = |run: &&RunState| run.behaviour == open && run.robot == here && run.phase == RunPhase::Running;
        self.runs.with_untracked(|runs| runs.iter().rfind(is_it).cloned())
    }

    /// Twice a second: what is told of times and faults follows the clock while the open behaviour runs.
    pub(in crate::desk) fn tick(&self) {
        if self.run_of_open().is_some() {
            self.clock.set(browser::now_ms());
            self.renew_failing();
        }
    }

    /// The server begins with the first robot after every greeting.
    pub(in crate::desk) fn begin_anew(&self) {
        self.state().watched = None;
    }

    /// Leaves what was open: nothing is wished for, and values belong to no run.
    pub(in crate::desk) fn leave(&self) {
        self.give_up_press();
        self.state().run = 0;
    }
}
