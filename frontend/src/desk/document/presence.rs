//! Presence: where this person is, told to the others and never saved; and following where somebody else is.

use super::Document;
use behaviour::Id;
use editor::{Editor, Sign, signs};
use leptos::prelude::*;
use protocol::{CanvasArea, Person, Pointer};

/// The place of somebody who is followed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FollowedPlace {
    pub(crate) view: Option<CanvasArea>,
    pub(crate) selected: Option<Id>,
}

impl Document {
    /// Tells the others, at most 20 times a second, where the pointer is.
    pub(crate) fn present(&self, pointer: Option<Pointer>) {
        self.input(|editor| editor.present(pointer));
    }

    /// Tells them what part of the canvas is in view, none where there is no canvas.
    pub(crate) fn present_view(&self, view: Option<CanvasArea>) {
        self.input(|editor| editor.present_view(view));
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
        self.input(|editor| editor.follow(client));
    }

    /// Looks around by oneself again; whether somebody was followed.
    pub(crate) fn unfollow(&self) -> bool {
        self.following.with_untracked(Option::is_some) && self.input(Editor::unfollow)
    }

    /// Returns the place of the followed person. Reactive.
    pub(crate) fn followed(&self) -> Option<FollowedPlace> {
        let client = self.following.get()?;
        self.people.with(|people| {
            let person = people.iter().find(|person| person.client == client)?;
            Some(FollowedPlace { view: person.view, selected: person.selected.clone() })
        })
    }
}
