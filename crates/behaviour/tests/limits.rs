//! Everything has a bound that is said in the refusal; what is beyond one already can be made smaller.
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use behaviour::{
    AnyKnowledge, BEHAVIOUR_MAX_BYTES, Behaviour, Change, Connector, Decision, GROUPS_MAX, Group, HELPERS_MAX, Helper,
    Id, Kind, Knowledge, LIBRARY_MAX_BYTES, NOTES_MAX, Note, PLACES_MAX, Params, Place, Procedure, Record, RecordId,
    Refusal, Room, STREAMS_MAX, Settings, Stream, StreamKind, Value, connectors, record_bytes,
};

/// A rule that must not be reached: asking about procedures costs the most.
struct Never;
impl Knowledge for Never {
    fn device(&self, _: StreamKind, _: &str, _: &Params) -> Result<(), phrase::Phrase> {
        panic!("the bounds come first")
    }
    fn body(&self, _: &[String], _: &str) -> Result<(), phrase::Phrase> {
        panic!("the bounds come first")
    }
}

fn key(kind: Kind, at: usize) -> RecordId {
    RecordId::new(kind, &Id::new(&format!("x{at}")).unwrap())
}

fn helper(at: usize, body: &str) -> Record {
    let (name, params) = (format!("h{at}"), vec!["v".to_owned()]);
    Record::Helper(Helper { name, params, body: body.to_owned(), ..Helper::default() })
}

fn note(text: &str) -> Record {
    Record::Note(Note::new(text.to_owned()))
}

fn place(x: f64) -> Record {
    Record::Place(Place { x, y: 0.0 })
}

fn stream(name: &str) -> Stream {
    let (name, kind, device, params) = (name.to_owned(), StreamKind::Ordinary, None, Params::new());
    Stream { kind, name, device, params, order: 0, resources: None, priority: None, hold_ms: None }
}

fn of(records: impl IntoIterator<Item = (RecordId, Record)>) -> Behaviour {
    Behaviour { records: records.into_iter().collect() }
}

fn propose(room: &Room, knowledge: &dyn Knowledge, edits: Vec<(RecordId, Option<Record>)>) -> Decision {
    let op = format!("op{}", room.revision());
    let mut change = Change::of(Id::new(&op).unwrap(), "Aiko", "Test");
    for (id, after) in edits {
        change = match after {
            Some(record) => change.put(room.behaviour(), id, record),
            None => change.take(room.behaviour(), id),
        };
    }
    room.propose(1, change, knowledge)
}

fn put(room: &Room, id: RecordId, record: Record) -> Decision {
    propose(room, &Never, vec![(id, Some(record))])
}

fn refusal(decision: Decision) -> Refusal {
    let Decision::Refuse(refusal) = decision else { panic!("this was not refused") };
    let sentence = refusal.to_string();
    assert!(sentence.ends_with('.') && sentence.starts_with(|c: char| c.is_uppercase() || c == '“'), "{sentence}");
    refusal
}

/// Makes as many large notes as there must be to pass the bound.
fn too_many_notes() -> Behaviour {
    let text = "n".repeat(4_000);
    of((0..BEHAVIOUR_MAX_BYTES / 4_000 + 1).map(|at| (key(Kind::Note, at), note(&text))))
}

