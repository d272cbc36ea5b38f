//! The difference between the run and what was changed since it began, so that the page can tell what the robot does
//! not use yet.

use super::RobotsPanel;
use crate::desk::tab::set_if_new;
use crate::link;
use crate::live::LiveConnector;
use behaviour::{Accepted, Behaviour, Connector, FillFrom, Helper, Id, Kind, Procedure, Record, RecordId, Stream};
use leptos::prelude::*;
use protocol::{answer, request};
use std::collections::{BTreeMap, BTreeSet};

/// Records as they were at some revision; none for one that was not there.
pub(super) type RecordsBefore = BTreeMap<RecordId, Option<Record>>;

/// The mark that tells one version on the robot from another: the run, its revision and its fingerprint.
pub(super) type RobotVersion = (u64, u64, u32);

impl RobotsPanel {
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
        {
            let mut state = self.state();
            state.before.clear();
            state.authors.clear();
        }
        self.renew_unused();
        let known = self.document.revision.get_untracked();
        if let Some(run) = run.filter(|run| run.revision < known) {
            self.ask_before(run.behaviour, run.revision);
        }
    }

    /// The counts of a version that is gone do not stand beside what was written since.
    fn forget_unused(&self) {
        if self.state().kept.is_some() {
            return;
        }
        let unused = self.unused.get_untracked();
        unused
            .iter()
            .filter_map(|id| self.document.connector(id))
            .for_each(|signals| signals.live.set(LiveConnector::default()));
    }

    fn ask_before(&self, behaviour: Id, revision: u64) {
        let (robots, version) = (self.clone(), self.state().version);
        link::ask(request::Since { behaviour, revision }, move |answer| {
            if let Ok(answer::Newer::Missed(answer::Missed { changes, .. })) = answer
                && robots.state().version == version
            {
                robots.note_authors(&changes);
                robots.state().before.extend(before(&changes));
                robots.renew_unused();
            }
        });
    }

    /// Another program was opened: whatever runs of it is looked at afresh.
    pub(in crate::desk) fn follow_opened(&self) {
        self.state().version = None;
        self.follow_version();
    }

    /// A change was made; the run has what was before it.
    pub(in crate::desk) fn note_before(&self, accepted: &Accepted) {
        if self.state().version.is_none() {
            return;
        }
        self.note_authors(std::slice::from_ref(accepted));
        for (id, was) in before(std::slice::from_ref(accepted)) {
            self.state().before.entry(id).or_insert(was);
        }
        self.renew_unused();
    }

    /// The connector as the run has it, if it was changed since and was there. Follows [`RobotsPanel::unused`].
    pub(crate) fn ran(&self, id: &Id) -> Option<Connector> {
        match self.state().before.get(&RecordId::new(Kind::Connector, id)) {
            Some(Some(Record::Connector(ran))) => Some(ran.clone()),
            _ => None,
        }
    }

    fn renew_unused(&self) {
        let unused = {
            let before = &self.state().before;
            self.document.with_confirmed(|open| self.library.with_records(|library| unused(before, open, library)))
        };
        set_if_new(&self.unused, unused);
        self.renew_failing();
    }
}

/// Returns the records that were there before these changes.
fn before(changes: &[Accepted]) -> RecordsBefore {
    let mut before = RecordsBefore::new();
    for edit in changes.iter().flat_map(|accepted| &accepted.change.edits) {
        if matches!(edit.id.kind, Kind::Connector | Kind::Stream | Kind::Helper) {
            before.entry(edit.id.clone()).or_insert_with(|| edit.before.clone());
        }
    }
    before
}

/// The connectors of the open behaviour that the run does not have as they are now, or whose helper it has otherwise, and
/// the streams whose sense or action it has with other settings.
fn unused(before: &RecordsBefore, open: &Behaviour, library: &Behaviour) -> BTreeSet<Id> {
    let helpers = unused_helpers(before, library);
    let differs = |id: &Id, now: &Connector| match before.get(&RecordId::new(Kind::Connector, id)) {
        Some(Some(Record::Connector(ran))) => !runs_alike(ran, now),
        Some(_) => true,
        None => helper_of(now).is_some_and(|helper| helpers.contains(helper)),
    };
    let connectors = open.connectors().filter(|(id, now)| differs(id, now)).map(|(id, _)| id.clone());
    let is_set_otherwise = |id: &Id, now: &Stream| match before.get(&RecordId::new(Kind::Stream, id)) {
        Some(Some(Record::Stream(ran))) => !is_set_alike(ran, now),
        Some(_) => now.device.is_some(),
        None => false,
    };
    let streams = open.streams().filter(|(id, now)| is_set_otherwise(id, now)).map(|(id, _)| id.clone());
    connectors.chain(streams).filled()
}

