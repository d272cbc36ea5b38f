//! The recording under way.

use super::RobotsPanel;
use crate::words;
use leptos::prelude::*;
use protocol::{RecordedSession, request};

impl RobotsPanel {
    /// Records the open behaviour, which runs, from now on.
    pub(crate) fn record_now(&self) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let (robot, session) = (self.chosen_id(), RecordedSession::default());
            self.tab.ask_or_say_no(request::Record { behaviour, robot, session });
        }
    }

    /// Ends the recording of the open behaviour, which runs on.
    pub(crate) fn end_recording(&self) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let robot = self.chosen_id();
            self.tab.ask_or_say_no(request::EndRecording { behaviour, robot });
        }
    }

    /// Marks this moment in the recording of the open behaviour.
    pub(crate) fn mark(&self, note: &str) {
        if let Some(behaviour) = self.document.open.get_untracked() {
            let (tab, robot) = (self.tab.clone(), self.chosen_id());
            self.tab.ask_or_say(request::Mark::with_note(behaviour, robot, note, 0), move |_| {
                tab.say(words::marked(), false)
            });
        }
    }
}
