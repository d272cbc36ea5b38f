//! The events of the server, put where they belong.

use super::Desk;
use super::identity::keep_credential;
use leptos::prelude::*;
use protocol::{Event, LIBRARY, answer};

impl Desk {
    /// Hears one event.
    pub(crate) fn hear(&self, event: Event) {
        match event {
            Event::Invitations { invitations } => self.invitations.set(invitations),
            Event::ProgramsChanged => self.library.programs_changed(),
            Event::Accepted { behaviour, accepted } if behaviour.as_str() == LIBRARY => {
                self.library.hear_accepted(&accepted);
            }
            Event::Accepted { behaviour, accepted } => self.document.hear_accepted(&behaviour, &accepted),
            Event::Problems { behaviour, problems, fingerprint, .. } => {
                self.document.hear_fingerprint(&behaviour, fingerprint);
                self.document.hear_problems(&behaviour, problems);
            }
            Event::People { behaviour, people } => self.document.hear_people(&behaviour, people),
            Event::Versions { behaviour, versions } => self.document.hear_versions(&behaviour, versions),
            Event::Locks { behaviour, locks } => self.document.hear_locks(&behaviour, locks),
            Event::LockReturned { grant } => self.document.hear_grant(&grant),
            Event::LockNews { behaviour, now_ms, event } => self.document.hear_lock_event(&behaviour, now_ms, &event),
            Event::Removed { behaviour, by } => {
                self.library.removed(&behaviour);
                self.document.removed(&behaviour, &by);
            }
            Event::Store { away } => self.document.hear_store(away),
            Event::Robots { robots } => self.robots.hear_robots(robots),
            Event::Runs { runs, .. } => self.robots.hear_runs(runs),
            Event::Values { values } => self.robots.hear_values(*values),
            Event::Scene { robot, scene } => self.robots.hear_scene(&robot, *scene),
            Event::Ping { behaviour, library_revision } => {
                self.document.hear_ping(behaviour);
                self.library.hear_ping(library_revision);
            }
            // Only the operator's page shows these: it overhears them.
            Event::Pressed { .. } | Event::LiveMarks { .. } => {}
        }
    }

    /// The server greeted back: all begins with what it says.
    pub(crate) fn welcome(&self, welcome: answer::Welcome) {
        let answer::Welcome { epoch, you, role, secret, library, library_revision, templates, exercises, .. } = welcome;
        self.epoch.set(epoch);
        self.role.set(Some(role));
        keep_credential(&you.client, &secret);
        self.library.exercises.set(exercises);
        self.me.set(Some(you));
        self.robots.begin_anew();
        self.library.welcome(*library, library_revision, templates);
        self.document.reopen();
    }
}
