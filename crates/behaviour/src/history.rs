//! Whether a history that comes from elsewhere, such as a backup, hangs together.

use crate::rules::{check_graph, check_groups, check_helper_names, check_names};
use crate::{
    Behaviour, Change, Edit, Engine, Id, Kind, LookupSet, RATE_MS, Record, RecordId, Refusal, Stream, StreamKind,
};

/// A behaviour as its changes make it from nothing, one after the other.
///
/// Each must fit what was there, and leave a graph that rooms and robots can rely on. How large things may be, what a
/// procedure may say and which devices there are is not asked: that was decided when the change was made, and may have
/// been decided otherwise since. What is wrong there is shown as a problem, to be mended.
#[derive(Clone, Debug, Default)]
pub struct History {
    behaviour: Behaviour,
    seen: LookupSet<Id>,
}

impl History {
    /// Makes the next change.
    ///
    /// # Errors
    /// Why it cannot have been made; then this history is of no more use.
    pub fn take(&mut self, change: &Change) -> Result<(), Refusal> {
        if !self.seen.insert(change.op.clone()) {
            return Err(Refusal::Malformed(format!("the change {} twice", change.op)));
        }
        self.check_fits(change)?;
        self.behaviour.apply(change);
        for record in change.edits.iter().filter_map(|edit| edit.after.as_ref()) {
            check_record(record)?;
        }
        let touches = |kind: Kind| change.edits.iter().any(|edit| edit.id.kind == kind);
        if touches(Kind::Stream) || touches(Kind::Connector) {
            check_names(&self.behaviour)?;
            check_graph(&self.behaviour)?;
        }
        if touches(Kind::Group) {
            check_groups(&self.behaviour)?;
        }
        if touches(Kind::Helper) { check_helper_names(&self.behaviour) } else { Ok(()) }
    }

    /// The behaviour so far.
    #[must_use]
    pub fn behaviour(&self) -> &Behaviour {
        &self.behaviour
    }

    fn check_fits(&self, change: &Change) -> Result<(), Refusal> {
        if change.edits.is_empty() {
            return Err(Refusal::Edits(0));
        }
        let mut touched = LookupSet::new();
        change.edits.iter().try_for_each(|edit| {
            if !touched.insert(&edit.id) || !is_of_one_kind(edit) {
                return Err(Refusal::Malformed(edit.id.to_string()));
            }
            if edit.id == RecordId::settings() && edit.after.is_none() {
                return Err(Refusal::Malformed("the settings cannot be removed".into()));
            }
            let fits = self.behaviour.records.get(&edit.id) == edit.before.as_ref();
            if fits { Ok(()) } else { Err(Refusal::Stale(edit.id.to_string())) }
        })
    }
}

fn is_of_one_kind(edit: &Edit) -> bool {
    [&edit.before, &edit.after].into_iter().flatten().all(|record| record.kind() == edit.id.kind)
}

/// What would stop or mislead an engine, whatever the sizes are.
fn check_record(record: &Record) -> Result<(), Refusal> {
    match record {
        Record::Settings(settings) => match settings.engine {
            Engine::Frame { frame_ms: 0 } => Err(Refusal::Rate(0)),
            Engine::Frame { .. } | Engine::Event => Ok(()),
        },
        Record::Stream(stream) => check_stream(stream),
        Record::Connector(connector) => match connector.operation.period_ms() {
            Some(period_ms) if !RATE_MS.contains(&period_ms) => Err(Refusal::Rate(period_ms)),
            Some(_) | None => Ok(()),
        },
        Record::Helper(helper) => {
            let names = std::iter::once(&helper.name).chain(&helper.params);
            let bad = names.into_iter().find(|name| !crate::is_identifier(name));
            bad.map_or(Ok(()), |bad| Err(Refusal::Identifier(bad.clone())))
        }
        Record::Place(_) | Record::Note(_) | Record::Group(_) => Ok(()),
    }
}

