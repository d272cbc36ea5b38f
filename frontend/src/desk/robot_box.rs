//! Start, applying edits, stimulating, the room, trying procedures, and presence: what is asked but never saved. Stop is plain
//! HTML and needs nothing of this.

use super::{Desk, Selected};
use crate::{browser, link};
use behaviour::{Id, Value};
use leptos::prelude::*;
use protocol::{Pointer, Reply, Request};
use robot::SceneEdit;

/// How often others are told where this person is, in milliseconds.
const PRESENCE_MS: i32 = 50;

/// What a procedure makes of given values: why it cannot run at all, and one result per set of values.
pub(crate) type Checked = (Option<String>, Vec<Result<Value, String>>);

/// What the robot is to do with the open behaviour once it is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wish {
    /// Run it from the beginning.
    Start,
    /// Go on with it where the run is.
    Apply,
}

impl Desk {
    /// Runs the open behaviour as soon as what was changed is saved.
    pub(crate) fn start(&self) {
        self.wish(Wish::Start);
    }

    /// Lets the run of the open behaviour go on with what was changed, as soon as that is saved.
    pub(crate) fn apply(&self) {
        self.wish(Wish::Apply);
    }

    fn wish(&self, wish: Wish) {
        // Never later than now: a robot must not begin to move when a lost link comes back.
        self.state().when_saved = link::is_up().then_some(wish);
        if link::is_up() {
            self.start_if_saved();
        } else {
            self.say_unreachable();
        }
    }

    pub(super) fn start_if_saved(&self) {
        let now = {
            let mut state = self.state();
            let is_saved = state.queue.len() == 0;
            state.when_saved.take_if(|_| is_saved)
        };
        let Some(behaviour) = self.open.get_untracked() else { return };
        match now {
            Some(Wish::Start) => {
                let (robot, record) = (self.robot_id(), self.records.get_untracked());
                self.ask_or_say(Request::Start { behaviour, robot, record }, |_| {})
            }
            Some(Wish::Apply) => self.ask_to_apply(behaviour),
            None => {}
        }
    }

    fn ask_to_apply(&self, behaviour: Id) {
        let (desk, revision) = (self.clone(), self.revision.get_untracked());
        let on_yes = move |_: &Reply| desk.say(&crate::words::applied(revision), false);
        let robot = self.robot_id();
        self.ask_or_say(Request::Apply { behaviour, robot }, on_yes);
    }

    /// Sends a value to a sensor stream of the running behaviour as if the robot had sensed it.
    pub(crate) fn stimulate(&self, stream: &Id, value: Value) {
        if let Some(behaviour) = self.open.get_untracked() {
            let robot = self.robot_id();
            self.ask_or_say(Request::Stimulate { behaviour, robot, stream: stream.clone(), value }, |_| {});
        }
    }

    /// Moves something in the simulated room.
    pub(crate) fn scene_edit(&self, edit: SceneEdit) {
        link::tell(Request::Scene { robot: self.robot_id(), edit });
    }

    /// Whether a procedure can run, and what it makes of at most 8 sets of values. Not answered while offline.
    pub(crate) fn check_body(
        &self,
        arguments: Vec<String>,
        body: String,
        inputs: Vec<Vec<Value>>,
        on_answer: impl FnOnce(Checked) + 'static,
    ) {
        link::ask(Request::Check { arguments, body, inputs }, move |reply| {
            if let Some(Reply::Checked { error, results }) = reply {
                on_answer((error.clone(), results.clone()));
            }
        });
    }

    /// Tells the others, at most 20 times a second, where the pointer is and what is selected.
    pub(crate) fn present(&self, pointer: Option<Pointer>) {
        let plan = {
            let mut state = self.state();
            state.pointer = pointer;
            !std::mem::replace(&mut state.presence_planned, true)
        };
        if plan {
            let desk = self.clone();
            browser::after(PRESENCE_MS, move || desk.tell_presence());
        }
    }

    /// Tells the others that something else is selected now.
    pub(crate) fn present_selection(&self) {
        let pointer = self.state().pointer;
        self.present(pointer);
    }

    fn tell_presence(&self) {
        let pointer = {
            let mut state = self.state();
            state.presence_planned = false;
            state.pointer
        };
        if self.open.with_untracked(Option::is_some) {
            let selected = self.selected.with_untracked(|selected| selected.as_ref().map(Selected::id).cloned());
            link::tell(Request::Present { pointer, selected });
        }
    }
}
