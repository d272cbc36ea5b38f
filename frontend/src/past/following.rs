//! Following somebody who looks back: the same past at the same moment, along with their cursor, until one moves the cursor
//! oneself, goes back to now, or the other one does or leaves.

use super::{CALM_STEP_MS, PastShared, close};
use crate::browser;
use crate::past::words;
use behaviour::Id;
use lanes::LaneAct;
use leptos::prelude::*;
use protocol::{LookedMoment, PastOf};

/// The state of following.
#[derive(Clone, Copy)]
pub(super) struct FollowState {
    /// The name of who is followed, for when they are gone.
    name: StoredValue<String>,
    /// The time when the cursor went along last.
    went_ms: StoredValue<f64>,
    is_planned: StoredValue<bool>,
    /// The last sentence about it, for screen readers.
    pub(super) said: RwSignal<String>,
}

impl FollowState {
    /// Nobody is followed yet.
    pub(super) fn new() -> Self {
        Self {
            name: StoredValue::default(),
            went_ms: StoredValue::new(0.0),
            is_planned: StoredValue::new(false),
            said: RwSignal::default(),
        }
    }
}

/// The whereabouts of who is followed.
#[derive(Clone, Debug, PartialEq)]
enum Followed {
    /// They look at this moment.
    Then(LookedMoment),
    /// They look at now again.
    Now,
    /// They are not here any more.
    Gone,
}

impl PastShared {
    /// Follows whom this person wants to follow, for as long as the panel is there.
    pub(super) fn go_along(self) {
        let desk = self.desk.desk();
        let whom = Memo::new(move |_| self.desk.desk().looks_with.get());
        Effect::new(move |_| {
            if let Some(client) = whom.get() {
                untrack(|| self.begin_following(&client));
            }
        });
        let followed = Memo::new(move |_| self.followed(&whom.get()?));
        Effect::new(move |_| match followed.get() {
            Some(Followed::Then(moment)) => untrack(|| self.open_theirs(moment.past)),
            Some(Followed::Now) => untrack(|| self.end_following(words::looks_at_now_again)),
            Some(Followed::Gone) => untrack(|| self.end_following(words::looks_no_more)),
            None => {}
        });
        let place = Memo::new(move |_| self.place_of(&followed.get()?));
        // Lanes that come later than the press, or once more, begin at now.
        let is_astray = Memo::new(move |_| {
            let viewer = self.viewer.read();
            place.get().is_some_and(|at| viewer.follows() || (viewer.cursor() - at).abs() > 0.5)
        });
        Effect::new(move |_| {
            is_astray.track();
            if place.get().is_some() {
                untrack(|| self.plan_going(place));
            }
        });
        on_cleanup(move || desk.looks_with.set(None));
    }

    fn begin_following(self, client: &Id) {
        let signs = self.desk.desk().document.signs();
        let Some(sign) = signs.into_iter().find(|sign| sign.client == *client) else { return };
        self.following.said.set(words::looks_with(&sign.name));
        self.following.name.set_value(sign.name);
        // What could not be opened is tried once more.
        if self.opened.with_untracked(Option::is_none) {
            self.of.set_value(None);
        }
    }

    /// The whereabouts of somebody; none where nobody can know, as while the link is down. Reactive.
    fn followed(self, client: &Id) -> Option<Followed> {
        let desk = self.desk.desk();
        let me = desk.me.get()?.client;
        desk.document.people.with(|people| {
            let is_known = people.iter().any(|person| person.client == me);
            match people.iter().find(|person| person.client == *client).map(|person| person.looks_at.clone()) {
                _ if !is_known => None,
                None => Some(Followed::Gone),
                Some(None) => Some(Followed::Now),
                Some(Some(moment)) => Some(Followed::Then(moment)),
            }
        })
    }

    fn open_theirs(self, past: PastOf) {
        if self.of.with_value(|of| of.as_ref() != Some(&past)) {
            self.open(Some(past));
        }
    }

    /// The place of the cursor that goes along, as far as the past is known; none if they look at another past, or if they
    /// look with this person themselves. Reactive.
    fn place_of(self, followed: &Followed) -> Option<f64> {
        let Followed::Then(moment) = followed else { return None };
        let opened = self.opened.read();
        let from_ms = opened.as_ref()?.from_ms;
        let is_same = self.of.with_value(|of| of.as_ref() == Some(&moment.past));
        if !is_same || self.is_followed_by(moment.with.as_ref()) {
            return None;
        }
        let length = self.viewer.read().axis().length();
        Some((moment.at_ms.saturating_sub(from_ms) as f64).min(length))
    }

    /// True if this person is the one whom somebody follows, or whom that one follows. Reactive.
    fn is_followed_by(self, with: Option<&Id>) -> bool {
        let desk = self.desk.desk();
        let Some(me) = desk.me.get() else { return false };
        desk.document.people.with(|people| {
            let mut with = with;
            // In a ring that this person is not in nobody comes to an end.
            for _ in 0..=people.len() {
                match with {
                    Some(client) if *client == me.client => return true,
                    Some(client) => {
                        let person = people.iter().find(|person| person.client == *client);
                        with = person.and_then(|person| person.looks_at.as_ref()?.with.as_ref());
                    }
                    None => return false,
                }
            }
            false
        })
    }

    /// The cursor goes along at once; for who wants little motion once a second.
    fn plan_going(self, place: Memo<Option<f64>>) {
        let FollowState { went_ms, is_planned, .. } = self.following;
        if is_planned.get_value() {
            return;
        }
        let wait_ms = if browser::is_calm() { went_ms.get_value() + CALM_STEP_MS - browser::now_ms() } else { 0.0 };
        if wait_ms <= 0.0 {
            return self.go(place);
        }
        is_planned.set_value(true);
        browser::after(wait_ms.ceil() as i32, move || {
            if !self.is_gone() {
                is_planned.set_value(false);
                self.go(place);
            }
        });
    }

    fn go(self, place: Memo<Option<f64>>) {
        let Some(at) = place.get_untracked() else { return };
        self.following.went_ms.set_value(browser::now_ms());
        // Not as a hand does it, which would end following.
        self.viewer.update(|viewer| {
            if viewer.plays() {
                viewer.act(LaneAct::Play);
            }
            if viewer.cursor() != at || viewer.follows() {
                viewer.act(LaneAct::Seek(at));
            }
        });
    }

    /// The other one ended it, which is said.
    fn end_following(self, says: fn(&str) -> String) {
        let desk = self.desk.desk();
        let said = self.following.name.with_value(|name| says(name));
        desk.looks_with.set(None);
        desk.say(&said, false);
        self.following.said.set(String::new());
        if self.opened.with_untracked(Option::is_none) {
            close(self);
        }
    }

    /// This person looks by themselves.
    pub(super) fn look_alone(self) {
        let looks_with = self.desk.desk().looks_with.clone();
        if looks_with.with_untracked(Option::is_some) {
            looks_with.set(None);
            self.following.said.set(words::looks_alone().to_owned());
        }
    }
}