/// True if a robot would do otherwise with the one than with the other.
pub(super) fn is_another(was: Option<&Record>, is: Option<&Record>) -> bool {
    match (was, is) {
        (Some(Record::Connector(was)), Some(Record::Connector(is))) => !runs_alike(was, is),
        (Some(Record::Stream(was)), Some(Record::Stream(is))) => !is_set_alike(was, is),
        (Some(Record::Helper(was)), Some(Record::Helper(is))) => !works_alike(was, is),
        // A stream without a sense or an action is what its connectors make of it.
        (None, Some(Record::Stream(alone))) | (Some(Record::Stream(alone)), None) => alone.device.is_some(),
        (None, Some(Record::Helper(_))) | (None, None) => false,
        _ => true,
    }
}

fn is_set_alike(one: &Stream, other: &Stream) -> bool {
    (&one.device, &one.params, &one.resources, one.priority, one.hold_ms)
        == (&other.device, &other.params, &other.resources, other.priority, other.hold_ms)
}

fn unused_helpers<'a>(before: &'a RecordsBefore, library: &Behaviour) -> BTreeSet<&'a str> {
    let changed = before.iter().filter_map(|(id, was)| match was {
        Some(Record::Helper(was)) => {
            let alike = matches!(library.records.get(id), Some(Record::Helper(now)) if works_alike(was, now));
            (!alike).then_some(was.name.as_str())
        }
        _ => None,
    });
    changed.filled()
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
    use super::{before, unused};
    use behaviour::{
        Accepted, Behaviour, Change, Connector, Helper, Id, Kind, Params, Procedure, Record, RecordId, Stream,
        StreamKind, Value, connectors,
    };

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn map(procedure: Procedure) -> Record {
        let operation = connectors::map::SPEC.with(procedure);
        Record::Connector(Connector { operation, inputs: vec![id("in")], output: id("out"), order: 0 })
    }

    fn wrote(to: &mut Behaviour, kind: Kind, record: Record) -> Accepted {
        let key = RecordId::new(kind, &id("c"));
        let change = Change::of(id("op"), "Aiko", "Edit").put(to, key, record);
        to.apply(&change);
        Accepted { revision: 1, change }
    }

    fn wrote_body(to: &mut Behaviour, body: &str) -> Accepted {
        wrote(to, Kind::Connector, map(Procedure::body(body)))
    }

    #[test]
    fn a_connector_is_unused_until_it_is_as_the_run_has_it() {
        let (mut open, library) = (Behaviour::default(), Behaviour::default());
        wrote_body(&mut open, "1");
        let was = before(&[wrote_body(&mut open, "2")]);
        assert_eq!(unused(&was, &open, &library).into_iter().collect::<Vec<_>>(), [id("c")]);
        wrote_body(&mut open, "1");
        assert!(unused(&was, &open, &library).is_empty());
    }

    #[test]
    fn a_connector_is_unused_while_its_helper_works_otherwise_than_the_run_has_it() {
        let helper = |body: &str| {
            Record::Helper(Helper {
                name: "far".into(),
                params: vec!["x".into()],
                body: body.into(),
                ..Helper::default()
            })
        };
        let (mut open, mut library) = (Behaviour::default(), Behaviour::default());
        wrote(&mut open, Kind::Connector, map(Procedure::Helper("far".into())));
        wrote(&mut library, Kind::Helper, helper("x > 1"));
        let was = before(&[wrote(&mut library, Kind::Helper, helper("x > 2"))]);
        assert_eq!(unused(&was, &open, &library).len(), 1);
        wrote(&mut library, Kind::Helper, helper("x > 1"));
        assert!(unused(&was, &open, &library).is_empty());
    }

    #[test]
    fn an_action_is_unused_while_it_is_set_otherwise_than_the_run_has_it() {
        let tracker = |name: &str, arm: &str| {
            Record::Stream(Stream {
                kind: StreamKind::Actuator,
                name: name.into(),
                device: Some("Tracker".into()),
                params: Params::from([("effector".to_owned(), Value::text(arm))]),
                order: 0,
                resources: None,
                priority: None,
                hold_ms: None,
            })
        };
        let (mut open, library) = (Behaviour::default(), Behaviour::default());
        wrote(&mut open, Kind::Stream, tracker("Tracker", "None"));
        let mut was = before(&[wrote(&mut open, Kind::Stream, tracker("Follow", "None"))]);
        assert!(unused(&was, &open, &library).is_empty(), "a name is nothing to a robot");
        was.extend(before(&[wrote(&mut open, Kind::Stream, tracker("Follow", "LArm"))]));
        assert_eq!(unused(&was, &open, &library).len(), 1);
    }

    #[test]
    fn a_new_connector_is_unused() {
        let mut open = Behaviour::default();
        let made = wrote_body(&mut open, "1");
        assert_eq!(unused(&before(&[made]), &open, &Behaviour::default()).len(), 1);
    }
}
