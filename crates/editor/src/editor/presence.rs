//! Presence: where this person is, told to the others and never saved; who is there; and following where somebody else is.

use crate::effect::{AlarmPurpose, Announcement, Effect};
use crate::signs::signs;
use crate::{Editor, LinkState, Selected};
use behaviour::Id;
use protocol::{CanvasArea, Person, Pointer, request};

/// The least time between two messages that tell others where this person is, in milliseconds.
const PRESENCE_MS: f64 = 50.0;

/// The place of this person, and what the others know of it.
#[derive(Debug, Default)]
pub(crate) struct Presence {
    pointer: Option<Pointer>,
    view: Option<CanvasArea>,
    /// The time when the others were told last, and what.
    told_ms: f64,
    told: Option<request::Present>,
    is_planned: bool,
}

impl Editor {
    /// Tells the others, at most 20 times a second, where the pointer is.
    pub fn present(&mut self, pointer: Option<Pointer>) {
        self.presence.pointer = pointer;
        self.plan_presence();
    }

    /// Tells them what part of the canvas is in view, none where there is no canvas.
    pub fn present_view(&mut self, view: Option<CanvasArea>) {
        self.presence.view = view;
        self.plan_presence();
    }

    /// Returns the part of the canvas that is in view.
    #[must_use]
    pub fn in_view(&self) -> Option<CanvasArea> {
        self.presence.view
    }

    /// Shows who is in the program that was opened just now, where nobody knows anything yet.
    pub(crate) fn present_anew(&mut self, people: Vec<Person>) {
        self.people.set(people);
        self.presence.told = None;
        self.plan_presence();
    }

    /// At once if the others were told long enough ago, else as soon as that is so.
    pub(crate) fn plan_presence(&mut self) {
        if self.presence.is_planned {
            return;
        }
        let wait_ms = self.presence.told_ms + PRESENCE_MS - self.now.clock_ms;
        if wait_ms > 0.0 {
            self.presence.is_planned = true;
            self.effect(Effect::After(wait_ms.ceil() as i32, AlarmPurpose::Presence));
        } else {
            self.tell_presence();
        }
    }

    /// Tells others where this person is. One who follows somebody tells what that one sees: so two who follow each other stay
    /// where they are.
    pub(crate) fn tell_presence(&mut self) {
        self.presence.is_planned = false;
        let view = match &*self.following {
            Some(client) => self.person(client).and_then(|person| person.view),
            None => self.presence.view,
        };
        let selected = self.selected.as_ref().map(Selected::id).cloned();
        let now = request::Present { pointer: self.presence.pointer, selected, view };
        let is_heard = self.open.is_some() && self.link == LinkState::Online;
        if is_heard && self.presence.told.as_ref() != Some(&now) {
            self.presence.told = Some(now.clone());
            self.presence.told_ms = self.now.clock_ms;
            self.send_news(now);
        }
    }

    /// The server says who is in a program: who followed somebody that is not there any more hears so.
    pub fn hear_people(&mut self, of: &Id, people: Vec<Person>) {
        if !self.is_open(of) {
            return;
        }
        let gone = (*self.following).clone().filter(|client| people.iter().all(|person| person.client != *client));
        if let Some(gone) = gone {
            let name = signs(&self.people).into_iter().find(|sign| sign.client == gone).map(|sign| sign.name);
            self.unfollow();
            name.into_iter().for_each(|name| self.say(Announcement::NoLongerHere(name)));
        }
        self.people.set(people);
    }

    /// Looks at what somebody else looks at, until one looks around by oneself.
    pub fn follow(&mut self, client: &Id) {
        self.following.set(Some(client.clone()));
    }

    /// Looks around by oneself again. Returns true if somebody was followed.
    pub fn unfollow(&mut self) -> bool {
        let followed = self.following.is_some();
        self.following.set(None);
        followed
    }

    fn person(&self, client: &Id) -> Option<&Person> {
        self.people.iter().find(|person| person.client == *client)
    }
}
