//! Making, opening, leaving and removing programs. A wish that only the moment stands against is asked again.

use super::{Desk, new_id, set_if_new};
use crate::{browser, link, words};
use behaviour::{Behaviour, Id, Refusal};
use leptos::prelude::*;
use protocol::{Refused, Reply, Request};

/// When something that could not be done just now is asked again.
const AGAIN_MS: i32 = 1_000;

/// A program that is to be made; asked twice with one id, the server makes one.
#[derive(Clone)]
pub(super) struct Making {
    behaviour: Id,
    name: String,
    template: Option<String>,
    /// Whether it was said that it takes longer.
    said: bool,
}

/// Whether the same may work in a moment.
fn may_pass(no: &Refused) -> bool {
    matches!(no, Refused::Store(_) | Refused::TooFast | Refused::Change(Refusal::NotSaved(_)))
}

impl Desk {
    /// Makes a program, from a template's id or empty, and opens it.
    pub(crate) fn create_program(&self, name: &str, template: Option<&str>) {
        if !link::is_up() {
            return self.say_unreachable();
        }
        let behaviour = new_id();
        let (name, template) = (name.to_owned(), template.map(str::to_owned));
        self.state().making = Some(Making { behaviour: behaviour.clone(), name, template, said: false });
        self.make(behaviour);
    }

    /// Asks for what is to be made, if nobody wished for something else since.
    fn make(&self, behaviour: Id) {
        let making = self.state().making.clone().filter(|making| making.behaviour == behaviour);
        let Some(Making { behaviour, name, template, .. }) = making else { return };
        let (desk, made) = (self.clone(), behaviour.clone());
        link::ask_even_down(Request::Create { behaviour, name, template }, move |reply| match reply {
            Some(Reply::No { no }) if !may_pass(no) => {
                desk.state().making = None;
                desk.say_no(no);
            }
            Some(Reply::Created { .. }) if desk.state().making.as_ref().is_some_and(|m| m.behaviour == made) => {
                desk.open_program(&made);
            }
            Some(Reply::No { .. }) | None => desk.make_again(made),
            Some(_) => {}
        });
    }

    fn make_again(&self, behaviour: Id) {
        let mut state = self.state();
        let Some(making) = state.making.as_mut().filter(|making| making.behaviour == behaviour) else { return };
        let says = (!std::mem::replace(&mut making.said, true)).then(|| words::not_made_yet(&making.name));
        drop(state);
        if let Some(says) = says {
            self.say(&says, true);
        }
        let desk = self.clone();
        browser::after(AGAIN_MS, move || desk.make(behaviour));
    }

    /// Opens a program in place of the one that is open.
    pub(crate) fn open_program(&self, id: &Id) {
        self.state().making = None;
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
        let mut state = self.state();
        (state.wanted, state.making) = (None, None);
        drop(state);
        self.clear_open();
        self.remember_address(None);
        link::ask(Request::Leave, |_| {});
    }

    pub(super) fn ask_open(&self, id: Id) {
        self.ask_open_and(id, true);
    }

    fn ask_open_and(&self, id: Id, says: bool) {
        let (desk, asked) = (self.clone(), id.clone());
        link::ask(Request::Open { behaviour: id }, move |reply| {
            if let Some(Reply::No { no }) = reply {
                desk.not_opened(&asked, no, says);
            }
        });
    }

    fn not_opened(&self, id: &Id, no: &Refused, says: bool) {
        if self.state().wanted.as_ref() != Some(id) {
            return;
        }
        if says || !may_pass(no) {
            self.say_no(no);
        }
        if *no == Refused::NoBehaviour {
            self.close_program();
            self.forget_waiting(id);
        } else if may_pass(no) {
            let (desk, id) = (self.clone(), id.clone());
            browser::after(AGAIN_MS, move || desk.open_if_wanted(id));
        }
    }

    /// Asks once more for what is wanted still; after a new greeting that was done already.
    fn open_if_wanted(&self, id: Id) {
        if self.state().wanted.as_ref() == Some(&id) && !self.is_open(&id) && link::is_up() {
            self.ask_open_and(id, false);
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
        self.say(words::unreachable(), true);
    }
}
