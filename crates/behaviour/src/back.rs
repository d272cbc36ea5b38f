//! Back to what was: a whole revision again, or what one change removed, each as one new change.

use crate::{Behaviour, Change, Edit, FillFrom, Id, Kind, Knowledge, Record, RecordId, Refusal, Room};
use phrase::{Phrase, phrase};

/// Records of a removal that are tried one by one, if not all of them can come back.
const ONE_BY_ONE_MAX: usize = 64;

impl Behaviour {
    /// Takes back the change that was made last, without asking any rule.
    pub fn take_back(&mut self, last: &Change) {
        for edit in &last.edits {
            match &edit.before {
                Some(record) => self.records.insert(edit.id.clone(), record.clone()),
                None => self.records.remove(&edit.id),
            };
        }
    }
}

impl Room {
    /// The change that makes the behaviour again what it was; without edits if it is.
    #[must_use]
    pub fn go_back(&self, was: &Behaviour, start: Change) -> Change {
        let now = self.behaviour();
        let all = now.records.keys().chain(was.records.keys()).distinct();
        let edits = all.into_iter().filter_map(|id| {
            let (before, after) = (now.records.get(id), was.records.get(id));
            let stays = before == after || (after.is_none() && *id == RecordId::settings());
            (!stays).then(|| Edit { id: id.clone(), before: before.cloned(), after: after.cloned() })
        });
        Change { edits: edits.collect(), ..start }
    }

    /// The change that brings back what another one removed, as far as it is not there and the rules allow; none if all
    /// of it is there. A position comes back only with what stands there.
    ///
    /// # Errors
    /// Returns the refusal that stands in the way, if nothing at all can come back.
    pub fn bring_back(
        &self,
        removal: &Change,
        start: Change,
        knowledge: &dyn Knowledge,
    ) -> Result<Option<Change>, Refusal> {
        let gone = removal.edits.iter().filter(|edit| edit.after.is_none());
        let gone = gone.filter(|edit| !self.behaviour().records.contains_key(&edit.id));
        let mut gone: Vec<(&RecordId, &Record)> =
            gone.filter_map(|edit| Some((&edit.id, edit.before.as_ref()?))).collect();
        if gone.iter().all(|(id, _)| id.kind == Kind::Place) {
            return Ok(None);
        }
        let whole = gone.iter().fold(start.clone(), |made, one| self.with(made, *one));
        let Err(refusal) = self.judge(&whole, knowledge) else { return Ok(Some(whole)) };
        if gone.len() > ONE_BY_ONE_MAX {
            return Err(refusal);
        }
        gone.sort_unstable_by_key(|(id, record)| rank(id, record));
        let made = gone.into_iter().fold(start, |made, one| {
            let more = self.with(made.clone(), one);
            if self.has_ground(&more, one.0) && self.judge(&more, knowledge).is_ok() { more } else { made }
        });
        if made.edits.iter().all(|edit| edit.id.kind == Kind::Place) { Err(refusal) } else { Ok(Some(made)) }
    }

    fn with(&self, change: Change, (id, record): (&RecordId, &Record)) -> Change {
        change.put(self.behaviour(), id.clone(), record.clone())
    }

    /// True if what stands at a position is there, or comes back too.
    fn has_ground(&self, change: &Change, id: &RecordId) -> bool {
        let stands = |id: &RecordId| matches!(id.kind, Kind::Stream | Kind::Connector | Kind::Note | Kind::Group);
        let mut all = self.behaviour().records.keys().chain(change.edits.iter().map(|edit| &edit.id));
        id.kind != Kind::Place || all.any(|other| other.id == id.id && stands(other))
    }
}

/// Names the thing that a change took away, as people call it: “Distance”, the map; none if it took several streams.
#[must_use]
pub fn what_went(removal: &Change) -> Option<Phrase> {
    let gone = removal.edits.iter().filter(|edit| edit.after.is_none()).filter_map(|edit| edit.before.as_ref());
    let mut streams = gone.clone().filter_map(|record| match record {
        Record::Stream(stream) => Some(phrase!("called.Stream", "“{name}”", name = stream.name)),
        _ => None,
    });
    match (streams.next(), streams.next()) {
        (Some(one), None) => Some(one),
        (Some(_), Some(_)) => None,
        (None, _) => gone.clone().find_map(|record| match record {
            Record::Connector(connector) => {
                Some(phrase!("called.Connector", "the {word}", word = connector.operation.spec()))
            }
            Record::Helper(helper) => Some(phrase!("called.Helper", "the helper “{name}”", name = helper.name)),
            _ => None,
        }),
    }
}

/// First what others need, connectors in their order, positions at last.
fn rank(id: &RecordId, record: &Record) -> (u8, i64, Id) {
    let (kind, order) = match record {
        Record::Stream(stream) => (0, stream.order),
        Record::Helper(_) | Record::Note(_) | Record::Settings(_) | Record::Pad(_) => (1, 0),
        Record::Connector(connector) => (2, connector.order),
        Record::Group(_) => (3, 0),
        Record::Place(_) => (4, 0),
    };
    (kind, order, id.id.clone())
}

