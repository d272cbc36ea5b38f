//! Opening and leaving programs. A wish that only the moment stands against is asked again.

use super::undo::Mine;
use super::{Document, DocumentEvent, HistoryPanel};
use crate::desk::tab::{AGAIN_MS, may_pass, set_if_new};
use crate::{browser, link};
use behaviour::{Behaviour, Id};
use leptos::prelude::*;
use protocol::{Refused, Reply, Request};

impl Document {
    /// Opens a program in place of the one that is open.
    pub(crate) fn open_program(&self, id: &Id) {
        self.happened(DocumentEvent::Chosen);
        let same = self.state().wanted.replace(id.clone()).as_ref() == Some(id);
        if same && self.is_open(id) {
            return;
        }
        self.clear();
        self.tab.to_graph.set(true);
        self.remember_address(Some(id));
        self.ask_open(id.clone(), true);
    }

    /// Leaves the open program; nothing is open then.
    pub(crate) fn close_program(&self) {
        self.state().wanted = None;
        self.happened(DocumentEvent::Chosen);
        self.clear();
        self.remember_address(None);
        link::ask(Request::Leave, |_| {});
    }

    /// True if this is the program that is to be open.
    pub(in crate::desk) fn is_wanted(&self, id: &Id) -> bool {
        self.state().wanted.as_ref() == Some(id)
    }

    /// After a greeting: opens what is to be open, or sends what waits.
    pub(in crate::desk) fn reopen(&self) {
        let wanted = self.state().wanted.clone();
        match wanted {
            Some(wanted) => self.ask_open(wanted, true),
            None => self.pump(),
        }
    }

    fn ask_open(&self, id: Id, says: bool) {
        let (document, asked) = (self.clone(), id.clone());
        link::ask(Request::Open { behaviour: id }, move |reply| {
            if let Some(Reply::No { no }) = reply {
                document.not_opened(&asked, no, says);
            }
        });
    }

    fn not_opened(&self, id: &Id, no: &Refused, says: bool) {
        if !self.is_wanted(id) {
            return;
        }
        if says || !may_pass(no) {
            self.tab.say_no(no);
        }
        if *no == Refused::NoBehaviour {
            self.close_program();
            self.forget_waiting(id);
        } else if may_pass(no) {
            let (document, id) = (self.clone(), id.clone());
            browser::after(AGAIN_MS, move || document.open_if_wanted(id));
        }
    }

    /// Asks once more for what is wanted still; after a new greeting that was done already.
    fn open_if_wanted(&self, id: Id) {
        if self.is_wanted(&id) && !self.is_open(&id) && link::is_up() {
            self.ask_open(id, false);
        }
    }

    fn clear(&self) {
        self.state().mine = Mine::default();
        self.happened(DocumentEvent::Left);
        set_if_new(&self.selected, None);
        set_if_new(&self.several, Default::default());
        set_if_new(&self.tab.dialog, None);
        set_if_new(&self.open, None);
        self.revision.set(0);
        self.unfollow();
        set_if_new(&self.people, Vec::new());
        set_if_new(&self.locks, Vec::new());
        set_if_new(&self.problems, Vec::new());
        set_if_new(&self.name, String::new());
        set_if_new(&self.versions, Vec::new());
        set_if_new(&self.history, HistoryPanel::default());
        self.show_whole(Behaviour::default());
        self.end_comparing();
        self.show_steps();
    }
}
