//! What the server says, put where it belongs.

use super::{Desk, set_if_new};
use crate::browser::Keep;
use crate::link;
use behaviour::{Accepted, Behaviour, Id, Problem};
use leptos::prelude::*;
use protocol::{LIBRARY, Person, Reply, Request, Summary};

const TAB_KEY: &str = "rrp.client";
const ALIVE_KEY: &str = "rrp.alive";
const NAME_KEY: &str = "rrp.name";

impl Desk {
    /// The greeting of this tab.
    pub(crate) fn greeting(&self) -> Request {
        Request::Hello { version: protocol::VERSION, client: client_id(), name: my_name() }
    }

    /// What others see as this person's name; kept in this browser.
    pub(crate) fn set_my_name(&self, name: &str) {
        let name: String = name.trim().chars().take(40).collect();
        if !name.is_empty() && name != my_name() {
            Keep::Browser.put(NAME_KEY, &name);
            link::again();
        }
    }

    /// Hears one reply.
    pub(crate) fn hear(&self, reply: Reply) {
        match reply {
            Reply::Welcome { you, library, library_revision, templates, .. } => {
                self.welcome(you, *library, library_revision, templates);
            }
            Reply::ProgramsChanged => self.programs_changed(),
            Reply::Opened { behaviour, revision, records, problems, fingerprint, people } => {
                self.opened(behaviour.clone(), revision, *records, problems, people);
                if self.is_open(&behaviour) {
                    set_if_new(&self.fingerprint, fingerprint);
                }
            }
            Reply::Accepted { behaviour, accepted } => self.accepted(&behaviour, accepted),
            Reply::Missed { behaviour, changes } => {
                changes.into_iter().for_each(|accepted| self.accepted(&behaviour, accepted));
            }
            Reply::Problems { behaviour, problems, fingerprint, .. } if self.is_open(&behaviour) => {
                set_if_new(&self.fingerprint, fingerprint);
                set_if_new(&self.problems, problems);
            }
            Reply::People { behaviour, people } if self.is_open(&behaviour) => set_if_new(&self.people, people),
            Reply::Removed { behaviour, by } => self.removed(&behaviour, &by),
            Reply::Store { away } => self.hear_store(away),
            Reply::Robots { robots } => self.hear_robots(robots),
            Reply::Runs { runs } => self.hear_runs(runs),
            Reply::Values { values } => self.hear_values(*values),
            Reply::Scene { robot, scene } if self.robot_id().as_ref() == Some(&robot) => {
                set_if_new(&self.scene, *scene);
            }
            Reply::Ping { behaviour, library_revision } => self.hear_ping(behaviour, library_revision),
            Reply::Scene { .. }
            | Reply::Problems { .. }
            | Reply::People { .. }
            | Reply::Programs { .. }
            | Reply::Pictures { .. }
            | Reply::WhereUsed { .. }
            | Reply::Drivers { .. }
            | Reply::Contested { .. }
            | Reply::Similar { .. }
            | Reply::Recordings { .. }
            | Reply::Created { .. }
            | Reply::Checked { .. }
            | Reply::Done
            | Reply::No { .. } => {}
        }
    }

    fn welcome(&self, you: Person, library: Behaviour, library_revision: u64, templates: Vec<Summary>) {
        self.me.set(Some(you));
        set_if_new(&self.templates, templates);
        let wanted = {
            let mut state = self.state();
            state.library = library;
            state.library_revision = library_revision;
            // The server begins with the first robot.
            state.watched = None;
            state.wanted.clone()
        };
        self.refresh_library();
        self.list_programs();
        match wanted {
            Some(wanted) => self.ask_open(wanted),
            None => self.pump(),
        }
    }

    fn opened(&self, id: Id, revision: u64, records: Behaviour, problems: Vec<Problem>, people: Vec<Person>) {
        if self.state().wanted.as_ref() != Some(&id) {
            return;
        }
        self.show_whole(records);
        self.revision.set(revision);
        set_if_new(&self.problems, problems);
        set_if_new(&self.people, people);
        set_if_new(&self.open, Some(id));
        self.pump();
    }

