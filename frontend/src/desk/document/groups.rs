//! Groups of streams on this page: made, renamed, folded, taken apart, and where each is seen.

use super::{Document, GroupSignals, Selected};
use crate::desk::tab::{new_id, set_if_new};
use crate::layout;
use crate::words;
use behaviour::{Group, Id, Place, Record, RecordId};
use leptos::prelude::*;
use std::collections::BTreeSet;

impl Document {
    /// The signals of one group, none when it is gone.
    pub(crate) fn group(&self, id: &Id) -> Option<GroupSignals> {
        self.state().groups.get(id).cloned()
    }

    /// The folded group that a stream is not seen for. Reactive.
    pub(crate) fn hidden_in(&self, stream: &Id) -> Option<Id> {
        self.hidden.with(|hidden| hidden.get(stream).cloned())
    }

    /// The folded group that something is not seen for: a connector is with the stream that it leads to. Reactive.
    pub(crate) fn folded_away(&self, what: &Selected) -> Option<Id> {
        match what {
            Selected::Stream(id) => self.hidden_in(id),
            Selected::Connector(id) => {
                let output = self.connector(id)?.record.with(|connector| connector.output.clone());
                self.hidden_in(&output)
            }
            Selected::Note(_) | Selected::Group(_) => None,
        }
    }

    /// True if a group is seen as a box here. Reactive.
    pub(crate) fn is_folded(&self, id: &Id) -> bool {
        self.folded.with(|folded| folded.contains(id))
    }

    /// The streams of a group that are there. Reactive.
    pub(crate) fn members(&self, id: &Id) -> Vec<Id> {
        let Some(signals) = self.group(id) else { return Vec::new() };
        self.stream_ids.track();
        let is_there = |id: &&Id| self.stream(id).is_some();
        signals.record.with(|group| group.streams.iter().filter(is_there).cloned().collect())
    }

    /// Makes a group of what is chosen, and selects it.
    pub(crate) fn make_group(&self, of: &BTreeSet<Selected>) {
        self.input(|editor| editor.make_group(new_id(), of, words::group()));
    }

    /// The groups among these go and their streams stay; the streams among these leave their groups.
    pub(crate) fn ungroup(&self, of: &BTreeSet<Selected>) {
        self.input(|editor| editor.ungroup(new_id(), of));
    }

    /// Another title of a group; `seen` is what its author saw when they began.
    pub(crate) fn retitle(&self, id: &Id, seen: Group, title: &str) {
        self.input(|editor| editor.retitle(new_id(), id, seen, title));
    }

    /// Folds a group for everybody, or unfolds it. Who may not edit unfolds it here only.
    pub(crate) fn fold(&self, id: &Id, folded: bool) {
        self.input(|editor| editor.fold(new_id(), id, folded));
    }

    /// Shows what is in a folded group on this page, for something in it is looked for; for others it stays as it is.
    pub(crate) fn unfold_here(&self, id: &Id) {
        self.input(|editor| editor.unfold_here(id));
    }

    /// Returns what moves when something is dragged, and where it stands.
    pub(crate) fn moving(&self, id: &Id) -> Vec<(Id, Place)> {
        self.state().editor.moving(id)
    }

    /// Shows something elsewhere while it is dragged.
    pub(crate) fn show_at(&self, id: &Id, place: Place) {
        if let Some(signals) = self.stream(id) {
            signals.place.set(place);
        } else if let Some(signals) = self.note_signals(id) {
            signals.place.set(place);
        } else if let Some(signals) = self.group(id) {
            signals.place.set(Some(place));
        }
    }

    pub(super) fn refresh_group(&self, key: &RecordId) {
        let now = self.state().editor.shown(key);
        let known = self.group(&key.id);
        match (now, known) {
            (Some(Record::Group(group)), Some(signals)) => set_if_new(&signals.record, group),
            (Some(Record::Group(group)), None) => {
                let signals = self.group_signals(&key.id, group);
                self.state().groups.insert(key.id.clone(), signals);
            }
            (_, Some(_)) => drop(self.state().groups.remove(&key.id)),
            (_, None) => {}
        }
    }

    fn group_signals(&self, id: &Id, group: Group) -> GroupSignals {
        let (record, place) = (ArcRwSignal::new(group), ArcRwSignal::new(self.state().editor.put_at(id)));
        let (document, of, own) = (self.clone(), record.clone(), place.clone());
        let at = ArcMemo::new(move |_| {
            if let Some(place) = own.get() {
                return Some(place);
            }
            document.stream_ids.track();
            let place = |id: &Id| Some(document.stream(id)?.place.get());
            let places: Vec<Place> = of.with(|group| group.streams.iter().filter_map(place).collect());
            layout::box_place(&places)
        });
        GroupSignals { record, place, at }
    }

    /// Reads which groups there are.
    pub(super) fn refresh_groups(&self) {
        let ids = self.state().groups.keys().cloned().collect();
        set_if_new(&self.group_ids, ids);
    }
}
