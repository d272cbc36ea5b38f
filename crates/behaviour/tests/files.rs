//! A behaviour as a file and back: nothing that its records hold is lost.

use behaviour::{
    Behaviour, BehaviourFile, Connector, FileTile, Flaw, FlawKind, Group, Id, Kind, Note, Pad, Params, Place,
    Procedure, Record, RecordId, Settings, Stream, StreamKind, Tile, TileAction, Value, connectors,
};

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

fn stream(name: &str, order: i64) -> Record {
    Record::Stream(Stream {
        kind: StreamKind::Ordinary,
        name: name.to_owned(),
        device: None,
        params: Params::from([("gain".to_owned(), 0.1.into())]),
        order,
        resources: Some(Vec::new()),
        priority: Some(-1),
        hold_ms: Some(7),
    })
}

fn full() -> Behaviour {
    let sample = connectors::map::SPEC.with(Procedure::Body { body: "a".to_owned(), args: Some(vec!["a".to_owned()]) });
    let connector = Connector { operation: sample, inputs: vec![id("s1")], output: id("s0"), order: 9 };
    let (robot, exercise) = ("pepper".to_owned(), Some("Near".to_owned()));
    let settings = Settings { robot, exercise, ..Settings::named("Full") };
    let signed = Note { text: String::new(), by: "Aiko".to_owned(), at_ms: 1 };
    let group = |streams: &[&str], folded| {
        let streams = streams.iter().map(|stream| id(stream)).collect();
        Record::Group(Group { title: "Group".to_owned(), streams, folded })
    };
    let tile =
        |label: &str, does| Tile { label: label.to_owned(), asks: matches!(does, TileAction::Hand { .. }), does };
    let params = Params::from([("text".to_owned(), "Hello".into())]);
    let tiles = [
        (1, tile("Hello", TileAction::Hand { device: "SayParameter".to_owned(), params, value: Value::Null })),
        (3, tile("Touched", TileAction::Pretend { stream: id("s2"), value: true.into() })),
        (4, tile("Gone", TileAction::Pretend { stream: id("gone"), value: 1.into() })),
        (9, tile("Smiles", TileAction::Word { word: "smile".to_owned(), span: true })),
    ];
    let place = |x| Record::Place(Place { x, y: -0.5 });
    let records = [
        (RecordId::settings(), Record::Settings(settings)),
        (RecordId::new(Kind::Stream, &id("s0")), stream("Last", 5)),
        (RecordId::new(Kind::Stream, &id("s1")), stream("First", -3)),
        (RecordId::new(Kind::Stream, &id("s2")), stream("Middle", 1)),
        (RecordId::new(Kind::Connector, &id("c0")), Record::Connector(connector)),
        (RecordId::new(Kind::Note, &id("n0")), Record::Note(Note::new("Look\nhere".to_owned()))),
        (RecordId::new(Kind::Note, &id("n1")), Record::Note(signed)),
        (RecordId::new(Kind::Group, &id("g0")), group(&["s0", "gone"], true)),
        (RecordId::new(Kind::Group, &id("g1")), group(&[], false)),
        (RecordId::pad(), Record::Pad(Pad { tiles: tiles.into() })),
        (RecordId::new(Kind::Place, &id("g0")), place(2.0)),
        (RecordId::new(Kind::Place, &id("n0")), place(1.0)),
        (RecordId::new(Kind::Place, &id("s0")), place(0.1)),
        (RecordId::new(Kind::Place, &id("gone")), place(3.0)),
    ];
    Behaviour { records: records.into() }
}

#[test]
fn under_the_same_ids_everything_comes_back() {
    let file = BehaviourFile::of(&full(), &[]);
    assert_eq!(file.records(|_| None).unwrap(), full());
    assert_eq!(file.order.len(), 3, "a creation number that is the position is not written: {:?}", file.order);
}

