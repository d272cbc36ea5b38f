//! The difference between what a robot runs and the program as it is: what it does not use yet, and whose changes these are.

use behaviour::{
    Accepted, Behaviour, Connector, Edit, FillFrom, Helper, Id, Kind, Procedure, Record, RecordId, Stream,
};
use std::collections::{BTreeMap, BTreeSet};

/// Records as they were at some revision; none for one that was not there.
pub type RecordsBefore = BTreeMap<RecordId, Option<Record>>;

/// The people who changed something last since the run began: their name and their client.
pub type Authors = BTreeMap<RecordId, (String, Option<Id>)>;

/// A change of which the run has what was before.
#[derive(Clone, Debug, PartialEq)]
pub struct Unused {
    /// The record that was changed.
    pub id: RecordId,
    /// The name of who changed it; none for one's own changes.
    pub by: Option<String>,
    /// The record as the run has it.
    pub was: Option<Record>,
    /// The record as it is now.
    pub is: Option<Record>,
}

/// The authors of what a robot would take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnusedAuthors {
    /// All of it is one's own.
    Me,
    /// All of it is one other person's, of this name.
    One(String),
    /// It is of several people.
    Several,
}

/// Returns true for what a robot runs by.
fn is_of_robot(edit: &&Edit) -> bool {
    matches!(edit.id.kind, Kind::Connector | Kind::Stream | Kind::Helper)
}

/// Returns the records that were there before these changes.
#[must_use]
pub fn before(changes: &[Accepted]) -> RecordsBefore {
    let mut before = RecordsBefore::new();
    for edit in changes.iter().flat_map(|accepted| &accepted.change.edits).filter(is_of_robot) {
        before.entry(edit.id.clone()).or_insert_with(|| edit.before.clone());
    }
    before
}

/// Returns who made these changes, the last one of each record.
#[must_use]
pub fn authors(changes: &[Accepted]) -> Authors {
    let of = |accepted: &Accepted| {
        let author = (accepted.change.author.clone(), accepted.change.by.clone());
        let edits = accepted.change.edits.iter().filter(is_of_robot);
        edits.map(|edit| (edit.id.clone(), author.clone())).collect::<Vec<_>>()
    };
    changes.iter().flat_map(of).filled()
}

/// Returns the parts of a program that a robot has otherwise and would do otherwise with: `now` gives a record as it is, `me`
/// is who looks.
pub fn unused_changes(
    before: &RecordsBefore,
    authors: &Authors,
    me: Option<&Id>,
    now: impl Fn(&RecordId) -> Option<Record>,
) -> Vec<Unused> {
    let by = |id: &RecordId| {
        let (name, client) = authors.get(id)?;
        (client.as_ref() != me).then(|| name.clone())
    };
    let changes = before.iter().map(|(id, was)| Unused { is: now(id), by: by(id), was: was.clone(), id: id.clone() });
    changes.filter(|unused| is_another(unused.was.as_ref(), unused.is.as_ref())).collect()
}

/// Returns the authors of these changes.
#[must_use]
pub fn whose(changes: &[Unused]) -> UnusedAuthors {
    let first = changes.first().and_then(|first| first.by.clone());
    if changes.iter().any(|change| change.by != first) {
        return UnusedAuthors::Several;
    }
    first.map_or(UnusedAuthors::Me, UnusedAuthors::One)
}

/// Returns the connectors of the open behaviour that the run does not have as they are now, or whose helper it has otherwise, and
/// the streams whose sense or action it has with other settings.
#[must_use]
pub fn unused(before: &RecordsBefore, open: &Behaviour, library: &Behaviour) -> BTreeSet<Id> {
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

/// Tells if a robot would do otherwise with the one than with the other.
#[must_use]
pub fn is_another(was: Option<&Record>, is: Option<&Record>) -> bool {
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
