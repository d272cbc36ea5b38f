//! The recordings that are kept, and the one under way.

use super::{Desk, set_if_new};
use crate::words;
use leptos::prelude::*;
use protocol::{Reply, Request};

impl Desk {
    /// Ends the recording of the open behaviour, which runs on.
    pub(crate) fn end_recording(&self) {
        if let Some(behaviour) = self.open.get_untracked() {
            let robot = self.robot_id();
            self.ask_or_say(Request::EndRecording { behaviour, robot }, |_| {});
        }
    }

    /// Marks this moment in the recording of the open behaviour.
    pub(crate) fn mark(&self, note: &str) {
        if let Some(behaviour) = self.open.get_untracked() {
            let (desk, robot, note) = (self.clone(), self.robot_id(), note.to_owned());
            self.ask_or_say(Request::Mark { behaviour, robot, note }, move |_| desk.say(words::marked(), false));
        }
    }

    /// Looks which recordings there are.
    pub(crate) fn list_recordings(&self) {
        let desk = self.clone();
        self.ask_or_say(Request::Recordings, move |reply| {
            if let Reply::Recordings { recordings } = reply {
                set_if_new(&desk.recordings, recordings.clone());
            }
        });
    }
}