#[test]
fn a_copy_has_new_ids_the_same_order_and_its_notes() {
    let file = BehaviourFile::of(&full(), &[]);
    let copy = file.records(|old| Some(id(&format!("new-{old}")))).unwrap();
    let names: Vec<_> = copy.streams_in_order().into_iter().map(|(_, stream)| stream.name.clone()).collect();
    assert_eq!(names, ["First", "Middle", "Last"]);
    assert!(copy.records.contains_key(&RecordId::new(Kind::Note, &id("new-n0"))));
    assert_eq!(copy.place(&id("new-n0")), Some(Place { x: 1.0, y: -0.5 }));
    let (_, group) = copy.group_of(&id("new-s0")).unwrap();
    assert_eq!((group.streams.len(), group.folded), (1, true), "what is gone stays behind");
    assert_eq!(copy.place(&id("new-g0")).unwrap().x.to_bits(), 2.0_f64.to_bits());
    assert_eq!(copy.settings().unwrap().exercise.as_deref(), Some("Near"));
    assert_eq!(copy.connector(&id("new-c0")).unwrap().inputs, [id("new-s1")]);
    let tiles = &copy.pad().unwrap().tiles;
    assert!(matches!(&tiles[&3].does, TileAction::Pretend { stream, .. } if *stream == id("new-s2")));
    assert_eq!(tiles.keys().collect::<Vec<_>>(), [&1, &3, &9], "a tile of what is gone stays behind");
    assert_eq!(copy.records.len(), full().records.len() - 1, "the place of nothing stays behind");
}

#[test]
fn creation_numbers_that_contradict_the_file_are_refused() {
    let mut file = BehaviourFile::of(&full(), &[]);
    file.order.insert("s2".to_owned(), 99);
    let faults = file.records(|_| None).unwrap_err();
    let faults: Vec<_> = faults.iter().map(ToString::to_string).collect();
    assert_eq!(faults, ["s0: its order 5 comes before 99, the one above it; leave order out of the file"]);
    file.order = [("nobody".to_owned(), 1)].into();
    assert_eq!(file.records(|_| None).unwrap_err().len(), 1);
}

#[test]
fn an_id_names_one_thing() {
    let mut file = BehaviourFile::of(&full(), &[]);
    file.notes[0].id = "c0".to_owned();
    let twice = Flaw { at: "c0".to_owned(), kind: FlawKind::IdTwice };
    assert_eq!(file.records(|_| None).unwrap_err(), [twice]);
}

#[test]
fn a_stream_is_in_one_group_of_a_file() {
    let mut file = BehaviourFile::of(&full(), &[]);
    file.groups[1].streams = vec!["s1".to_owned(), "s0".to_owned()];
    let twice = Flaw { at: "g1".to_owned(), kind: FlawKind::InTwoGroups("s0".to_owned()) };
    assert_eq!(file.records(|_| None).unwrap_err(), [twice]);
}

#[test]
fn what_stands_around_the_graph_does_not_change_how_it_runs() {
    let (with, mut without) = (full(), full());
    without.records.retain(|id, _| !matches!(id.kind, Kind::Group | Kind::Note | Kind::Place | Kind::Pad));
    assert_eq!(BehaviourFile::of(&with, &[]).fingerprint(), BehaviourFile::of(&without, &[]).fingerprint());
}

#[test]
fn a_tile_is_one_thing_under_a_key_of_its_own() {
    let broken: [fn(&mut Vec<FileTile>); 6] = [
        |tiles| tiles[0].key = 3,
        |tiles| tiles[0].key = 10,
        |tiles| tiles[0].word = Some("word".to_owned()),
        |tiles| tiles[0].device = None,
        |tiles| tiles[1].params = Some(Params::new()),
        |tiles| tiles[3].value = Some(Value::Int(1)),
    ];
    for (at, break_it) in broken.into_iter().enumerate() {
        let mut file = BehaviourFile::of(&full(), &[]);
        break_it(file.pad.as_mut().unwrap());
        let flaws = file.records(|_| None).unwrap_err();
        assert!(matches!(&flaws[..], [Flaw { kind: FlawKind::Tile, .. }]), "{at}: {flaws:?}");
    }
}

#[test]
fn a_behaviour_without_a_pad_is_written_as_it_always_was() {
    let mut plain = full();
    plain.records.remove(&RecordId::pad());
    let text = serde_json::to_string(&BehaviourFile::of(&plain, &[])).unwrap();
    assert!(!text.contains("pad"), "{text}");
    let file: BehaviourFile = serde_json::from_str(&text).unwrap();
    assert_eq!(file.records(|_| None).unwrap(), plain);
}
