//! The things that are chosen, one or several, and what is done with all of them.

use super::{Document, LineUp, ProgramPart, Put, Selected};
use crate::desk::tab::new_id;
use behaviour::{Helper, Id};
use editor::Editor;
use editor::graph::StepDirection;
use editor::keys::EscapeUse;
use leptos::prelude::*;
use std::collections::BTreeSet;

impl Document {
    /// Selects one thing alone, or nothing.
    pub(crate) fn select(&self, what: Option<Selected>) {
        self.input(|editor| editor.select(what));
    }

    /// Chooses one thing more, or one less; what is chosen alone is the first of several.
    pub(crate) fn choose_too(&self, what: Selected) {
        self.input(|editor| editor.choose_too(what));
    }

    /// Chooses these; one alone is what is selected.
    pub(crate) fn choose(&self, these: BTreeSet<Selected>) {
        self.input(|editor| editor.choose(these));
    }

    /// Chooses everything that is seen.
    pub(crate) fn choose_all(&self) {
        self.input(Editor::choose_all);
    }

    /// Chooses what an arrow key leads to, beside the rest with `more`; where the keyboard goes.
    pub(crate) fn step(&self, here: Option<Selected>, way: StepDirection, more: bool) -> Option<Selected> {
        self.input(|editor| editor.step(here, way, more))
    }

    /// Tells which part of the graph has the keyboard.
    pub(crate) fn keyboard_at(&self, part: Option<Selected>) {
        self.input(|editor| editor.keyboard_at(part));
    }

    /// The part to which the keyboard goes on when this one is removed.
    pub(crate) fn before_it(&self, what: &Selected) -> Option<Selected> {
        self.state().editor.before_it(what)
    }

    /// A stream as it is seen: itself, or the folded group that it is in.
    pub(crate) fn seen_as(&self, stream: Id) -> Selected {
        self.state().editor.seen_as(Selected::Stream(stream))
    }

    /// Escape on the graph takes back one thing.
    pub(crate) fn escape(&self) -> EscapeUse {
        self.input(Editor::escape)
    }

    /// True if something is chosen, alone or with others. Reactive.
    pub(crate) fn is_chosen(&self, what: &Selected) -> bool {
        self.selected.with(|selected| selected.as_ref() == Some(what))
            || self.several.with(|several| several.contains(what))
    }

    /// Returns what is chosen, one or several.
    pub(crate) fn chosen(&self) -> BTreeSet<Selected> {
        self.state().editor.chosen()
    }

    /// A part of the open program, with the helpers of the library that it uses.
    pub(crate) fn part(&self, of: &BTreeSet<Selected>, helpers: &[Helper]) -> ProgramPart {
        self.state().editor.part(of, helpers)
    }

    /// Puts a part into the open program, as one change. What was put in is chosen then, and `shown` is told.
    pub(crate) fn put_in(&self, part: ProgramPart, put: Put, known: &[Helper], shown: impl FnOnce() + 'static) {
        let tab = self.tab.clone();
        let op = self.awaited(move |answer| {
            if answer.is_ok() {
                shown();
            }
            tab.say_refusal(answer);
        });
        self.input(|editor| editor.put_in(op, part, put, known));
    }

    /// Removes several, as one change.
    pub(crate) fn remove_several(&self, of: &BTreeSet<Selected>) {
        self.input(|editor| editor.remove_several(new_id(), of));
    }

    /// Lines up several streams.
    pub(crate) fn line_up(&self, of: &BTreeSet<Selected>, how: LineUp) {
        self.input(|editor| editor.line_up(of, how));
    }
}
