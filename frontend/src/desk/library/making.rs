//! Making and removing programs, and taking them out of the bin. What only the moment stands against is asked again.

use super::LibraryPanel;
use crate::desk::tab::{AGAIN_MS, Gone, new_id, set_if_new};
use crate::link::NoAnswer;
use crate::{browser, link, words};
use behaviour::Id;
use editor::may_pass;
use leptos::prelude::*;
use protocol::{Refused, Summary, request};

/// A program that is to be made; asked twice with one id, the server makes one.
#[derive(Clone)]
pub(super) struct ProgramMaking {
    behaviour: Id,
    name: String,
    template: Option<String>,
    /// True if it was said that it takes longer.
    said: bool,
}

impl LibraryPanel {
    /// Makes a program, from a template's id or empty, and opens it.
    pub(crate) fn create_program(&self, name: &str, template: Option<&str>) {
        if !link::is_up() {
            return self.tab.say_unreachable();
        }
        let behaviour = new_id();
        let (name, template) = (name.to_owned(), template.map(str::to_owned));
        self.state().making = Some(ProgramMaking { behaviour: behaviour.clone(), name, template, said: false });
        self.make(behaviour);
    }

    /// Somebody chose something else: what is to be made is not opened any more.
    pub(in crate::desk) fn forget_making(&self) {
        self.state().making = None;
        set_if_new(&self.gone, None);
    }

    /// Asks for what is to be made, if nobody wished for something else since.
    fn make(&self, behaviour: Id) {
        let making = self.state().making.clone().filter(|making| making.behaviour == behaviour);
        let Some(ProgramMaking { behaviour, name, template, .. }) = making else { return };
        let (library, made) = (self.clone(), behaviour.clone());
        link::ask_even_down(request::Create { behaviour, name, template }, move |answer| match answer {
            Ok(_) if library.is_making(&made) => library.document.open_program(&made),
            Ok(_) => {}
            Err(NoAnswer::Refused(no)) if !may_pass(&no) => {
                library.forget_making();
                library.tab.say_no(&no);
            }
            Err(_) => library.make_again(made),
        });
    }

    fn is_making(&self, behaviour: &Id) -> bool {
        self.state().making.as_ref().is_some_and(|making| making.behaviour == *behaviour)
    }

    fn make_again(&self, behaviour: Id) {
        let mut state = self.state();
        let Some(making) = state.making.as_mut().filter(|making| making.behaviour == behaviour) else { return };
        let says = (!std::mem::replace(&mut making.said, true)).then(|| words::not_made_yet(&making.name));
        drop(state);
        if let Some(says) = says {
            self.tab.say(&says, true);
        }
        let library = self.clone();
        browser::after(AGAIN_MS, move || library.make(behaviour));
    }

    /// Moves a program to the bin.
    pub(crate) fn remove_program(&self, id: &Id, name: &str) {
        let (library, id, name) = (self.clone(), id.clone(), name.to_owned());
        self.tab.removing.set(Some(id.clone()));
        self.tab.look_up(request::Remove { behaviour: id.clone() }, move |answer| {
            set_if_new(&library.tab.removing, None);
            if let Err(why) = answer {
                return library.tab.say_no_answer(why);
            }
            if library.document.is_wanted(&id) {
                library.document.close_program();
            }
            let gone = Gone { id, name };
            library.tab.say_gone(&words::program_removed(&gone.name), gone.clone());
            library.gone.set(Some(gone));
            library.list_programs();
        });
    }

    /// Takes a program out of the bin and opens it, unless something else was opened meanwhile. If it is not in the bin any
    /// more, somebody else was first, and opening it says whether it is there.
    pub(crate) fn bring_back(&self, gone: &Gone) {
        let (library, Gone { id, name }) = (self.clone(), gone.clone());
        self.tab.look_up(request::Restore { behaviour: id.clone() }, move |answer| {
            match answer {
                Ok(_) => library.tab.say(&words::is_back(&name), false),
                Err(NoAnswer::Refused(Refused::NoBehaviour)) => {}
                Err(why) => return library.tab.say_no_answer(why),
            }
            set_if_new(&library.gone, None);
            if library.document.open.with_untracked(Option::is_none) {
                library.document.open_program(&id);
            }
        });
    }

    /// Takes a program out of the bin.
    pub(crate) fn restore_program(&self, program: &Summary) {
        let (tab, name) = (self.tab.clone(), program.name.clone());
        let Ok(behaviour) = Id::new(&program.id) else { return };
        self.tab.ask_or_say(request::Restore { behaviour }, move |_| tab.say(&words::is_back(&name), false));
    }
}
