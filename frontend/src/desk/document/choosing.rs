//! The things that are chosen, one or several, and what is done with all of them.

use super::gestures::short;
use super::{Document, LineUp, ProgramPart, Selected, grouping, several};
use crate::desk::tab::new_id;
use behaviour::labels;
use behaviour::{Behaviour, Helper, Id, Kind, Place, Record, RecordId};
use leptos::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// The place where a part of a program is put.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Put {
    /// There.
    At(Place),
    /// Beside what it was copied from, where nothing stands.
    Beside,
}

impl Document {
    /// Chooses one thing more, or one less; what is chosen alone is the first of several.
    pub(crate) fn choose_too(&self, what: Selected) {
        let alone = self.selected.get_untracked();
        let mut several = self.several.get_untracked();
        several.extend(alone);
        if !several.remove(&what) {
            several.insert(what);
        }
        self.choose(several);
    }

    /// Chooses these; one alone is what is selected.
    pub(crate) fn choose(&self, mut these: BTreeSet<Selected>) {
        let one = if these.len() == 1 { these.pop_first() } else { None };
        self.selected.set(one);
        self.several.set(these);
    }

    /// Chooses everything that is seen: streams, connectors, notes, and folded groups for what is in them.
    pub(crate) fn choose_all(&self) {
        let behaviour = self.behaviour();
        let streams = behaviour.streams().map(|(id, _)| Selected::Stream(id.clone()));
        let connectors = behaviour.connectors().map(|(id, _)| Selected::Connector(id.clone()));
        let notes = behaviour.notes().map(|(id, _)| Selected::Note(id.clone()));
        let seen = |one: Selected| untrack(|| self.folded_away(&one)).map_or(one, Selected::Group);
        self.choose(streams.chain(connectors).chain(notes).map(seen).collect());
    }

    /// True if something is chosen, alone or with others. Reactive.
    pub(crate) fn is_chosen(&self, what: &Selected) -> bool {
        self.selected.with(|selected| selected.as_ref() == Some(what))
            || self.several.with(|several| several.contains(what))
    }

    /// Returns what is chosen, one or several.
    pub(crate) fn chosen(&self) -> BTreeSet<Selected> {
        let several = self.several.get_untracked();
        if several.is_empty() { self.selected.get_untracked().into_iter().collect() } else { several }
    }

    /// A part of the open program, with the helpers of the library that it uses.
    pub(crate) fn part(&self, of: &BTreeSet<Selected>, helpers: &[Helper]) -> ProgramPart {
        let (behaviour, places) = self.behaviour_and_all_places();
        let of = &grouping::expanded(&behaviour, of);
        ProgramPart::of(&behaviour, &places, of, helpers)
    }

    /// Puts a part into the open program, as one change; helpers that are not in the library go there first. What was put in
    /// is chosen then, and `shown` is told.
    pub(crate) fn put_in(&self, part: ProgramPart, put: Put, known: &[Helper], shown: impl FnOnce() + 'static) {
        let (part, new) = part.for_library(known);
        for helper in new {
            let change = self.change(labels::helper(short(&helper.name)));
            let id = RecordId::new(Kind::Helper, &new_id());
            let change = change.put(&Behaviour::default(), id, Record::Helper(helper));
            let tab = self.tab.clone();
            self.propose_to_library(change, move |answer| tab.say_refusal(answer));
        }
        let (behaviour, places) = self.behaviour_and_all_places();
        let shift = match put {
            Put::At(place) => part.to(place),
            Put::Beside => part.to_free(&behaviour, &places),
        };
        let (change, made) = part.into(&behaviour, self.change(labels::pasted()), shift, new_id);
        let document = self.clone();
        self.propose_and(change, move |answer| {
            if answer.is_ok() {
                document.choose(made);
                shown();
            }
            document.tab.say_refusal(answer);
        });
    }

    /// Removes several, as one change.
    pub(crate) fn remove_several(&self, of: &BTreeSet<Selected>) {
        let change = several::without(&self.behaviour(), self.change(labels::remove(of.len().to_string())), of);
        self.choose(BTreeSet::new());
        self.propose(change);
    }

    /// Lines up several streams.
    pub(crate) fn line_up(&self, of: &BTreeSet<Selected>, how: LineUp) {
        let (behaviour, places) = self.behaviour_and_all_places();
        self.move_as(&labels::aligned(), &several::lined_up(&behaviour, &places, of, how));
    }

    /// The open behaviour, and where everything stands on this page: streams, notes, and the boxes of folded groups.
    fn behaviour_and_all_places(&self) -> (Behaviour, BTreeMap<Id, Place>) {
        let (behaviour, mut places) = self.behaviour_and_places();
        for (id, _) in behaviour.notes() {
            places.extend(self.note_signals(id).map(|signals| (id.clone(), signals.place.get_untracked())));
        }
        for (id, _) in behaviour.groups().filter(|(id, _)| untrack(|| self.is_folded(id))) {
            places.extend(self.group(id).and_then(|signals| Some((id.clone(), signals.at.get_untracked()?))));
        }
        (behaviour, places)
    }
}
