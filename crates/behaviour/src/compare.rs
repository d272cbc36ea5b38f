//! The differences between two versions of a behaviour: new, changed, removed and only moved records.

use crate::{Behaviour, FillFrom, Id, Kind, Record, RecordId};
use std::collections::BTreeSet;

/// The differences between two versions, as people count them.
///
/// A connector that leads a value to a new action belongs to the action and is not counted beside it; nor is the place
/// of a new thing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VersionComparison {
    /// The records that are there now and were not before.
    pub new: BTreeSet<RecordId>,
    /// The records that are there before and now, and differ.
    pub changed: BTreeSet<RecordId>,
    /// The records that were there before and are not now.
    pub removed: BTreeSet<RecordId>,
    /// The streams that are there before and now and stand elsewhere.
    pub moved: BTreeSet<Id>,
}

/// The kind of difference between two versions of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// It is new.
    New,
    /// It is something else.
    Changed,
    /// It went.
    Removed,
}

impl VersionComparison {
    /// Compares the version `was` with the version `is`.
    #[must_use]
    pub fn between(was: &Behaviour, is: &Behaviour) -> Self {
        let counts = |id: &&RecordId| id.kind != Kind::Place;
        let only = |one: &Behaviour, other: &Behaviour| {
            let ids = one.records.keys().filter(counts).filter(|id| !other.records.contains_key(id));
            let ids: BTreeSet<RecordId> = ids.cloned().filled();
            ids.iter().filter(|id| !is_part_of_action(one, id, &ids)).cloned().filled()
        };
        let another = |id: &&RecordId| was.records.get(id).is_some_and(|before| Some(before) != is.records.get(id));
        let both = is.records.keys().filter(|id| was.records.contains_key(id));
        let (moved, changed): (Vec<&RecordId>, Vec<&RecordId>) =
            both.filter(another).partition(|id| id.kind == Kind::Place);
        Self {
            new: only(is, was),
            changed: changed.into_iter().cloned().filled(),
            removed: only(was, is),
            moved: moved.into_iter().map(|id| id.id.clone()).filled(),
        }
    }

    /// Returns the difference of one record; none if both versions have it alike.
    #[must_use]
    pub fn of(&self, id: &RecordId) -> Option<Difference> {
        let sets =
            [(&self.new, Difference::New), (&self.changed, Difference::Changed), (&self.removed, Difference::Removed)];
        sets.into_iter().find(|(set, _)| set.contains(id)).map(|(_, difference)| difference)
    }

    /// True if both do the same; things may stand elsewhere.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.new.is_empty() && self.changed.is_empty() && self.removed.is_empty()
    }
}

/// True if this is a connector that only leads to an action which comes or goes with it.
fn is_part_of_action(behaviour: &Behaviour, id: &RecordId, with: &BTreeSet<RecordId>) -> bool {
    match behaviour.records.get(id) {
        Some(Record::Connector(connector)) => {
            connector.operation.spec().acts() && with.contains(&RecordId::new(Kind::Stream, &connector.output))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{Difference, VersionComparison};
    use crate::{
        Behaviour, Connector, Id, Kind, Operation, Params, Place, Procedure, Record, RecordId, Stream, StreamKind,
        connectors,
    };

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn stream(name: &str, kind: StreamKind) -> (RecordId, Record) {
        let device = (kind != StreamKind::Ordinary).then(|| "Device".to_owned());
        let (params, resources, priority, hold_ms) = (Params::new(), None, None, None);
        let stream = Stream { kind, name: name.to_owned(), device, params, order: 0, resources, priority, hold_ms };
        (RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream))
    }

    fn connector(name: &str, operation: Operation, from: &str, to: &str) -> (RecordId, Record) {
        let connector = Connector { operation, inputs: vec![id(from)], output: id(to), order: 0 };
        (RecordId::new(Kind::Connector, &id(name)), Record::Connector(connector))
    }

    fn map(body: &str) -> (RecordId, Record) {
        connector("map", connectors::map::SPEC.with(Procedure::body(body)), "ball", "distance")
    }

    fn place(of: &str, x: f64) -> (RecordId, Record) {
        (RecordId::new(Kind::Place, &id(of)), Record::Place(Place { x, y: 0.0 }))
    }

    fn of(records: &[(RecordId, Record)]) -> Behaviour {
        Behaviour { records: records.iter().cloned().collect() }
    }

    fn first() -> Vec<(RecordId, Record)> {
        let distance = stream("distance", StreamKind::Ordinary);
        vec![stream("ball", StreamKind::Sensor), distance, map("ball.x"), place("ball", 0.0), place("distance", 0.0)]
    }

    fn said(comparison: &VersionComparison) -> [Vec<String>; 4] {
        let words = |set: &std::collections::BTreeSet<RecordId>| set.iter().map(ToString::to_string).collect();
        let moved = comparison.moved.iter().map(ToString::to_string).collect();
        [words(&comparison.new), words(&comparison.changed), words(&comparison.removed), moved]
    }

    #[test]
    fn one_and_the_same_differs_in_nothing() {
        let comparison = VersionComparison::between(&of(&first()), &of(&first()));
        assert_eq!(comparison, VersionComparison::default());
        assert!(comparison.is_empty());
    }

    #[test]
    fn what_is_new_changed_removed_and_moved_is_told_apart() {
        let mut now = first();
        now[2] = map("ball.x * 100.0");
        now[3] = place("ball", 80.0);
        now.push(stream("far", StreamKind::Ordinary));
        now.push(place("far", 5.0));
        let comparison = VersionComparison::between(&of(&first()), &of(&now));
        assert_eq!(said(&comparison), [vec!["stream/far"], vec!["connector/map"], vec![], vec!["ball"]]);
        let back = VersionComparison::between(&of(&now), &of(&first()));
        assert_eq!(said(&back), [vec![], vec!["connector/map"], vec!["stream/far"], vec!["ball"]]);
        assert_eq!(back.of(&"stream/far".parse().unwrap()), Some(Difference::Removed));
        assert_eq!(back.of(&"stream/ball".parse().unwrap()), None);
    }

    #[test]
    fn what_only_stands_elsewhere_does_the_same() {
        let mut now = first();
        now[4] = place("distance", 9.0);
        let comparison = VersionComparison::between(&of(&first()), &of(&now));
        assert!(comparison.is_empty() && comparison.moved.len() == 1);
    }

    #[test]
    fn an_action_comes_and_goes_with_what_leads_to_it() {
        let subscribe = |to: &str| connector("subscribe", connectors::subscribe::SPEC.with(()), "distance", to);
        let mut now = first();
        now.extend([stream("eyes", StreamKind::Actuator), subscribe("eyes")]);
        let comparison = VersionComparison::between(&of(&first()), &of(&now));
        assert_eq!(said(&comparison)[0], ["stream/eyes"]);
        assert_eq!(said(&VersionComparison::between(&of(&now), &of(&first())))[2], ["stream/eyes"]);
        let mut without = now.clone();
        without.pop();
        let lost = VersionComparison::between(&of(&now), &of(&without));
        assert_eq!(said(&lost)[2], ["connector/subscribe"], "the action stays, so this is what went");
    }
}
