//! What the run has of what was changed since it began, so that the page can tell what the robot does not use yet.

use super::{Desk, State, set_if_new};
use crate::link;
use crate::live::LiveConnector;
use behaviour::{Accepted, Connector, Helper, Id, Kind, Procedure, Record, RecordId};
use leptos::prelude::*;
use protocol::{Reply, Request};
use std::collections::{BTreeMap, BTreeSet};

/// Records as they were at some revision; none for one that was not there.
pub(super) type Before = BTreeMap<RecordId, Option<Record>>;

/// What tells one version on the robot from another: the run, its revision and its fingerprint.
pub(super) type Version = (u64, u64, u32);

impl Desk {
    /// Begins anew when the robot runs another version of the open program, or none.
    pub(super) fn follow_version(&self) {
        let run = self.run_of_open();
        let version = run.as_ref().map(|run| (run.run, run.revision, run.fingerprint));
        if std::mem::replace(&mut self.state().version, version) == version {
            return;
        }
        if version.is_none() {
            self.forget_unused();
        }
        self.state().ran.clear();
        self.renew_unused();
        let known = self.revision.get_untracked();
        if let Some(run) = run.filter(|run| run.revision < known) {
            self.ask_before(run.behaviour, run.revision);
        }
    }

    /// The counts of a version that is gone do not stand beside what was written since.
    fn forget_unused(&self) {
        let unused = self.unused.get_untracked();
        unused
            .iter()
            .filter_map(|id| self.connector(id))
            .for_each(|signals| signals.live.set(LiveConnector::default()));
    }

    fn ask_before(&self, behaviour: Id, revision: u64) {
        let (desk, version) = (self.clone(), self.state().version);
        link::ask(Request::Since { behaviour, revision }, move |reply| {
            if let Some(Reply::Missed { changes, .. }) = reply
                && desk.state().version == version
            {
                desk.state().ran.extend(before(changes));
                desk.renew_unused();
            }
        });
    }

    /// A change was made; the run has what was before it.
    pub(super) fn note_ran(&self, accepted: &Accepted) {
        if self.state().version.is_none() {
            return;
        }
        for (id, was) in before(std::slice::from_ref(accepted)) {
            self.state().ran.entry(id).or_insert(was);
        }
        self.renew_unused();
    }

    fn renew_unused(&self) {
        let unused = self.state().unused();
        set_if_new(&self.unused, unused);
        self.renew_failing();
    }
}

/// What was there before these changes.
fn before(changes: &[Accepted]) -> Before {
    let mut before = Before::new();
    for edit in changes.iter().flat_map(|accepted| &accepted.change.edits) {
        if matches!(edit.id.kind, Kind::Connector | Kind::Helper) {
            before.entry(edit.id.clone()).or_insert_with(|| edit.before.clone());
        }
    }
    before
}

impl State {
    /// The connectors that the run does not have as they are now, or whose helper it has otherwise.
    fn unused(&self) -> BTreeSet<Id> {
        let helpers = self.unused_helpers();
        let differs = |id: &Id, now: &Connector| match self.ran.get(&RecordId::new(Kind::Connector, id)) {
            Some(Some(Record::Connector(ran))) => !runs_alike(ran, now),
            Some(_) => true,
            None => helper_of(now).is_some_and(|helper| helpers.contains(helper)),
        };
        let connectors = self.confirmed.connectors();
        connectors.filter(|(id, now)| differs(id, now)).map(|(id, _)| id.clone()).collect()
    }

    fn unused_helpers(&self) -> BTreeSet<&str> {
        let changed = self.ran.iter().filter_map(|(id, was)| match was {
            Some(Record::Helper(was)) => {
                let now = self.library.records.get(id);
                let alike = matches!(now, Some(Record::Helper(now)) if works_alike(was, now));
                (!alike).then_some(was.name.as_str())
            }
            _ => None,
        });
        changed.collect()
    }
}

fn runs_alike(one: &Connector, other: &Connector) -> bool {
    (&one.operation, &one.inputs, &one.output) == (&other.operation, &other.inputs, &other.output)
}

fn works_alike(one: &Helper, other: &Helper) -> bool {
    (&one.name, &one.params, &one.body) == (&other.name, &other.params, &other.body)
}

fn helper_of(connector: &Connector) -> Option<&str> {
    match connector.operation.procedure()? {
        Procedure::Helper(name) => Some(name),
        Procedure::Body { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{State, before};
    use behaviour::{Accepted, Change, Connector, Id, Kind, Procedure, Record, RecordId, connectors};

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn map(body: &str) -> Record {
        let operation = connectors::map::SPEC.with(Procedure::body(body));
        Record::Connector(Connector { operation, inputs: vec![id("in")], output: id("out"), order: 0 })
    }

    fn wrote(state: &mut State, body: &str) -> Accepted {
        let key = RecordId::new(Kind::Connector, &id("c"));
        let change = Change::of(id("op"), "Aiko", "Edit").put(&state.confirmed, key, map(body));
        state.confirmed.apply(&change);
        Accepted { revision: 1, change }
    }

    #[test]
    fn a_connector_is_unused_until_it_is_as_the_run_has_it() {
        let mut state = State::default();
        wrote(&mut state, "1");
        let edited = wrote(&mut state, "2");
        state.ran = before(&[edited]);
        assert_eq!(state.unused().into_iter().collect::<Vec<_>>(), [id("c")]);
        wrote(&mut state, "1");
        assert!(state.unused().is_empty());
    }

    #[test]
    fn a_new_connector_is_unused() {
        let mut state = State::default();
        let made = wrote(&mut state, "1");
        state.ran = before(&[made]);
        assert_eq!(state.unused().len(), 1);
    }
}
