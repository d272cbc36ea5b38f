//! Who is in a room: coming, going, pointing, and catching up.

use super::RoomTask;
use crate::hub::{bounded, store_no};
use crate::outbox::{Answer, Out, encode};
use crate::rooms::Member;
use crate::templates::Template;
use behaviour::{Accepted, Id};
use protocol::{Person, Pointer, Reply, SaidNo};
use std::sync::Arc;

/// Changes in one answer to who missed some; who missed more opens again.
const MISSED_MAX_CHANGES: u64 = 256;

impl RoomTask {
    /// The answer goes into the member's queue here, so that no change can come before it.
    pub(super) fn join(&mut self, member: Member, ask: u32) {
        if self.gone {
            return member.outbox.no(ask, SaidNo::NoBehaviour);
        }
        if self.is_library() {
            member.outbox.say(Some(ask), self.welcome(&member.person));
        }
        let (session, outbox) = (member.outbox.session, member.outbox.clone());
        self.members.insert(session, member);
        if !self.is_library() {
            outbox.say(Some(ask), self.opened());
            self.tell_people();
            outbox.put(Out::Follow(Box::new(self.feed())));
        }
    }

    fn welcome(&self, you: &Person) -> Reply {
        let templates = crate::templates::templates().iter().map(Template::summary);
        Reply::Welcome {
            version: protocol::VERSION,
            epoch: self.hub.epoch,
            you: you.clone(),
            library: Box::new(self.room.behaviour().clone()),
            library_revision: self.room.revision(),
            templates: templates.collect(),
        }
    }

    fn opened(&self) -> Reply {
        Reply::Opened {
            behaviour: self.id.clone(),
            revision: self.room.revision(),
            records: Box::new(self.room.behaviour().clone()),
            problems: self.found.problems.clone(),
            fingerprint: self.found.fingerprint,
            people: self.people(),
        }
    }

    pub(super) fn leave(&mut self, session: u64) {
        if self.members.remove(&session).is_some() && !self.is_library() {
            self.tell_people();
        }
    }

    pub(super) fn present(&mut self, session: u64, pointer: Option<Pointer>, selected: Option<Id>) {
        let pointer = pointer.filter(|at| at.x.is_finite() && at.y.is_finite());
        if let Some(member) = self.members.get_mut(&session) {
            member.person.pointer = pointer;
            member.person.selected = selected;
            self.tell_people();
        }
    }

    fn people(&self) -> Vec<Person> {
        self.members.values().map(|member| member.person.clone()).collect()
    }

    fn tell_people(&self) {
        let reply = Reply::People { behaviour: self.id.clone(), people: self.people() };
        self.people_text.send_replace(encode(None, reply));
    }

    /// Changes that somebody missed: from memory, else from the store.
    pub(super) fn since(&self, revision: u64, answer: Answer) {
        let here = self.room.revision();
        let wanted = here.saturating_sub(revision);
        if wanted > MISSED_MAX_CHANGES && !self.is_library() {
            return answer.give(self.opened());
        }
        let newest: Vec<Accepted> = self.log.iter().filter(|change| change.revision > revision).cloned().collect();
        if newest.len() as u64 == wanted {
            return answer.give(Reply::Missed { behaviour: self.id.clone(), changes: newest });
        }
        let (hub, id) = (Arc::clone(&self.hub), self.id.clone());
        self.hub.tasks.spawn(async move {
            let most = u32::try_from(wanted).unwrap_or(u32::MAX);
            match bounded(hub.store.history(&id, revision, most)).await {
                Ok(changes) => answer.give(Reply::Missed { behaviour: id, changes }),
                Err(error) => answer.no(store_no(&error)),
            }
        });
    }

    /// Everyone is told that it is gone, and leaves.
    pub(super) fn tell_removed(&mut self, by: &str) {
        let text = encode(None, Reply::Removed { behaviour: self.id.clone(), by: by.to_owned() });
        for member in std::mem::take(&mut self.members).into_values() {
            member.outbox.put(Out::Unfollow);
            member.outbox.put(Out::Text(text.clone()));
        }
    }
}