    fn accepted(&self, to: &Id, accepted: Accepted) {
        if to.as_str() == LIBRARY {
            self.accepted_by_library(&accepted);
        } else if self.is_open(to) {
            self.accepted_by_open(to, &accepted);
        }
        self.answered(&accepted.change.op, Ok(()));
    }

    fn accepted_by_open(&self, to: &Id, accepted: &Accepted) {
        let known = self.revision.get_untracked();
        if accepted.revision > known + 1 {
            link::tell(Request::Since { behaviour: to.clone(), revision: known });
        } else if accepted.revision == known + 1 {
            let mut state = self.state();
            state.confirmed.apply(&accepted.change);
            state.history.accepted(&accepted.change);
            drop(state);
            let touched: Vec<_> = accepted.change.edits.iter().map(|edit| edit.id.clone()).collect();
            self.refresh(&touched);
            self.revision.set(accepted.revision);
        }
    }

    fn accepted_by_library(&self, accepted: &Accepted) {
        let mut state = self.state();
        let known = state.library_revision;
        if accepted.revision == known + 1 {
            state.library.apply(&accepted.change);
            state.library_revision = accepted.revision;
            drop(state);
            self.refresh_library();
        } else if accepted.revision > known {
            drop(state);
            ask_since_library(known);
        }
    }

    fn hear_ping(&self, open: Option<(Id, u64)>, library_revision: u64) {
        if let Some((id, revision)) = open
            && self.is_open(&id)
            && revision > self.revision.get_untracked()
        {
            link::tell(Request::Since { behaviour: id, revision: self.revision.get_untracked() });
        }
        let known = self.state().library_revision;
        if library_revision > known {
            ask_since_library(known);
        }
    }

    fn removed(&self, id: &Id, by: &str) {
        self.programs.update(|programs| programs.retain(|program| program.id != id.as_str()));
        if self.state().wanted.as_ref() != Some(id) {
            return;
        }
        let name = self.name.get_untracked();
        let mine = self.me.with_untracked(|me| me.as_ref().is_some_and(|me| me.name == by));
        self.close_program();
        self.forget_waiting(id);
        if !mine {
            self.say(&format!("{by} removed “{name}”. Choose another program."), false);
        }
    }

    pub(super) fn is_open(&self, id: &Id) -> bool {
        self.open.with_untracked(|open| open.as_ref() == Some(id))
    }
}

fn ask_since_library(revision: u64) {
    if let Ok(behaviour) = Id::new(LIBRARY) {
        link::tell(Request::Since { behaviour, revision });
    }
}

/// The name of this tab. A doubled tab copies what is kept for a tab, so a tab that is alive already counts as another.
fn client_id() -> Id {
    thread_local! {
        static ID: Id = choose_client_id();
    }
    ID.with(Id::clone)
}

fn choose_client_id() -> Id {
    let doubled = Keep::Tab.get(ALIVE_KEY).is_some();
    let kept = Keep::Tab.get(TAB_KEY).filter(|_| !doubled).and_then(|text| Id::new(&text).ok());
    let id = kept.unwrap_or_else(super::new_id);
    Keep::Tab.put(TAB_KEY, id.as_str());
    Keep::Tab.put(ALIVE_KEY, "1");
    if let Some(window) = crate::browser::window() {
        crate::browser::hear(&window, "pagehide", |_| Keep::Tab.drop(ALIVE_KEY));
        crate::browser::hear(&window, "pageshow", |_| Keep::Tab.put(ALIVE_KEY, "1"));
    }
    id
}

/// The name in this browser, at first "Guest" with a number.
fn my_name() -> String {
    Keep::Browser.get(NAME_KEY).unwrap_or_else(|| {
        let name = format!("Guest {}", (crate::browser::random() * 90.0) as u32 + 10);
        Keep::Browser.put(NAME_KEY, &name);
        name
    })
}
