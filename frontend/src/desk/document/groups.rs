//! Groups of streams on this page: made, renamed, folded, taken apart, and where each is seen.

use super::gestures::short;
use super::{Document, GroupSignals, Selected, build, grouping};
use crate::desk::tab::{new_id, set_if_new};
use crate::layout;
use crate::words;
use behaviour::labels;
use behaviour::{Group, Id, Kind, Place, Record, RecordId, numbered};
use leptos::prelude::*;
use protocol::Role;
use std::collections::{BTreeSet, HashMap};

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
        let opened = self.unfolded_here.with(|opened| opened.contains(id));
        !opened && self.group(id).is_some_and(|signals| signals.record.with(|group| group.folded))
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
        let behaviour = self.behaviour();
        let taken = |title: &String| behaviour.groups().any(|(_, group)| group.title == *title);
        let base = words::group();
        let title = numbered(base, " ").find(|title| !taken(title)).unwrap_or_else(|| base.to_owned());
        let change = self.change(labels::group(&title));
        let Some((change, id)) = grouping::grouped(&behaviour, change, of, (&new_id(), &title)) else {
            return self.tab.say(words::nothing_to_group(), false);
        };
        let document = self.clone();
        self.propose_and(change, move |answer| {
            if answer.is_ok() {
                document.choose([Selected::Group(id)].into());
            }
            document.tab.say_refusal(answer);
        });
    }

    /// The groups among these go and their streams stay; the streams among these leave their groups.
    pub(crate) fn ungroup(&self, of: &BTreeSet<Selected>) {
        let behaviour = self.behaviour();
        let title = |one: &Selected| match one {
            Selected::Group(id) => Some(self.group(id)?.record.with_untracked(|group| group.title.clone())),
            Selected::Stream(id) => Some(behaviour.group_of(id)?.1.title.clone()),
            Selected::Connector(_) | Selected::Note(_) => None,
        };
        let Some(title) = of.iter().find_map(title) else { return self.tab.say(words::in_no_group(), false) };
        let inside = of.iter().flat_map(|one| match one {
            Selected::Group(id) => self.members_now(id),
            other => vec![other.id().clone()],
        });
        let streams = inside.map(Selected::Stream).filter(|one| self.stream(one.id()).is_some()).collect();
        let change = grouping::ungrouped(&behaviour, self.change(labels::ungroup(short(&title))), of);
        let document = self.clone();
        self.propose_and(change, move |answer| {
            if answer.is_ok() {
                document.choose(streams);
            }
            document.tab.say_refusal(answer);
        });
    }

    fn members_now(&self, id: &Id) -> Vec<Id> {
        untrack(|| self.members(id))
    }

    /// Another title of a group; `seen` is what its author saw when they began.
    pub(crate) fn retitle(&self, id: &Id, seen: Group, title: &str) {
        let title = title.trim();
        if title.is_empty() || title == seen.title {
            return;
        }
        let (behaviour, key) = (self.behaviour(), RecordId::new(Kind::Group, id));
        // Who only put streams into it meanwhile, or folded it, is in nobody's way.
        let now = behaviour.groups().find(|(now, _)| *now == id).map(|(_, group)| group);
        let seen = now.filter(|now| now.title == seen.title).cloned().unwrap_or(seen);
        let mine = Group { title: title.to_owned(), ..seen.clone() };
        let change = self.change(labels::rename(short(&seen.title)));
        let change = change.put(&behaviour, key, Record::Group(mine));
        self.propose(build::as_seen(change, Kind::Group, id, Record::Group(seen)));
    }

    /// Folds a group for everybody, or unfolds it. Who may not edit unfolds it here only.
    pub(crate) fn fold(&self, id: &Id, folded: bool) {
        let Some(signals) = self.group(id) else { return };
        let saved = signals.record.with_untracked(|group| group.folded);
        if saved == folded {
            if self.unfolded_here.try_update(|opened| opened.remove(id)) == Some(true) {
                self.refresh_hidden();
            }
            return;
        }
        if self.tab.refusal(Role::Editor).is_some() && saved {
            return self.unfold_here(id);
        }
        let title = signals.record.with_untracked(|group| short(&group.title));
        let change = self.change(if folded { labels::fold(title) } else { labels::unfold(title) });
        self.propose(grouping::edited(&self.behaviour(), change, id, |group| group.folded = folded));
    }

    /// Shows what is in a folded group on this page, for something in it is looked for; for others it stays as it is.
    pub(crate) fn unfold_here(&self, id: &Id) {
        self.unfolded_here.update(|opened| {
            opened.insert(id.clone());
        });
        self.refresh_hidden();
    }

    /// Returns what moves when something is dragged, and where it stands: with one of several that are chosen all of
    /// them, with a group its streams.
    pub(crate) fn moving(&self, id: &Id) -> Vec<(Id, Place)> {
        let several = self.several.get_untracked();
        let is_one = several.iter().any(|one| one.id() == id);
        let mut ids = vec![id.clone()];
        ids.extend(several.iter().map(Selected::id).filter(|other| is_one && *other != id).cloned());
        let mut seen = BTreeSet::new();
        let mut moving = Vec::new();
        for id in ids {
            let inside = self.members_now(&id);
            let own = self.stands_at(&id).map(|place| (id, place));
            let inside = inside.into_iter().filter_map(|id| Some((id.clone(), self.stands_at(&id)?)));
            moving.extend(inside.chain(own).filter(|(id, _)| seen.insert(id.clone())));
        }
        moving
    }

    fn stands_at(&self, id: &Id) -> Option<Place> {
        let place = self.stream(id).map(|signals| signals.place);
        let place = place.or_else(|| self.note_signals(id).map(|signals| signals.place));
        place.map(|place| place.get_untracked()).or_else(|| self.group(id)?.place.get_untracked())
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
        let now = self.state().record(key);
        let known = self.state().groups.get(&key.id).cloned();
        match (now, known) {
            (Some(Record::Group(group)), Some(signals)) => {
                let was_folded = signals.record.with_untracked(|group| group.folded);
                if group.folded && !was_folded {
                    self.unfolded_here.update_untracked(|opened| {
                        opened.remove(&key.id);
                    });
                }
                set_if_new(&signals.record, group);
            }
            (Some(Record::Group(group)), None) => {
                let signals = self.group_signals(&key.id, group);
                self.state().groups.insert(key.id.clone(), signals);
            }
            (_, Some(_)) => {
                self.state().groups.remove(&key.id);
                self.deselect_gone(&key.id);
            }
            (_, None) => {}
        }
    }

    fn group_signals(&self, id: &Id, group: Group) -> GroupSignals {
        let (record, place) = (ArcRwSignal::new(group), ArcRwSignal::new(self.state().saved_place(id)));
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

    /// Reads which groups there are, and what is not seen for them.
    pub(super) fn refresh_groups(&self) {
        let ids = self.state().groups.keys().cloned().collect();
        set_if_new(&self.group_ids, ids);
        self.refresh_hidden();
    }

    /// Gives to its group what was chosen of it and is not seen any more.
    fn refresh_hidden(&self) {
        let groups: Vec<(Id, GroupSignals)> =
            self.state().groups.iter().map(|(id, signals)| (id.clone(), signals.clone())).collect();
        let opened = self.unfolded_here.get_untracked();
        let mut hidden = HashMap::new();
        for (id, signals) in groups {
            signals.record.with_untracked(|group| {
                if group.folded && !opened.contains(&id) {
                    hidden.extend(group.streams.iter().map(|stream| (stream.clone(), id.clone())));
                }
            });
        }
        set_if_new(&self.hidden, hidden);
        let seen = |one: &Selected| untrack(|| self.folded_away(one)).map_or_else(|| one.clone(), Selected::Group);
        let chosen = self.chosen();
        let still: BTreeSet<Selected> = chosen.iter().map(seen).collect();
        if still != chosen {
            self.choose(still);
        }
    }
}