#[cfg(test)]
mod tests {
    use crate::{
        AnyKnowledge, Behaviour, Change, Connector, Decision, Id, Kind, Params, Place, Procedure, Record, RecordId,
        Refusal, Room, Stream, StreamKind, connectors,
    };

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn stream(name: &str) -> (RecordId, Record) {
        let params = Params::new();
        let (device, resources, priority, hold_ms) = (None, None, None, None);
        let (kind, order) = (StreamKind::Ordinary, 0);
        let stream = Stream { kind, name: name.to_owned(), device, params, order, resources, priority, hold_ms };
        (RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream))
    }

    fn map(name: &str, from: &str, to: &str) -> (RecordId, Record) {
        let operation = connectors::map::SPEC.with(Procedure::body("1"));
        let connector = Connector { operation, inputs: vec![id(from)], output: id(to), order: 0 };
        (RecordId::new(Kind::Connector, &id(name)), Record::Connector(connector))
    }

    fn place(of: &str) -> (RecordId, Record) {
        (RecordId::new(Kind::Place, &id(of)), Record::Place(Place { x: 1.0, y: 2.0 }))
    }

    fn change(op: &str) -> Change {
        Change::of(id(op), "Aiko", "Edit")
    }

    fn make(room: &mut Room, change: Change) -> Change {
        let Decision::Save(made) = room.propose(0, change, &AnyKnowledge) else { panic!("it is allowed") };
        room.commit(&made);
        made.change
    }

    fn put(room: &mut Room, op: &str, records: Vec<(RecordId, Record)>) -> Change {
        let change = records.into_iter().fold(change(op), |made, (id, record)| made.put(room.behaviour(), id, record));
        make(room, change)
    }

    fn take(room: &mut Room, op: &str, records: &[&str]) -> Change {
        let change = records.iter().fold(change(op), |made, id| made.take(room.behaviour(), id.parse().unwrap()));
        make(room, change)
    }

    /// `a` leads to `b` by `m`, and `b` to `c` by `n`.
    fn room() -> Room {
        let mut room = Room::open(Behaviour::default(), 0);
        let streams = ["a", "b", "c"].map(stream);
        put(&mut room, "start", [streams.to_vec(), vec![map("m", "a", "b"), map("n", "b", "c"), place("b")]].concat());
        room
    }

    #[test]
    fn going_back_is_one_change_that_makes_it_what_it_was() {
        let mut room = room();
        let was = room.behaviour().clone();
        assert!(room.go_back(&was, change("none")).edits.is_empty());
        let first = take(&mut room, "one", &["connector/n"]);
        let second = put(&mut room, "two", vec![stream("d"), ("stream/a".parse().unwrap(), stream("z").1)]);
        let back = room.go_back(&was, change("back"));
        assert_eq!(back.edits.len(), 3);
        make(&mut room, back);
        assert_eq!(*room.behaviour(), was);
        let mut again = room.behaviour().clone();
        again.apply(&first);
        again.apply(&second);
        again.take_back(&second);
        again.take_back(&first);
        assert_eq!(again, was);
    }

    #[test]
    fn what_was_removed_comes_back_whole() {
        let mut room = room();
        let was = room.behaviour().clone();
        let gone = ["stream/b", "connector/m", "connector/n", "place/b"];
        let removal = take(&mut room, "gone", &gone);
        assert_eq!(super::what_went(&removal), Some("“b”".into()));
        let back = room.bring_back(&removal, change("back"), &AnyKnowledge).unwrap().unwrap();
        make(&mut room, back);
        assert_eq!(*room.behaviour(), was);
        assert_eq!(room.bring_back(&removal, change("more"), &AnyKnowledge), Ok(None), "all of it is there");
    }

    #[test]
    fn as_much_comes_back_as_the_rules_allow() {
        let mut room = room();
        let removal = take(&mut room, "gone", &["stream/b", "connector/m", "connector/n", "place/b"]);
        put(&mut room, "instead", vec![map("o", "a", "c")]);
        let back = room.bring_back(&removal, change("back"), &AnyKnowledge).unwrap().unwrap();
        let ids: Vec<String> = back.edits.iter().map(|edit| edit.id.to_string()).collect();
        assert_eq!(ids, ["stream/b", "connector/m", "place/b"], "c gets its values from elsewhere now");
        make(&mut room, back);
    }

    #[test]
    fn what_stands_in_the_way_is_said() {
        let mut room = room();
        let removal = take(&mut room, "gone", &["connector/n", "place/b"]);
        assert_eq!(super::what_went(&removal), Some("the map".into()));
        put(&mut room, "instead", vec![map("o", "a", "c")]);
        let refused = room.bring_back(&removal, change("back"), &AnyKnowledge);
        assert_eq!(refused, Err(Refusal::SecondInput("c".into())));
    }
}