#[test]
fn each_kind_has_a_bound_of_its_count() {
    let helpers = of((0..HELPERS_MAX).map(|at| (key(Kind::Helper, at), helper(at, ""))));
    let notes = of((0..NOTES_MAX).map(|at| (key(Kind::Note, at), note("n"))));
    let group = || Record::Group(Group { title: "G".into(), ..Group::default() });
    let groups = of((0..GROUPS_MAX).map(|at| (key(Kind::Group, at), group())));
    let places = of((0..PLACES_MAX).map(|at| (key(Kind::Place, at), place(0.0))));
    let streams = of((0..STREAMS_MAX).map(|at| (key(Kind::Stream, at), Record::Stream(stream(&format!("S{at}"))))));
    let one_more = [
        (helpers, Kind::Helper, helper(99_999, "v")),
        (notes, Kind::Note, note("one more")),
        (groups, Kind::Group, group()),
        (places, Kind::Place, place(1.0)),
        (streams, Kind::Stream, Record::Stream(stream("One more"))),
    ];
    for (full, kind, record) in one_more {
        let (room, many) = (Room::open(full.clone(), 1), full.records.len());
        let refused = refusal(put(&room, key(kind, 99_999), record.clone()));
        assert!(matches!(&refused, Refusal::TooMany(_, most) if *most == many), "{refused:?}");
        assert!(refused.to_string().contains(&many.to_string()), "{refused}");
        let swap = vec![(key(kind, 0), None), (key(kind, 99_999), Some(record))];
        assert!(matches!(propose(&room, &AnyKnowledge, swap), Decision::Save(_)), "one for another");
    }
}

#[test]
fn the_library_and_a_behaviour_have_a_bound_of_their_bytes() {
    let body = "v".repeat(8_000);
    let helpers = of((0..LIBRARY_MAX_BYTES / 8_400).map(|at| (key(Kind::Helper, at), helper(at, &body))));
    let mut library = Room::open(helpers, 1);
    let refused = (0..10).find_map(|at| {
        let decision =
            propose(&library, &AnyKnowledge, vec![(key(Kind::Helper, 9_000 + at), Some(helper(9_000 + at, &body)))]);
        match decision {
            Decision::Save(saved) => {
                library.commit(&saved);
                None
            }
            other => Some(refusal(other)),
        }
    });
    assert_eq!(refused, Some(Refusal::Full("library".into(), LIBRARY_MAX_BYTES)));
    assert!(Refusal::Full("library".into(), LIBRARY_MAX_BYTES).to_string().contains("2 MB"));
    let used: usize = library.behaviour().records.iter().map(|(id, record)| record_bytes(id, record)).sum();
    assert!(used <= LIBRARY_MAX_BYTES);

    let room = Room::open(too_many_notes(), 1);
    let full = Refusal::Full("program".into(), BEHAVIOUR_MAX_BYTES);
    assert_eq!(refusal(put(&room, key(Kind::Stream, 0), Record::Stream(stream("S")))), full);
    let settings = (RecordId::settings(), Some(Record::Settings(Settings::named("Play"))));
    assert_eq!(refusal(propose(&room, &Never, vec![settings])), full);
}

#[test]
fn what_is_too_large_already_opens_and_can_be_made_smaller() {
    let mut room = Room::open(too_many_notes(), 1);
    let take = |room: &mut Room, edits| match propose(room, &AnyKnowledge, edits) {
        Decision::Save(saved) => room.commit(&saved),
        other => panic!("{other:?}"),
    };
    take(&mut room, vec![(key(Kind::Note, 0), Some(note("shorter")))]);
    take(&mut room, vec![(key(Kind::Note, 1), Some(note(&"m".repeat(4_000))))]);
    assert!(matches!(put(&room, key(Kind::Note, 0), note("a longer one")), Decision::Refuse(Refusal::Full(..))));
    take(&mut room, (100..400).map(|at| (key(Kind::Note, at), None)).collect());
    take(&mut room, vec![(key(Kind::Note, 0), Some(note("a longer one")))]);
}

