//! Making, opening, leaving and removing programs.

use super::{Desk, new_id, set_if_new};
use crate::link;
use behaviour::{Behaviour, Id};
use leptos::prelude::*;
use protocol::{Reply, Request, SaidNo};

impl Desk {
    /// Makes a program, from a template's id or empty, and opens it.
    pub(crate) fn create_program(&self, name: &str, template: Option<&str>) {
        let (desk, behaviour) = (self.clone(), new_id());
        let request = Request::Create { behaviour, name: name.to_owned(), template: template.map(str::to_owned) };
        self.ask_or_say(request, move |reply| {
            if let Reply::Created { behaviour } = reply {
                desk.open_program(behaviour);
            }
        });
    }

    /// Opens a program in place of the one that is open.
    pub(crate) fn open_program(&self, id: &Id) {
        let same = self.state().wanted.replace(id.clone()).as_ref() == Some(id);
        if same && self.is_open(id) {
            return;
        }
        self.clear_open();
        self.remember_address(Some(id));
        self.ask_open(id.clone());
    }

    /// Moves a program to the bin.
    pub(crate) fn remove_program(&self, id: &Id) {
        let desk = self.clone();
        let gone = id.clone();
        self.ask_or_say(Request::Remove { behaviour: id.clone() }, move |_| {
            if desk.state().wanted.as_ref() == Some(&gone) {
                desk.close_program();
            }
            desk.list_programs();
        });
    }

    /// Leaves the open program; nothing is open then.
    pub(crate) fn close_program(&self) {
        self.state().wanted = None;
        self.clear_open();
        self.remember_address(None);
        link::ask(Request::Leave, |_| {});
    }

    pub(super) fn ask_open(&self, id: Id) {
        let (desk, asked) = (self.clone(), id.clone());
        link::ask(Request::Open { behaviour: id }, move |reply| {
            if let Some(Reply::No { no }) = reply {
                desk.not_opened(&asked, no);
            }
        });
    }

    fn not_opened(&self, id: &Id, no: &SaidNo) {
        if self.state().wanted.as_ref() != Some(id) {
            return;
        }
        self.say_no(no);
        if *no == SaidNo::NoBehaviour {
            self.close_program();
            self.forget_waiting(id);
        }
    }

    fn clear_open(&self) {
        {
            let mut state = self.state();
            state.history = super::undo::History::default();
            state.when_saved = None;
            state.run = 0;
        }
        set_if_new(&self.selected, None);
        set_if_new(&self.dialog, None);
        set_if_new(&self.open, None);
        self.revision.set(0);
        set_if_new(&self.people, Vec::new());
        set_if_new(&self.problems, Vec::new());
        set_if_new(&self.name, String::new());
        self.show_whole(Behaviour::default());
        self.show_history();
    }

    /// Asks something; a no, or a missing link, is shown as a notice.
    pub(super) fn ask_or_say(&self, request: Request, on_yes: impl FnOnce(&Reply) + 'static) {
        let desk = self.clone();
        link::ask_even_down(request, move |reply| match reply {
            Some(Reply::No { no }) => desk.say_no(no),
            Some(reply) => on_yes(reply),
            None => desk.say_unreachable(),
        });
    }

    pub(super) fn say_unreachable(&self) {
        self.say(crate::words::unreachable(), true);
    }
}
