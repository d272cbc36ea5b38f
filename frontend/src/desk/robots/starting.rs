//! Start, applying edits, stimulating and the room: what is asked of a robot but never saved. Stop is plain HTML and needs
//! nothing of this.

use super::RobotsPanel;
use crate::{link, words};
use behaviour::{Id, Value};
use leptos::prelude::*;
use protocol::{RecordedSession, Reply, Request, Role};
use robot::SceneEdit;

/// The wish that the robot is to do with the open behaviour once it is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StartIntent {
    /// Run it from the beginning.
    Start,
    /// Go on with it where the run is.
    Apply,
}

impl RobotsPanel {
    /// Runs the open behaviour as soon as what was changed is saved.
    pub(crate) fn start(&self) {
        self.wish(StartIntent::Start);
    }

    /// Lets the run of the open behaviour go on with what was changed, as soon as that is saved.
    /// Refuses while somebody else is still at one of the changes: it may be half of what they mean.
    pub(crate) fn apply(&self) {
        if let Some((name, of)) = untrack(|| self.unfinished()) {
            return self.tab.say(&words::not_while_edited(&name, &of), true);
        }
        self.wish(StartIntent::Apply);
    }

    fn wish(&self, wish: StartIntent) {
        if self.tab.refuses(Role::Operator) {
            return;
        }
        // Never later than now: a robot must not begin to move when a lost link comes back.
        self.state().when_saved = link::is_up().then_some(wish);
        if link::is_up() {
            self.start_if_saved();
        } else {
            self.tab.say_unreachable();
        }
    }

    /// A wish does not outlive what could not be saved.
    pub(in crate::desk) fn forget_wish(&self) {
        self.state().when_saved = None;
    }

    /// Asks what was wished for, if nothing waits to be saved.
    pub(in crate::desk) fn start_if_saved(&self) {
        let is_saved = self.document.is_saved();
        let now = self.state().when_saved.take_if(|_| is_saved);
        let Some(behaviour) = self.document.open.get_untracked() else { return };
        match now {
            Some(StartIntent::Start) => {
                let (robot, record) = (self.chosen_id(), self.records.get_untracked());
                self.tab.ask_or_say(
                    Request::Start { behaviour, robot, record, session: RecordedSession::default() },
                    |_| {},
                )
            }
            Some(StartIntent::Apply) => self.ask_to_apply(behaviour),
            None => {}
        }
    }

    fn ask_to_apply(&self, behaviour: Id) {
        let (tab, revision) = (self.tab.clone(), self.document.revision.get_untracked());
        let on_yes = move |_: &Reply| tab.say(&words::applied(revision), false);
        let robot = self.chosen_id();
        self.tab.ask_or_say(Request::Apply { behaviour, robot }, on_yes);
    }

    /// Sends a value to a sensor stream of the running behaviour as if the robot had sensed it.
    pub(crate) fn stimulate(&self, stream: &Id, value: Value, on_yes: impl FnOnce() + 'static) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let robot = self.chosen_id();
            self.tab.ask_or_say(Request::Stimulate { behaviour, robot, stream: stream.clone(), value }, |_| on_yes());
        }
    }

    /// Moves something in the simulated room.
    pub(crate) fn scene_edit(&self, edit: SceneEdit) {
        if self.tab.refusal(Role::Operator).is_some() {
            return;
        }
        link::tell(Request::Scene { robot: self.chosen_id(), edit });
    }
}
