//! Who is in a room: coming, going, pointing, and catching up.

use super::change_log::page;
use super::{RoomTask, Stay};
use crate::rooms::member::{AnswerTo, Member};
use crate::rooms::shown::ShownBehaviour;
use crate::rooms::{Entering, JoinRequest, LeaveReason, Whereabouts};
use crate::support::identity::ShareGroup;
use crate::support::message::encode;
use crate::support::store_call::{bounded, store_no};
use behaviour::{Accepted, Id};
use protocol::{CANVAS_MAX, CanvasArea, Event, LookedMoment, Person, Refused, answer};
use std::sync::Arc;

/// Who missed more changes than this opens again.
const MISSED_MAX_CHANGES: u64 = 256;
/// Changes that are fetched from the store at once for who missed some.
const FETCHED_MAX_CHANGES: u64 = 32;

impl RoomTask {
    /// The answer goes into the member's queue here, so that no change can come before it.
    pub(super) fn join(&mut self, member: Member, joining: JoinRequest) {
        if self.stay == Stay::Gone {
            return joining.refuse(Refused::NoBehaviour);
        }
        let (session, link) = (member.link.session(), Arc::clone(&member.link));
        let (you, to) = (member.person.clone(), link.person().group());
        self.members.insert(session, member);
        match joining {
            JoinRequest::Server(entering, answer) => {
                let shown = self.shown(&to);
                answer.show(self.welcome(you, entering), shown);
            }
            JoinRequest::Behaviour(answer) => {
                let shown = self.shown(&to);
                answer.show(self.opened(), shown);
                self.tell_people();
                link.follow(Box::new(self.feed()));
                self.locks.came(&you.client, session, link.as_ref());
            }
        }
    }

    fn welcome(&self, you: Person, Entering { secret, role, stops }: Entering) -> answer::Welcome {
        answer::Welcome {
            version: protocol::VERSION,
            epoch: self.around.epoch,
            you,
            role,
            secret,
            library: Box::default(),
            more: false,
            library_revision: self.room.revision(),
            templates: self.around.templates.clone(),
            exercises: self.around.exercises.clone(),
            stops,
        }
    }

    /// The room as it is now, for who opens it.
    fn shown(&mut self, to: &ShareGroup) -> Arc<ShownBehaviour> {
        let shown = self.around.shown.show(&self.room, &self.shown, to);
        self.shown = Arc::downgrade(&shown);
        shown
    }

    fn opened(&self) -> answer::Opened {
        answer::Opened {
            behaviour: self.id.clone(),
            revision: self.room.revision(),
            records: Box::default(),
            more: false,
            problems: self.found.problems.clone(),
            fingerprint: self.found.fingerprint,
            people: self.people(),
        }
    }

    pub(super) fn leave(&mut self, session: u64, parting: LeaveReason) {
        let Some(gone) = self.members.remove(&session).filter(|_| !self.is_library()) else { return };
        self.tell_people();
        self.locks.left(session, parting);
        // Their new link may have come before the old one went.
        for member in self.members.values().filter(|member| member.person.client == gone.person.client) {
            self.locks.came(&gone.person.client, member.link.session(), member.link.as_ref());
        }
        self.tell_locks();
    }

    /// What lies beyond the canvas is left out.
    pub(super) fn present(&mut self, session: u64, Whereabouts { pointer, selected, view }: Whereabouts) {
        if let Some(member) = self.members.get_mut(&session) {
            member.person.pointer = pointer.filter(|at| is_on_canvas([at.x, at.y]));
            member.person.selected = selected;
            member.person.view = view.filter(is_seen);
            self.tell_people();
        }
    }

    /// Others see that somebody looks at a past, and at which moment.
    pub(super) fn present_moment(&mut self, session: u64, at: Option<LookedMoment>) {
        let Some(member) = self.members.get_mut(&session).filter(|member| member.person.looks_at != at) else { return };
        member.person.looks_at = at;
        self.tell_people();
    }

    /// Everyone sees the new name at once, also beside what this person is editing.
    pub(super) fn rename(&mut self, session: u64, name: String) {
        let Some(member) = self.members.get_mut(&session) else { return };
        member.person.name.clone_from(&name);
        let client = member.person.client.clone();
        if !self.is_library() {
            self.locks.rename(&client, &name);
            self.tell_people();
            self.tell_locks();
        }
    }

    fn people(&self) -> Vec<Person> {
        self.members.values().map(|member| member.person.clone()).collect()
    }

    fn tell_people(&self) {
        let event = Event::People { behaviour: self.id.clone(), people: self.people() };
        self.people_text.send_replace(encode(event));
    }

    /// The first of the changes that somebody missed: from memory, else from the store.
    pub(super) fn since(&mut self, revision: u64, answer: AnswerTo<answer::Newer>) {
        let here = self.room.revision();
        let wanted = here.saturating_sub(revision);
        if wanted > MISSED_MAX_CHANGES && !self.is_library() {
            let shown = self.shown(&answer.group());
            return answer.show(answer::Newer::Opened(self.opened()), shown);
        }
        let (store, id) = (Arc::clone(&self.around.store), self.id.clone());
        let at_hand = if wanted == 0 { Some(Vec::new()) } else { self.log.since(revision) };
        if let Some(changes) = at_hand {
            return answer.give(missed(id, changes, here));
        }
        let around = Arc::clone(&self.around);
        self.around.tasks.spawn(async move {
            let Some(_turn) = around.lookups.turn(&answer.sender()).await else { return answer.no(Refused::TooFast) };
            // Who was cut off and came again asks again: nothing is looked up for who they were.
            if answer.is_unwanted() {
                return;
            }
            let most = u32::try_from(wanted.min(FETCHED_MAX_CHANGES)).unwrap_or(u32::MAX);
            match bounded(store.history(&id, revision, most)).await {
                Ok(changes) => answer.give(missed(id, page(changes), here)),
                Err(error) => answer.no(store_no(&error)),
            }
        });
    }

    /// Everyone is told that it is gone, and leaves.
    pub(super) fn tell_removed(&mut self, by: &str) {
        let text = encode(Event::Removed { behaviour: self.id.clone(), by: by.to_owned() });
        for member in std::mem::take(&mut self.members).into_values() {
            member.link.unfollow(self.id.clone());
            member.link.send(text.clone());
        }
    }
}

fn is_on_canvas(at: [f64; 2]) -> bool {
    at.into_iter().all(|side| side.abs() <= CANVAS_MAX)
}

fn is_seen(view: &CanvasArea) -> bool {
    let sides = [view.width, view.height];
    is_on_canvas([view.x, view.y]) && is_on_canvas(sides) && sides.into_iter().all(|side| side > 0.0)
}

/// The answer to who missed some changes, when the newest revision is `here`.
fn missed(behaviour: Id, changes: Vec<Accepted>, here: u64) -> answer::Newer {
    let more = changes.last().is_some_and(|last| last.revision < here);
    answer::Newer::Missed(answer::Missed { behaviour, changes, more })
}