#[test]
fn one_record_has_a_bound_whatever_is_large_in_it() {
    let room = Room::open(of([(RecordId::settings(), Record::Settings(Settings::named("Play")))]), 1);
    let long = "a".repeat(100_000);
    let params = |value| Stream { params: Params::from([("p".to_owned(), value)]), ..stream("S") };
    let connector = |operation, inputs: usize| {
        let id = |at| Id::new(&format!("s{at}")).unwrap();
        Record::Connector(Connector { operation, inputs: (0..inputs).map(id).collect(), output: id(0), order: 0 })
    };
    let body = |args| connectors::map::SPEC.with(Procedure::Body { body: "1".to_owned(), args: Some(args) });
    let helper = |params| Record::Helper(Helper { name: "h".into(), params, body: String::new(), ..Helper::default() });
    let deep = (0..60).fold(Value::text(&long), |inner, _| Value::list([inner]));
    let cases = [
        (key(Kind::Stream, 1), Record::Stream(params(Value::text(&long)))),
        (key(Kind::Stream, 1), Record::Stream(params(deep))),
        (key(Kind::Stream, 1), Record::Stream(Stream { resources: Some(vec!["head".into(); 5_000]), ..stream("S") })),
        (key(Kind::Stream, 1), Record::Stream(Stream { resources: Some(vec![long.clone()]), ..stream("S") })),
        (key(Kind::Connector, 1), connector(connectors::merge::SPEC.with(()), 5_000)),
        (key(Kind::Connector, 1), connector(body(vec!["a".into(); 5_000]), 1)),
        (key(Kind::Connector, 1), connector(body(vec!["a".repeat(300)]), 1)),
        (key(Kind::Connector, 1), connector(connectors::map::SPEC.with(Procedure::Helper("a".repeat(300))), 1)),
        (key(Kind::Helper, 1), helper(vec!["a".into(); 5_000])),
        (key(Kind::Helper, 1), helper(vec!["a".repeat(300)])),
        (RecordId::settings(), Record::Settings(Settings { robot: "r".repeat(300), ..Settings::named("Play") })),
    ];
    for (id, record) in cases {
        let refused = refusal(put(&room, id.clone(), record));
        assert!(matches!(refused, Refusal::TooLarge(_) | Refusal::TooLong(..)), "{id}: {refused:?}");
    }
}

#[test]
fn a_record_that_is_too_large_already_can_be_made_smaller() {
    let old = |many| Record::Stream(Stream { resources: Some(vec!["head".into(); many]), ..stream("S") });
    let id = key(Kind::Stream, 1);
    let room = Room::open(of([(id.clone(), old(5_000))]), 1);
    assert!(matches!(put(&room, id.clone(), old(4_999)), Decision::Save(_)));
    assert!(matches!(put(&room, id, old(5_001)), Decision::Refuse(Refusal::TooLarge(_))));
}

#[test]
fn a_name_that_hides_something_is_refused_and_an_old_one_can_be_changed() {
    let room = |name: &str| {
        let settings = (RecordId::settings(), Record::Settings(Settings::named(name)));
        Room::open(of([settings, (key(Kind::Stream, 1), Record::Stream(stream(name)))]), 1)
    };
    let plain = room("Ball");
    for name in ["Ball\u{202e}", "B\u{200b}all", "\u{2066}Ball", "Ba\u{200d}ll"] {
        let refused = refusal(put(&plain, key(Kind::Stream, 2), Record::Stream(stream(name))));
        assert_eq!(refused, Refusal::Unseen("Ball".to_owned()));
        let renamed = Record::Settings(Settings::named(name));
        assert_eq!(refusal(put(&plain, RecordId::settings(), renamed)), Refusal::Unseen("Ball".to_owned()));
        let old = room(name);
        let moved = Record::Stream(Stream { order: 5, ..stream(name) });
        assert!(matches!(put(&old, key(Kind::Stream, 1), moved), Decision::Save(_)), "another field");
        assert!(matches!(put(&old, key(Kind::Stream, 1), Record::Stream(stream("Ball"))), Decision::Save(_)));
    }
}

#[test]
fn labels_and_authors_are_kept_without_what_is_not_seen() {
    let room = Room::open(Behaviour::default(), 0);
    let change = Change::of(Id::new("op").unwrap(), "Ai\u{202e}ko", "Rename B\u{200b}all");
    let change = change.put(room.behaviour(), key(Kind::Note, 1), note("n"));
    let Decision::Save(saved) = room.propose(1, change, &Never) else { panic!("refused") };
    assert_eq!((saved.change.author.as_str(), saved.change.label.to_string().as_str()), ("Aiko", "Rename Ball"));
}
