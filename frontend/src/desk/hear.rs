//! The messages of the server, put where they belong.

use super::Desk;
use super::identity::keep_credential;
use behaviour::{Accepted, Behaviour, Id};
use leptos::prelude::*;
use protocol::{LIBRARY, Person, Reply, Summary};

impl Desk {
    /// Hears one reply.
    pub(crate) fn hear(&self, reply: Reply) {
        match reply {
            Reply::Welcome { you, role, secret, library, library_revision, templates, exercises, .. } => {
                self.role.set(Some(role));
                keep_credential(&you.client, &secret);
                self.library.exercises.set(exercises);
                self.welcome(you, *library, library_revision, templates);
            }
            Reply::Invitations { invitations } => self.invitations.set(invitations),
            Reply::ProgramsChanged => self.library.programs_changed(),
            Reply::Opened { behaviour, revision, records, problems, fingerprint, people, .. } => {
                if self.document.opened(&behaviour, (revision, *records), problems, people) {
                    self.robots.follow_opened();
                    self.document.pump();
                }
                self.document.hear_fingerprint(&behaviour, fingerprint);
            }
            Reply::Accepted { behaviour, accepted } => self.accepted(&behaviour, &accepted),
            Reply::Missed { behaviour, changes, more } => {
                changes.iter().for_each(|accepted| self.accepted(&behaviour, accepted));
                if more {
                    self.ask_since(behaviour);
                }
            }
            Reply::Problems { behaviour, problems, fingerprint, .. } => {
                self.document.hear_fingerprint(&behaviour, fingerprint);
                self.document.hear_problems(&behaviour, problems);
            }
            Reply::People { behaviour, people } => self.document.hear_people(&behaviour, people),
            Reply::Versions { behaviour, versions } => self.document.hear_versions(&behaviour, versions),
            Reply::Locks { behaviour, locks } => self.document.hear_locks(&behaviour, locks),
            Reply::Locked { grant } => self.document.hear_grant(&grant),
            Reply::LockNews { behaviour, now_ms, event } => self.document.hear_lock_event(&behaviour, now_ms, &event),
            Reply::Removed { behaviour, by } => {
                self.library.removed(&behaviour);
                self.document.removed(&behaviour, &by);
            }
            Reply::Store { away } => self.document.hear_store(away),
            Reply::Robots { robots } => self.robots.hear_robots(robots),
            Reply::Runs { runs } => self.robots.hear_runs(runs),
            Reply::Values { values } => self.robots.hear_values(*values),
            Reply::Scene { robot, scene } => self.robots.hear_scene(&robot, *scene),
            Reply::Ping { behaviour, library_revision } => {
                self.document.hear_ping(behaviour);
                self.library.hear_ping(library_revision);
            }
            Reply::Programs { .. }
            | Reply::HelperRenamed { .. }
            | Reply::Pictures { .. }
            | Reply::WhereUsed { .. }
            | Reply::Drivers { .. }
            | Reply::Contested { .. }
            | Reply::Similar { .. }
            | Reply::Tags { .. }
            | Reply::Recordings { .. }
            | Reply::Created { .. }
            | Reply::Checked { .. }
            | Reply::Fixes { .. }
            | Reply::Types { .. }
            | Reply::Tried { .. }
            | Reply::Asked { .. }
            | Reply::Records { .. }
            | Reply::History { .. }
            | Reply::At { .. }
            | Reply::Invited { .. }
            | Reply::RobotChecked { .. }
            | Reply::FoundRobots { .. }
            | Reply::Faces { .. }
            | Reply::Pressed { .. }
            | Reply::Done
            | Reply::Marks { .. }
            | Reply::Marked { .. }
            | Reply::LiveMarks { .. }
            | Reply::No { .. } => {}
        }
    }

    fn welcome(&self, you: Person, records: Behaviour, revision: u64, templates: Vec<Summary>) {
        self.me.set(Some(you));
        self.robots.begin_anew();
        self.library.welcome(records, revision, templates);
        self.document.reopen();
    }

    fn accepted(&self, to: &Id, accepted: &Accepted) {
        let is_next =
            if to.as_str() == LIBRARY { self.library.accepted(accepted) } else { self.document.accepted(to, accepted) };
        if is_next {
            self.robots.note_before(accepted);
        }
        self.document.answered(&accepted.change.op, Ok(()));
    }

    /// Asks for what is newer than what is known.
    fn ask_since(&self, behaviour: Id) {
        if behaviour.as_str() == LIBRARY {
            self.library.ask_newer();
        } else {
            self.document.ask_newer(behaviour);
        }
    }
}
