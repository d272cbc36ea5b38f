//! Reading the history of the open program: its newest page when it is opened, older ones on demand.

use crate::answers::{AGAIN_MS, may_pass};
use crate::effect::{AlarmPurpose, Announcement, Effect, Purpose};
use crate::{Editor, HistoryPanel, LinkState, NoAnswer};
use behaviour::{Accepted, Id};
use protocol::{answer, request};

/// The number of newest changes in which the server looks for what can be taken back.
const UNDO_LOOKS_AT: usize = 512;

impl Editor {
    /// Begins the history of what was opened; what is known of it stays if nothing was missed.
    pub(crate) fn begin_history(&mut self, revision: u64) {
        if self.history.newest_first().next().map(|line| line.revision) != Some(revision) {
            self.history.put(HistoryPanel::default());
        }
        self.reads_history = false;
        if !self.history.is_read {
            self.ask_history(None);
        }
        self.show_steps();
    }

    /// Forgets a history that is not right, and reads it anew.
    pub(crate) fn forget_history(&mut self) {
        self.history.put(HistoryPanel::default());
        self.ask_history(None);
        self.show_steps();
    }

    /// A change was made: the history grows.
    pub(crate) fn note_history(&mut self, accepted: &Accepted) {
        self.history.update(|history| history.made(accepted));
        if self.me.client.is_some() && accepted.change.by == self.me.client {
            self.mine.made(&accepted.change);
            self.show_steps();
        }
    }

    /// Asks for what was before all that is known.
    pub fn read_older(&mut self) {
        if self.history.more {
            self.ask_history(self.history.oldest());
        }
    }

    pub(crate) fn ask_history(&mut self, before: Option<u64>) {
        let Some(behaviour) = (*self.open).clone() else { return };
        if !std::mem::replace(&mut self.reads_history, true) {
            let asked = Purpose::History { behaviour: behaviour.clone(), before };
            self.ask(request::History { behaviour, before }, asked);
        }
    }

    pub(crate) fn history_answered(
        &mut self,
        behaviour: Id,
        before: Option<u64>,
        answer: Result<answer::History, NoAnswer>,
    ) {
        if !self.is_open(&behaviour) {
            return;
        }
        self.reads_history = false;
        match answer {
            Ok(answer::History { lines, more, .. }) => {
                self.history.update(|history| history.read(&lines, more));
                self.show_steps();
            }
            Err(NoAnswer::Refused(no)) if may_pass(&no) => {
                self.effect(Effect::After(AGAIN_MS, AlarmPurpose::History(behaviour, before)));
            }
            Err(NoAnswer::Refused(no)) => self.say(Announcement::Refused(no)),
            Err(NoAnswer::Unreachable) => {}
        }
    }

    /// Reads on while nothing is known that could be taken back: older changes may tell. A link that broke meanwhile, or an
    /// undo of all that was known, ends that as little as a page of changes of others.
    pub(crate) fn seek_own_change(&mut self) {
        let is_known = self.undoable.is_some() || !self.history.is_read || self.history.len() >= UNDO_LOOKS_AT;
        if !is_known && self.link == LinkState::Online {
            self.read_older();
        }
    }
}
