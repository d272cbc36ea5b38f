//! Reading the history of the open behaviour: its newest page when it is opened, older ones on demand.

use super::{Document, HistoryPanel};
use crate::desk::tab::{AGAIN_MS, may_pass};
use crate::{browser, link};
use behaviour::{Accepted, Id};
use leptos::prelude::*;
use protocol::{Reply, Request};

/// The number of newest changes in which the server looks for what can be taken back.
const UNDO_LOOKS_AT: usize = 512;

impl Document {
    /// Begins the history of what was opened; what is known of it stays if nothing was missed.
    pub(super) fn begin_history(&self, revision: u64) {
        let newest = self.history.with_untracked(|history| history.newest_first().next().map(|line| line.revision));
        if newest != Some(revision) {
            self.history.set(HistoryPanel::default());
        }
        self.state().reads_history = false;
        if !self.history.with_untracked(|history| history.is_read) {
            self.ask_history(None);
        }
        self.show_steps();
    }

    /// Forgets a history that is not right, and reads it anew.
    pub(super) fn forget_history(&self) {
        self.history.set(HistoryPanel::default());
        self.ask_history(None);
        self.show_steps();
    }

    /// A change was made: the history grows.
    pub(super) fn note_history(&self, accepted: &Accepted) {
        self.history.update(|history| history.made(accepted));
        let me = self.tab.me.with_untracked(|me| me.as_ref().map(|me| me.client.clone()));
        if me.is_some() && accepted.change.by == me {
            self.state().mine.made(&accepted.change);
            self.show_steps();
        }
    }

    /// Asks for what was before all that is known.
    pub(crate) fn read_older(&self) {
        let (more, oldest) = self.history.with_untracked(|history| (history.more, history.oldest()));
        if more {
            self.ask_history(oldest);
        }
    }

    fn ask_history(&self, before: Option<u64>) {
        let Some(behaviour) = self.open.get_untracked() else { return };
        if std::mem::replace(&mut self.state().reads_history, true) {
            return;
        }
        let document = self.clone();
        link::ask_even_down(Request::History { behaviour: behaviour.clone(), before }, move |reply| {
            if document.is_open(&behaviour) {
                document.state().reads_history = false;
                document.hear_history(behaviour, before, reply);
            }
        });
    }

    fn hear_history(&self, behaviour: Id, before: Option<u64>, reply: Option<&Reply>) {
        match reply {
            Some(Reply::History { lines, more, .. }) => {
                self.history.update(|history| history.read(lines, *more));
                self.show_steps();
                if self.seeks_own_change() {
                    self.read_older();
                }
            }
            Some(Reply::No { no }) if may_pass(no) => {
                let document = self.clone();
                browser::after(AGAIN_MS, move || {
                    if document.is_open(&behaviour) {
                        document.ask_history(before);
                    }
                });
            }
            Some(Reply::No { no }) => self.tab.say_no(no),
            Some(_) | None => {}
        }
    }

    /// True if older changes may tell what can be taken back.
    fn seeks_own_change(&self) -> bool {
        self.undoable.with_untracked(Option::is_none) && self.history.with_untracked(HistoryPanel::len) < UNDO_LOOKS_AT
    }
}
