//! Start, applying edits, stimulating and the room: what is asked of a robot but never saved. Stop is plain HTML and needs
//! nothing of this.

use super::RobotsPanel;
use crate::{link, words};
use behaviour::{Id, Value};
use leptos::prelude::*;
use protocol::{RecordedSession, Role, request};
use robot::SceneEdit;

/// A press that waits until what was changed is saved: all that it meant when it was pressed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WaitingPress {
    intent: StartIntent,
    behaviour: Id,
    robot: Option<Id>,
    record: bool,
    /// The newest Stop of which the person had heard. The server compares it with those of the robot that is meant.
    stops: Option<u64>,
}

/// The wish that the robot is to do with the open behaviour once it is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StartIntent {
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

    fn wish(&self, intent: StartIntent) {
        if self.tab.refuses(Role::Operator) {
            return;
        }
        // Never later than now: a robot must not begin to move when a lost link comes back.
        if !link::is_up() {
            self.state().when_saved = None;
            return self.tab.say_unreachable();
        }
        let Some(behaviour) = self.document.open.get_untracked() else { return };
        let (robot, record, stops) = (self.chosen_id(), self.records.get_untracked(), link::stops());
        self.state().when_saved = Some(WaitingPress { intent, behaviour, robot, record, stops });
        self.start_if_saved();
        // Nobody knows when that is over: the robot would begin to move long after it was meant.
        if !self.document.can_save() {
            self.give_up_press();
        }
    }

    /// A press does not outlive what could not be saved, and says so.
    pub(in crate::desk) fn give_up_press(&self) {
        let Some(press) = self.state().when_saved.take() else { return };
        let button = match press.intent {
            StartIntent::Start => words::start(),
            StartIntent::Apply => words::apply(),
        };
        self.tab.say_beside_reason(words::press_given_up(button));
    }

    /// Asks what was pressed, if nothing waits to be saved.
    pub(in crate::desk) fn start_if_saved(&self) {
        let is_saved = self.document.is_saved();
        let Some(press) = self.state().when_saved.take_if(|_| is_saved) else { return };
        let WaitingPress { intent, behaviour, robot, record, stops } = press;
        match intent {
            StartIntent::Start => {
                let session = RecordedSession::default();
                self.tab.ask_or_say_as_of(stops, request::Start { behaviour, robot, record, session }, |()| {});
            }
            StartIntent::Apply => {
                let (tab, revision) = (self.tab.clone(), self.document.revision.get_untracked());
                let on_yes = move |()| tab.say(&words::applied(revision), false);
                self.tab.ask_or_say_as_of(stops, request::Apply { behaviour, robot }, on_yes);
            }
        }
    }

    /// Sends a value to a sensor stream of the running behaviour as if the robot had sensed it.
    pub(crate) fn stimulate(&self, stream: &Id, value: Value, on_yes: impl FnOnce() + 'static) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let robot = self.chosen_id();
            self.tab.ask_or_say(request::Stimulate { behaviour, robot, stream: stream.clone(), value }, |_| on_yes());
        }
    }

    /// Moves something in the simulated room.
    pub(crate) fn scene_edit(&self, edit: SceneEdit) {
        if self.tab.refusal(Role::Operator).is_some() {
            return;
        }
        link::tell(request::Scene { robot: self.chosen_id(), edit });
    }
}
