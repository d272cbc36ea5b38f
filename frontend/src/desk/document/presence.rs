//! Presence: where this person's pointer is and what is selected, told and never saved.

use super::{Document, Selected};
use crate::{browser, link};
use leptos::prelude::*;
use protocol::{Pointer, Request};

/// How often others are told where this person is, in milliseconds.
const PRESENCE_MS: i32 = 50;

impl Document {
    /// Tells the others, at most 20 times a second, where the pointer is and what is selected.
    pub(crate) fn present(&self, pointer: Option<Pointer>) {
        let plan = {
            let mut state = self.state();
            state.pointer = pointer;
            !std::mem::replace(&mut state.presence_planned, true)
        };
        if plan {
            let document = self.clone();
            browser::after(PRESENCE_MS, move || document.tell_presence());
        }
    }

    /// Tells the others that something else is selected now.
    pub(crate) fn present_selection(&self) {
        let pointer = self.state().pointer;
        self.present(pointer);
    }

    fn tell_presence(&self) {
        let pointer = {
            let mut state = self.state();
            state.presence_planned = false;
            state.pointer
        };
        if self.open.with_untracked(Option::is_some) {
            let selected = self.selected.with_untracked(|selected| selected.as_ref().map(Selected::id).cloned());
            link::tell(Request::Present { pointer, selected });
        }
    }
}
