//! The check that a history from elsewhere, such as a backup, is one that rooms can have made.

use crate::labels::LABEL_MAX_BYTES;
use crate::room::check_whole;
use crate::rules;
use crate::size::Size;
use crate::{AnyKnowledge, Behaviour, Change, Id, Kind, LookupSet, NAME_MAX_CHARS, RecordId, Refusal, without_unseen};
use phrase::{Phrased, phrase};

/// A behaviour as its changes make it from nothing, one after the other, each decided about as a room would have.
///
/// The devices that there are and the rules of procedures are not asked: they were decided about when the change was
/// made, and perhaps otherwise since. A fault in them is shown as a problem, to be mended.
#[derive(Clone, Debug, Default)]
pub struct History {
    behaviour: Behaviour,
    size: Size,
    seen: LookupSet<Id>,
    is_library: bool,
}

impl History {
    /// Returns an empty history of the helper library, which holds nothing but helpers.
    #[must_use]
    pub fn of_the_library() -> Self {
        Self { is_library: true, ..Self::default() }
    }

    /// Makes the next change.
    ///
    /// # Errors
    /// Refuses a change that no room can have made; then this history is of no more use.
    pub fn take(&mut self, change: &Change) -> Result<(), Refusal> {
        if !self.seen.insert(change.op.clone()) {
            return Err(Refusal::Malformed(phrase!("history.twice", "the change {op} twice", op = change.op)));
        }
        check_whole(change)?;
        check_said(change)?;
        self.check_fits(change)?;
        self.behaviour.apply(change);
        rules::check(&self.behaviour, change, &self.size, &AnyKnowledge)?;
        self.size = self.size.after(change);
        Ok(())
    }

    /// Looks whether it can be found in a list, once all of it was taken.
    ///
    /// # Errors
    /// If it has no name.
    pub fn check_end(&self) -> Result<(), Refusal> {
        let is_named = self.is_library || self.behaviour.settings().is_some();
        if is_named { Ok(()) } else { Err(Refusal::Name(String::new())) }
    }

    /// The behaviour so far.
    #[must_use]
    pub fn behaviour(&self) -> &Behaviour {
        &self.behaviour
    }

    fn check_fits(&self, change: &Change) -> Result<(), Refusal> {
        change.edits.iter().try_for_each(|edit| {
            if (edit.id.kind == Kind::Helper) != self.is_library {
                return Err(Refusal::Malformed(edit.id.phrase()));
            }
            if edit.id == RecordId::settings() && edit.after.is_none() {
                return Err(Refusal::Malformed(phrase!("malformed.settings", "the settings cannot be removed")));
            }
            let fits = self.behaviour.records.get(&edit.id) == edit.before.as_ref();
            if fits { Ok(()) } else { Err(Refusal::Stale(edit.id.phrase())) }
        })
    }
}

/// Checks the author and the label of a change. Rooms leave out characters that are not seen, so that a text with
/// control characters comes from elsewhere.
fn check_said(change: &Change) -> Result<(), Refusal> {
    if change.label.bytes() > LABEL_MAX_BYTES {
        return Err(Refusal::TooLong(phrase!("limited.label", "the label"), LABEL_MAX_BYTES));
    }
    let label = change.label.to_string();
    if label.chars().any(char::is_control) {
        return Err(Refusal::Unseen(without_unseen(&label).chars().take(40).collect()));
    }
    check_person(&change.author)
}

/// Checks that a person can have this name.
///
/// # Errors
/// Refuses a name that is too long or holds characters that are not seen there.
pub fn check_person(name: &str) -> Result<(), Refusal> {
    if name.chars().count() > NAME_MAX_CHARS {
        return Err(Refusal::TooLong(phrase!("limited.name", "this name"), NAME_MAX_CHARS));
    }
    if name.chars().any(char::is_control) {
        return Err(Refusal::Unseen(without_unseen(name).chars().take(40).collect()));
    }
    Ok(())
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

    /// Makes two streams and then these records, and returns the refusal, if any.
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
    fn what_was_right_and_is_unknown_today_is_taken() {
        let unknown = connectors::map::SPEC.with(Procedure::body("no_such_function(value)"));
        let (at, sense) = stream("s");
        let Record::Stream(sense) = sense else { panic!("it is one") };
        let sense = Stream { kind: StreamKind::Sensor, device: Some("NoSuchSense".into()), ..sense };
        assert_eq!(with(vec![connector("a", "b", unknown), (at, Record::Stream(sense))]), Ok(()));
    }

    #[test]
    fn what_no_room_would_have_let_in_is_refused() {
        let long = connectors::map::SPEC.with(Procedure::body(&"value + ".repeat(2_000)));
        assert!(matches!(with(vec![connector("a", "b", long)]), Err(Refusal::TooLong(..))));
        let called = |name: &str| match stream("c") {
            (at, Record::Stream(stream)) => with(vec![(at, Record::Stream(Stream { name: name.into(), ..stream }))]),
            _ => panic!("it is a stream"),
        };
        assert!(matches!(called(&"x".repeat(1 << 20)), Err(Refusal::TooLarge(_))));
        assert_eq!(called("a\0b"), Err(Refusal::Unseen("ab".into())));
        let many = (0..10_000).map(|at| stream(&format!("s{at}")));
        assert_eq!(with(many.collect()), Err(Refusal::TooMany("streams".into(), crate::STREAMS_MAX)));
        let (at, _) = stream("n");
        let note = Record::Note(crate::Note::new("n".repeat(5_000)));
        assert!(with(vec![(RecordId::new(Kind::Note, &at.id), note)]).is_err());
    }

    #[test]
    fn who_made_a_change_and_what_it_is_called_is_looked_at_too() {
        let (at, record) = stream("a");
        let made = change("one").put(&Behaviour::default(), at, record);
        for bad in ["a\0b".to_owned(), "x".repeat(1 << 20)] {
            for bad in [Change { label: bad.as_str().into(), ..made.clone() }, Change { author: bad, ..made.clone() }] {
                assert!(History::default().take(&bad).is_err());
            }
        }
        assert_eq!(History::default().take(&made), Ok(()));
    }

    #[test]
    fn helpers_are_in_the_library_and_nothing_else_is() {
        let helper = Helper { name: "near".into(), body: "1".into(), ..Helper::default() };
        let helper = (RecordId::new(Kind::Helper, &id("h")), Record::Helper(helper));
        let put = |(at, record): (RecordId, Record)| change("one").put(&Behaviour::default(), at, record);
        let mut library = History::of_the_library();
        assert_eq!((library.take(&put(helper.clone())), library.check_end()), (Ok(()), Ok(())));
        assert!(History::default().take(&put(helper)).is_err());
        assert!(History::of_the_library().take(&put(stream("a"))).is_err());
        let mut unnamed = History::default();
        assert_eq!(unnamed.take(&put(stream("a"))), Ok(()));
        assert!(unnamed.check_end().is_err(), "nobody would find it in a list");
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
