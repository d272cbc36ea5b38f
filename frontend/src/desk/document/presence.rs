//! Presence: where this person is, told to the others and never saved; and following where somebody else is.

use super::{Document, Selected};
use crate::{browser, link, words};
use behaviour::Id;
use editor::{Sign, signs};
use leptos::prelude::*;
use protocol::{CanvasArea, Person, Pointer, request};

/// The least time between two messages that tell others where this person is, in milliseconds.
const PRESENCE_MS: f64 = 50.0;

/// The place of this person, and what the others know of it.
#[derive(Default)]
pub(super) struct Presence {
    pointer: Option<Pointer>,
    view: Option<CanvasArea>,
    /// The time when the others were told last, and what.
    told_ms: f64,
    told: Option<(Option<Pointer>, Option<Id>, Option<CanvasArea>)>,
    is_planned: bool,
}

impl Presence {
    /// Returns the part of the canvas that is in view.
    pub(super) fn in_view(&self) -> Option<CanvasArea> {
        self.view
    }
}

/// The place of somebody who is followed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FollowedPlace {
    pub(crate) view: Option<CanvasArea>,
    pub(crate) selected: Option<Id>,
}

impl Document {
    /// Tells the others, at most 20 times a second, where the pointer is.
    pub(crate) fn present(&self, pointer: Option<Pointer>) {
        self.state().presence.pointer = pointer;
        self.plan_presence();
    }

    /// Tells them what part of the canvas is in view, none where there is no canvas.
    pub(crate) fn present_view(&self, view: Option<CanvasArea>) {
        self.state().presence.view = view;
        self.plan_presence();
    }

    /// Tells them that something else is selected now.
    pub(crate) fn present_selection(&self) {
        self.plan_presence();
    }

    /// After something was opened nobody knows anything yet.
    pub(super) fn present_anew(&self) {
        self.state().presence.told = None;
        self.plan_presence();
    }

    /// At once if the others were told long enough ago, else as soon as that is so.
    fn plan_presence(&self) {
        let wait_ms = {
            let presence = &mut self.state().presence;
            if presence.is_planned {
                return;
            }
            let wait_ms = presence.told_ms + PRESENCE_MS - browser::now_ms();
            presence.is_planned = wait_ms > 0.0;
            wait_ms
        };
        if wait_ms > 0.0 {
            let document = self.clone();
            browser::after(wait_ms.ceil() as i32, move || document.tell_presence());
        } else {
            self.tell_presence();
        }
    }

    /// Tells others where this person is. One who follows somebody tells what that one sees: so two who follow each
    /// other stay where they are.
    fn tell_presence(&self) {
        let followed = untrack(|| self.followed());
        let selected = self.selected.with_untracked(|selected| selected.as_ref().map(Selected::id).cloned());
        let is_open = self.open.with_untracked(Option::is_some) && link::is_up();
        let news = {
            let presence = &mut self.state().presence;
            presence.is_planned = false;
            let view = followed.map_or(presence.view, |followed| followed.view);
            let now = (presence.pointer, selected, view);
            let is_new = is_open && presence.told.as_ref() != Some(&now);
            if is_new {
                presence.told = Some(now.clone());
                presence.told_ms = browser::now_ms();
            }
            is_new.then_some(now)
        };
        if let Some((pointer, selected, view)) = news {
            link::tell(request::Present { pointer, selected, view });
        }
    }

    /// Everyone here, each told apart from the others. Reactive.
    pub(crate) fn signs(&self) -> Vec<Sign> {
        self.people.with(|people| signs(people))
    }

    /// The others here, each told apart. Reactive.
    pub(crate) fn others(&self) -> Vec<(Sign, Person)> {
        let me = self.tab.me.with(|me| me.as_ref().map(|me| me.client.clone()));
        let both = self.people.with(|people| signs(people).into_iter().zip(people.clone()).collect::<Vec<_>>());
        both.into_iter().filter(|(sign, _)| Some(&sign.client) != me.as_ref()).collect()
    }

    /// Looks at what somebody else looks at, until one looks around by oneself.
    pub(crate) fn follow(&self, client: &Id) {
        if self.following.with_untracked(|now| now.as_ref() != Some(client)) {
            self.following.set(Some(client.clone()));
        }
    }

    /// Looks around by oneself again; whether somebody was followed.
    pub(crate) fn unfollow(&self) -> bool {
        let followed = self.following.with_untracked(Option::is_some);
        if followed {
            self.following.set(None);
        }
        followed
    }

    /// Returns the place of the followed person. Reactive.
    pub(crate) fn followed(&self) -> Option<FollowedPlace> {
        let client = self.following.get()?;
        self.people.with(|people| {
            let person = people.iter().find(|person| person.client == client)?;
            Some(FollowedPlace { view: person.view, selected: person.selected.clone() })
        })
    }

    /// Stops following a person who is not among these any more, and says so.
    pub(super) fn follow_on(&self, people: &[Person]) {
        let following = self.following.get_untracked();
        let is_gone = |client: &Id| people.iter().all(|person| person.client != *client);
        let Some(gone) = following.filter(is_gone) else { return };
        let name = untrack(|| self.signs()).into_iter().find(|sign| sign.client == gone).map(|sign| sign.name);
        self.unfollow();
        if let Some(name) = name {
            self.tab.say(&words::no_longer_here(&name), false);
        }
    }
}
