//! The recordings that are kept, and the one under way.

use super::RobotsPanel;
use crate::desk::tab::set_if_new;
use crate::words;
use leptos::prelude::*;
use protocol::{RecordedSession, Reply, Request};

impl RobotsPanel {
    /// Records the open behaviour, which runs, from now on.
    pub(crate) fn record_now(&self) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let (robot, session) = (self.chosen_id(), RecordedSession::default());
            self.tab.ask_or_say(Request::Record { behaviour, robot, session }, |_| {});
        }
    }

    /// Ends the recording of the open behaviour, which runs on.
    pub(crate) fn end_recording(&self) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let robot = self.chosen_id();
            self.tab.ask_or_say(Request::EndRecording { behaviour, robot }, |_| {});
        }
    }

    /// Marks this moment in the recording of the open behaviour.
    pub(crate) fn mark(&self, note: &str) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let (tab, robot) = (self.tab.clone(), self.chosen_id());
            self.tab.ask_or_say(Request::mark(behaviour, robot, note, 0), move |_| tab.say(words::marked(), false));
        }
    }

    /// Looks which recordings there are.
    pub(crate) fn list_recordings(&self) {
        let robots = self.clone();
        self.tab.ask_or_say(Request::Recordings, move |reply| {
            if let Reply::Recordings { recordings } = reply {
                set_if_new(&robots.recordings, recordings.clone());
            }
        });
    }
}
