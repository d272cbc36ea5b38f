//! Others who look back, and looking back with one of them.

use super::Document;
use crate::desk::tab::OpenPast;
use behaviour::Id;
use leptos::prelude::*;
use protocol::LookedMoment;

impl Document {
    /// The moment of a past at which somebody looks; none while they look at now. Reactive.
    pub(crate) fn looked_at(&self, client: &Id) -> Option<LookedMoment> {
        self.people.with(|people| people.iter().find(|person| person.client == *client)?.looks_at.clone())
    }

    /// Looks at the past at which somebody else looks, along with them.
    pub(crate) fn look_with(&self, client: &Id) {
        self.tab.looks_with.set(Some(client.clone()));
        if self.tab.past.with_untracked(Option::is_none) {
            self.tab.past.set(Some(OpenPast::Theirs));
        }
    }
}
