//! What the server says, put where it belongs.

use super::{Desk, set_if_new};
use crate::browser::Keep;
use crate::link;
use behaviour::{Accepted, Behaviour, Id, Kind, Problem};
use leptos::prelude::*;
use protocol::{Credential, LIBRARY, Person, Reply, Request, Summary};

const TAB_KEY: &str = "rrp.client";
const ALIVE_KEY: &str = "rrp.alive";
/// Of so many removed things it is remembered who removed them.
const REMOVED_MAX: usize = 2_000;
const NAME_KEY: &str = "rrp.name";

impl Desk {
    /// The greeting of this tab.
    pub(crate) fn greeting(&self) -> Request {
        Request::Hello { version: protocol::VERSION, name: my_name(), again: kept_credential() }
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
            Reply::Welcome { you, secret, library, library_revision, templates, .. } => {
                keep_credential(&you.client, &secret);
                self.welcome(you, *library, library_revision, templates);
            }
            Reply::ProgramsChanged => self.programs_changed(),
            Reply::Opened { behaviour, revision, records, problems, fingerprint, people, .. } => {
                self.opened(behaviour.clone(), revision, *records, problems, people);
                if self.is_open(&behaviour) {
                    set_if_new(&self.fingerprint, fingerprint);
                }
            }
            Reply::Accepted { behaviour, accepted } => self.accepted(&behaviour, accepted),
            Reply::Missed { behaviour, changes, more } => {
                changes.into_iter().for_each(|accepted| self.accepted(&behaviour, accepted));
                if more {
                    self.ask_since(behaviour);
                }
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
            | Reply::Records { .. }
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
        self.state().version = None;
        self.follow_version();
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
            state.history.accepted(&accepted.change.op);
            drop(state);
            let touched: Vec<_> = accepted.change.edits.iter().map(|edit| edit.id.clone()).collect();
            self.note_removed(accepted);
            self.refresh(&touched);
            self.revision.set(accepted.revision);
            self.note_ran(accepted);
        }
    }

    fn accepted_by_library(&self, accepted: &Accepted) {
        let mut state = self.state();
        let known = state.library_revision;
        if accepted.revision == known + 1 {
            state.library.apply(&accepted.change);
            state.library_revision = accepted.revision;
            drop(state);
            self.note_removed(accepted);
            self.refresh_library();
            self.note_ran(accepted);
        } else if accepted.revision > known {
            drop(state);
            ask_since_library(known);
        }
    }

    /// Remembers who removed what, for whoever has it open in a dialog.
    fn note_removed(&self, accepted: &Accepted) {
        let gone = accepted.change.edits.iter().filter(|edit| edit.after.is_none());
        let gone: Vec<Id> = gone.filter(|edit| edit.id.kind != Kind::Place).map(|edit| edit.id.id.clone()).collect();
        if !gone.is_empty() {
            self.removed_by.update(|by| {
                if by.len() > REMOVED_MAX {
                    by.clear();
                }
                by.extend(gone.into_iter().map(|id| (id, accepted.change.author.clone())));
            });
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

    /// Asks for what is newer than what is known.
    fn ask_since(&self, behaviour: Id) {
        let known =
            if behaviour.as_str() == LIBRARY { self.state().library_revision } else { self.revision.get_untracked() };
        link::tell(Request::Since { behaviour, revision: known });
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

/// Who this tab was on an earlier link.
fn kept_credential() -> Option<Credential> {
    watch_this_tab();
    let kept = Keep::Tab.get(TAB_KEY)?;
    let (client, secret) = kept.split_once(' ')?;
    Some(Credential { client: Id::new(client).ok()?, secret: Id::new(secret).ok()? })
}

fn keep_credential(client: &Id, secret: &Id) {
    Keep::Tab.put(TAB_KEY, &format!("{client} {secret}"));
}

/// A doubled tab copies what is kept for a tab, so a tab that is alive already counts as another one: once for each page.
fn watch_this_tab() {
    thread_local! {
        static WATCHED: () = {
            if Keep::Tab.get(ALIVE_KEY).is_some() {
                Keep::Tab.drop(TAB_KEY);
            }
            Keep::Tab.put(ALIVE_KEY, "1");
            if let Some(window) = crate::browser::window() {
                crate::browser::hear(&window, "pagehide", |_| Keep::Tab.drop(ALIVE_KEY));
                crate::browser::hear(&window, "pageshow", |_| Keep::Tab.put(ALIVE_KEY, "1"));
            }
        };
    }
    WATCHED.with(|()| ());
}

/// The name in this browser, at first "Guest" with a number.
fn my_name() -> String {
    Keep::Browser.get(NAME_KEY).unwrap_or_else(|| {
        let name = format!("Guest {}", (crate::browser::random() * 90.0) as u32 + 10);
        Keep::Browser.put(NAME_KEY, &name);
        name
    })
}
