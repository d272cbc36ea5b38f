//! The use of notes and groups by hand and by keys: begun, opened, walked through.

use super::Stage;
use super::bounds::bounds;
use crate::desk::{Selected, StepDirection};
use crate::graph::words;
use behaviour::sort_few;
use behaviour::{Graph, Id, Kind, Place, RecordId};
use leptos::prelude::*;
use protocol::Role;

/// A note that is written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NoteWriting {
    /// The id of the note; none for a new one.
    pub(super) id: Option<Id>,
    /// The middle of its top edge.
    pub(super) at: Place,
}

impl Stage {
    /// Begins a note where the pointer is, else in the middle of what is seen.
    pub(super) fn add_note(&self) {
        if untrack(|| !self.desk.may(Role::Editor)) {
            return;
        }
        let (size, view) = (self.size.get_untracked(), self.view.get_untracked());
        let seen = |place: &Place| {
            let (x, y) = view.to_stage(*place);
            x > 0.0 && y > self.above() && x < size.0 && y < size.1
        };
        let middle = view.to_canvas((size.0 / 2.0, (size.1 + self.above()) / 2.0));
        let at = self.pointer.get_untracked().filter(seen).unwrap_or(middle);
        self.noting.set(Some(NoteWriting { id: None, at }));
    }

    /// Begins a note beside what is chosen.
    pub(super) fn add_note_beside(&self) {
        let around = untrack(|| self.around(&self.desk.document.chosen()));
        let beside = around.map(|around| Place { x: around.left - 150.0, y: around.top });
        match beside.filter(|_| untrack(|| self.desk.may(Role::Editor))) {
            Some(at) => self.noting.set(Some(NoteWriting { id: None, at })),
            None => self.add_note(),
        }
    }

    /// Opens a note to write in it, or unfolds a group; an open group is renamed. Whether it was one of these.
    pub(super) fn open_aside(&self, what: &Selected) -> bool {
        match what {
            Selected::Note(id) => {
                let place = self.desk.document.note_signals(id).map(|signals| signals.place.get_untracked());
                let is_free =
                    || !self.desk.document.says_busy(&RecordId::new(Kind::Note, id), words::note_of_somebody());
                if let Some(at) = place.filter(|_| untrack(|| self.desk.may(Role::Editor)) && is_free()) {
                    self.noting.set(Some(NoteWriting { id: Some(id.clone()), at }));
                }
                true
            }
            Selected::Group(id) => {
                if untrack(|| self.desk.document.is_folded(id)) {
                    self.fold(id, false);
                } else {
                    self.rename(id);
                }
                true
            }
            Selected::Stream(_) | Selected::Connector(_) => false,
        }
    }

    /// Folds a group or unfolds it; the keyboard stays with it.
    pub(super) fn fold(&self, id: &Id, folded: bool) {
        self.wanted.set(Some(id.clone()));
        self.desk.document.fold(id, folded);
    }

    /// Folds an open group, unfolds a folded one.
    pub(super) fn turn(&self, id: &Id) -> bool {
        self.fold(id, untrack(|| !self.desk.document.is_folded(id)));
        true
    }

    /// Folds the group that a stream is in; whether it is in one.
    pub(super) fn turn_around(&self, stream: &Id) -> bool {
        let behaviour = self.desk.document.behaviour();
        behaviour.group_of(stream).is_some_and(|(id, _)| self.turn(id))
    }

    /// Gives something the keyboard if that was wanted as soon as it is drawn.
    pub(super) fn drawn_now(&self, id: &Id) {
        if self.wanted.with_untracked(|wanted| wanted.as_ref() == Some(id)) {
            self.wanted.set(None);
            self.focus(id);
        }
    }

    /// Notes and groups from the top of the canvas to the bottom.
    fn asides(&self) -> Vec<Selected> {
        let document = &self.desk.document;
        let notes = document.note_ids.get_untracked().into_iter().map(Selected::Note);
        let groups = document.group_ids.get_untracked().into_iter().map(Selected::Group);
        let placed = notes.chain(groups).filter_map(|one| Some((bounds(&self.desk, one.id())?, one)));
        let mut placed: Vec<_> = placed.collect();
        sort_few(&mut placed, |(one, _), (other, _)| (one.top, one.left) < (other.top, other.left));
        placed.into_iter().map(|(_, one)| one).collect()
    }

    /// Returns true if Tab comes to this note or group: the last one it was at, else the first. Reactive.
    pub(super) fn is_aside_stop(&self, id: &Id) -> ArcMemo<bool> {
        let (stage, id) = (self.clone(), id.clone());
        ArcMemo::new(move |_| {
            let document = &stage.desk.document;
            let (notes, groups) = (document.note_ids.get(), document.group_ids.get());
            let there = |at: &Id| notes.contains(at) || groups.contains(at);
            let stop = stage.aside.get().filter(there).or_else(|| groups.first().or(notes.first()).cloned());
            stop.as_ref() == Some(&id)
        })
    }

    /// From a note or group to the next one; from a folded group up and down along its edges, if it has some there.
    pub(super) fn step_aside(&self, here: &Selected, way: StepDirection) -> bool {
        let next = self.along_edges(here, way).or_else(|| {
            let all = self.asides();
            let at = all.iter().position(|one| one == here)?;
            let next = match way {
                StepDirection::Down | StepDirection::Right => at + 1,
                StepDirection::Up | StepDirection::Left => at.checked_sub(1)?,
            };
            all.get(next).cloned()
        });
        if let Some(next) = next {
            self.desk.document.choose([next.clone()].into());
            self.focus(next.id());
        }
        true
    }

    fn along_edges(&self, here: &Selected, way: StepDirection) -> Option<Selected> {
        let Selected::Group(id) = here else { return None };
        let document = &self.desk.document;
        let inside = untrack(|| if document.is_folded(id) { document.members(id) } else { Vec::new() });
        let behaviour = document.behaviour();
        let graph = Graph::of(&behaviour);
        let ends = |stream: &Id| -> Vec<Id> {
            match way {
                StepDirection::Down => {
                    graph.out_of_stream(stream).iter().map(|(_, next)| next.output.clone()).collect()
                }
                StepDirection::Up => {
                    graph.into_stream(stream).iter().flat_map(|(_, next)| next.inputs.clone()).collect()
                }
                StepDirection::Left | StepDirection::Right => Vec::new(),
            }
        };
        let next = inside.iter().flat_map(ends).find(|end| !inside.contains(end))?;
        Some(self.seen_as(next))
    }

    /// A stream as it is seen: itself, or the folded group that it is in.
    pub(super) fn seen_as(&self, stream: Id) -> Selected {
        self.desk.document.seen_as(stream)
    }
}
