//! All that the link brings, put where it belongs.

use super::identity::{greeting, keep_credential};
use super::{Desk, LinkState};
use crate::link::{LinkEnd, LinkHandler};
use leptos::prelude::*;
use protocol::{Event, LIBRARY, Refused, answer, request};

impl LinkHandler for Desk {
    fn greeting(&self) -> request::Hello {
        greeting()
    }

    /// Begins with what the server says when it greets back.
    fn greeted(&self, welcome: answer::Welcome) {
        self.online.set(LinkState::Online);
        self.document.link_up();
        self.document.listen(0.0);
        self.welcome(welcome);
    }

    fn hear(&self, event: Event) {
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

    fn refused(&self, no: &Refused) {
        self.say_no(no);
    }

    fn listen(&self, silent_ms: f64) {
        self.document.listen(silent_ms);
    }

    /// Shows what waits until the link is back.
    fn lost(&self) {
        self.online.set(LinkState::Offline);
        self.document.link_lost();
    }

    fn end(&self, end: LinkEnd) {
        self.ended.set(Some(end));
    }
}

impl Desk {
    /// Takes in what the server says when it greets back.
    fn welcome(&self, welcome: answer::Welcome) {
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