fn check_stream(stream: &Stream) -> Result<(), Refusal> {
    let has_device = stream.device.is_some();
    match stream.kind {
        StreamKind::Ordinary if has_device => Err(Refusal::OrdinaryDevice),
        StreamKind::Sensor | StreamKind::Actuator if !has_device => Err(Refusal::NoDevice(stream.name.clone())),
        StreamKind::Ordinary | StreamKind::Sensor | StreamKind::Actuator => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::History;
    use crate::{
        Behaviour, Change, Connector, Helper, Id, Kind, Operation, Parameters, Params, Procedure, Record, RecordId,
        Refusal, Settings, Stream, StreamKind, connectors,
    };

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn change(op: &str) -> Change {
        Change::of(id(op), "Aiko", "Edit")
    }

    fn stream(name: &str) -> (RecordId, Record) {
        let stream = Stream {
            kind: StreamKind::Ordinary,
            name: name.to_owned(),
            device: None,
            params: Params::new(),
            order: 0,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        (RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream))
    }

    fn connector(from: &str, to: &str, operation: Operation) -> (RecordId, Record) {
        let connector = Connector { operation, inputs: vec![id(from)], output: id(to), order: 0 };
        (RecordId::new(Kind::Connector, &id(&format!("{from}-{to}"))), Record::Connector(connector))
    }

    /// What becomes of two streams when these records come too.
    fn with(records: Vec<(RecordId, Record)>) -> Result<(), Refusal> {
        let mut history = History::default();
        let none = Behaviour::default();
        let first =
            [stream("a"), stream("b")].into_iter().fold(change("one"), |made, (id, to)| made.put(&none, id, to));
        history.take(&first).unwrap();
        let before = history.behaviour().clone();
        history.take(&records.into_iter().fold(change("two"), |made, (id, to)| made.put(&before, id, to)))
    }

    fn map() -> Operation {
        connectors::map::SPEC.with(Procedure::body("value"))
    }

    #[test]
    fn what_was_right_and_is_too_large_or_unknown_today_is_taken() {
        let long = connectors::map::SPEC.with(Procedure::body(&"no_such_function(value) + ".repeat(10_000)));
        let helper = Helper { name: "near".into(), params: vec![], body: "?".into(), ..Helper::default() };
        let helper = (RecordId::new(Kind::Helper, &id("h")), Record::Helper(helper));
        assert_eq!(with(vec![connector("a", "b", long), helper, stream(&"x".repeat(60))]), Ok(()));
    }

    #[test]
    fn a_graph_that_no_room_allows_is_refused() {
        let circle = vec![connector("a", "b", map()), connector("b", "a", map())];
        assert!(matches!(with(circle), Err(Refusal::Cycle(_))));
        assert_eq!(with(vec![connector("a", "nowhere", map())]), Err(Refusal::MissingStream));
        assert_eq!(
            with(vec![connector("a", "b", connectors::sample::SPEC.with(Parameters::period(0)))]),
            Err(Refusal::Rate(0))
        );
        let (_, twin) = stream("a");
        let twin = with(vec![(RecordId::new(Kind::Stream, &id("c")), twin)]);
        assert_eq!(twin, Err(Refusal::NameTaken("a".into())));
        let (at, _) = stream("a");
        assert!(matches!(with(vec![(at, Record::Settings(Settings::named("x")))]), Err(Refusal::Malformed(_))));
    }

    #[test]
    fn a_change_must_fit_what_was_before_it() {
        let mut history = History::default();
        let (id, record) = stream("a");
        let made = change("one").put(&Behaviour::default(), id, record);
        history.take(&made).unwrap();
        assert!(matches!(history.clone().take(&made), Err(Refusal::Malformed(_))), "the same change twice");
        let again = Change { op: super::Id::new("two").unwrap(), ..made };
        assert!(matches!(history.clone().take(&again), Err(Refusal::Stale(_))), "it is there already");
        assert_eq!(history.clone().take(&change("three")), Err(Refusal::Edits(0)));
    }
}
