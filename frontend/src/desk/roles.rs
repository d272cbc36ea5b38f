//! The rights of this person. The server decides; the page says it before somebody tries.

use super::tab::Tab;
use crate::words;
use leptos::prelude::*;
use protocol::{Refused, Role};

impl Tab {
    /// True if this person may do what needs that role. Reactive.
    pub(crate) fn may(&self, least: Role) -> bool {
        self.may_not(least).is_none()
    }

    /// Says why this person may not do what needs that role, if so. Reactive.
    pub(crate) fn may_not(&self, least: Role) -> Option<&'static str> {
        let no = self.role.get().filter(|role| *role < least).map(words::may_not);
        no.or_else(|| (least == Role::Editor && self.is_then()).then(words::only_look_back))
    }

    /// True while the graph shows a moment of the past. Reactive.
    pub(crate) fn is_then(&self) -> bool {
        self.then.with(Option::is_some)
    }

    /// Returns the refusal, for who tries all the same.
    pub(in crate::desk) fn refusal(&self, least: Role) -> Option<Refused> {
        untrack(|| self.may_not(least)).map(|_| Refused::Role(least))
    }

    /// Says why this person may not do what needs that role; true if so.
    pub(crate) fn refuses(&self, least: Role) -> bool {
        let why = untrack(|| self.may_not(least));
        if let Some(why) = why {
            self.say(why, true);
        }
        why.is_some()
    }
}
