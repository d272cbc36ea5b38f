//! The runs beside the open program: their order, and stopping one of them.

use super::RobotsPanel;
use crate::words;
use behaviour::Id;
use behaviour::sort_few;
use leptos::prelude::*;
use protocol::{RunPhase, RunState, request};

impl RobotsPanel {
    /// Everything that runs on the robot that this tab looks at, from the top of the order. Reactive.
    pub(crate) fn all_running(&self) -> Vec<RunState> {
        let mut running = self.runs_here();
        running.retain(|run| run.phase == RunPhase::Running);
        sort_few(&mut running, |one, other| one.place < other.place);
        running
    }

    /// True if what is edited would run differently: the open program or a helper that it uses was changed. Reactive.
    pub(crate) fn runs_older(&self, run: &RunState) -> bool {
        self.document.fingerprint.get() != run.fingerprint
    }

    /// Says who keeps a part of the robot from this action of the open program. Reactive.
    pub(crate) fn held(&self, stream: &Id) -> Option<String> {
        let run = self.running()?;
        run.held.iter().find(|held| held.stream == *stream).map(|held| words::held_by(&held.part, &held.name))
    }

    /// Puts a running behaviour just above another one, or at the end.
    pub(crate) fn place(&self, behaviour: &Id, above: Option<Id>) {
        let robot = self.chosen_id();
        self.tab.ask_or_say_no(request::Place { behaviour: behaviour.clone(), robot, above });
    }

    /// Puts one in the place of another one of the list: from above it comes to stand below that one.
    pub(crate) fn place_at(&self, order: &[Id], moved: &Id, target: &Id) {
        let at = |id: &Id| order.iter().position(|known| known == id);
        match (at(moved), at(target)) {
            (Some(from), Some(to)) if from < to => self.place(moved, order.get(to + 1).cloned()),
            (Some(from), Some(to)) if from > to => self.place(moved, Some(target.clone())),
            _ => {}
        }
    }

    /// Stops one behaviour; the others run on.
    pub(crate) fn stop_one(&self, behaviour: &Id) {
        let robot = self.chosen_id();
        self.tab.ask_or_say_no(request::Stop { behaviour: Some(behaviour.clone()), robot });
    }
}
