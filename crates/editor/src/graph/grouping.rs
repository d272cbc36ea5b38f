//! Groups of streams, as pure functions: made, taken apart, folded, and what belongs to them.

use crate::Selected;
use behaviour::{Behaviour, Change, FillFrom, Group, Id, Kind, Record, RecordId};
use std::collections::BTreeSet;

fn key(kind: Kind, id: &Id) -> RecordId {
    RecordId::new(kind, id)
}

/// The streams of a group that are there.
pub fn members<'a>(behaviour: &'a Behaviour, group: &'a Group) -> impl Iterator<Item = &'a Id> {
    group.streams.iter().filter(|id| behaviour.stream(id).is_some())
}

fn group<'a>(behaviour: &'a Behaviour, id: &Id) -> Option<&'a Group> {
    match behaviour.records.get(&key(Kind::Group, id)) {
        Some(Record::Group(group)) => Some(group),
        _ => None,
    }
}

/// These, and the streams of the groups among them with the connectors that lead to those.
pub fn expanded(behaviour: &Behaviour, of: &BTreeSet<Selected>) -> BTreeSet<Selected> {
    let mut all = of.clone();
    let groups = of.iter().filter_map(|one| if let Selected::Group(id) = one { group(behaviour, id) } else { None });
    let inside: BTreeSet<&Id> = groups.flat_map(|group| members(behaviour, group)).filled();
    let within = behaviour.connectors().filter(|(_, connector)| inside.contains(&connector.output));
    all.extend(within.map(|(id, _)| Selected::Connector(id.clone())));
    all.extend(inside.into_iter().map(|id| Selected::Stream(id.clone())));
    all
}

/// The chosen streams as one group: into the group among them if that is one, else a new one of that id and title. None if
/// there is nothing to gather.
pub fn grouped(
    behaviour: &Behaviour,
    change: Change,
    of: &BTreeSet<Selected>,
    (new, title): (&Id, &str),
) -> Option<(Change, Id)> {
    let mut groups = of.iter().filter_map(|one| if let Selected::Group(id) = one { Some(id) } else { None });
    let into = groups.next().filter(|_| groups.next().is_none());
    let known = into.and_then(|id| group(behaviour, id)).cloned();
    let streams = expanded(behaviour, of).into_iter().filter_map(|one| match one {
        Selected::Stream(id) => Some(id),
        _ => None,
    });
    let streams: BTreeSet<Id> = streams.filter(|id| behaviour.stream(id).is_some()).filled();
    let is_new = |id: &&Id| known.as_ref().is_none_or(|group| !group.streams.contains(*id));
    if streams.iter().filter(is_new).count() == 0 {
        return None;
    }
    let id = into.unwrap_or(new);
    let change = taken_out(behaviour, change, &streams, Some(id));
    let mut made = known.unwrap_or_else(|| Group { title: title.to_owned(), ..Group::default() });
    made.streams.extend(streams);
    Some((change.put(behaviour, key(Kind::Group, id), Record::Group(made)), id.clone()))
}

/// Without these groups, whose streams stay; of the others, without these streams.
pub fn ungrouped(behaviour: &Behaviour, change: Change, of: &BTreeSet<Selected>) -> Change {
    let gone = |id: &Id| of.contains(&Selected::Group(id.clone()));
    let groups: Vec<&Id> = behaviour.groups().map(|(id, _)| id).filter(|id| gone(id)).collect();
    let change = groups.iter().fold(change, |change, id| without_group(behaviour, change, id));
    let streams = of.iter().filter_map(|one| if let Selected::Stream(id) = one { Some(id.clone()) } else { None });
    let inside = |id: &Id| behaviour.group_of(id).is_some_and(|(group, _)| !gone(group));
    taken_out(behaviour, change, &streams.filter(inside).collect(), None)
}

/// Streams go out of their groups, but for one; a group that nothing is left of goes.
fn taken_out(behaviour: &Behaviour, change: Change, streams: &BTreeSet<Id>, but: Option<&Id>) -> Change {
    behaviour.groups().filter(|(id, _)| Some(*id) != but).fold(change, |change, (id, group)| {
        let left: BTreeSet<Id> = group.streams.difference(streams).cloned().filled();
        let is_there = |id: &Id| behaviour.stream(id).is_some();
        match () {
            () if left.len() == group.streams.len() => change,
            () if !left.iter().any(is_there) => without_group(behaviour, change, id),
            () => {
                let group = Group { streams: left, ..group.clone() };
                change.put(behaviour, key(Kind::Group, id), Record::Group(group))
            }
        }
    })
}

/// Without a group, whose streams stay.
pub fn without_group(behaviour: &Behaviour, change: Change, id: &Id) -> Change {
    change.take(behaviour, key(Kind::Group, id)).take(behaviour, key(Kind::Place, id))
}

/// A change that removes streams also removes the groups that nothing is left of.
pub fn without_empty(behaviour: &Behaviour, change: Change) -> Change {
    let gone = |id: &Id| {
        let stream = key(Kind::Stream, id);
        change.edits.iter().any(|edit| edit.id == stream && edit.after.is_none())
    };
    let is_left = |id: &Id| behaviour.stream(id).is_some() && !gone(id);
    let becomes_empty = |group: &Group| group.streams.iter().any(gone) && !group.streams.iter().any(is_left);
    let empty: Vec<&Id> = behaviour.groups().filter(|(_, group)| becomes_empty(group)).map(|(id, _)| id).collect();
    empty.into_iter().fold(change, |change, id| without_group(behaviour, change, id))
}

/// Another title, or folded and unfolded.
pub fn edited(behaviour: &Behaviour, change: Change, id: &Id, edit: impl FnOnce(&mut Group)) -> Change {
    let Some(mut group) = group(behaviour, id).cloned() else { return change };
    edit(&mut group);
    change.put(behaviour, key(Kind::Group, id), Record::Group(group))
}

#[cfg(test)]
#[path = "grouping_tests.rs"]
mod tests;
