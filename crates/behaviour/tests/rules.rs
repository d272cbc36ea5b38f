//! Every rule of the graph: what breaks it is refused with one sentence, and nothing changes.

use behaviour::{
    Behaviour, BehaviourFile, Change, Connector, Decision, Group, Id, Kind, Knowledge, Note, Operation, Pad,
    Parameters, Params, Procedure, Record, RecordId, Refusal, Room, Settings, Stream, StreamKind, TILE_MAX_BYTES,
    TILE_MAX_CHARS, Tile, TileAction, Value, connectors, problems,
};

struct Anything;
impl Knowledge for Anything {
    fn device(&self, _: StreamKind, device: &str, _: &Params) -> Result<(), phrase::Phrase> {
        if device == "Nothing" { Err("there is no sense called “Nothing”".into()) } else { Ok(()) }
    }
    fn body(&self, _: &[String], body: &str) -> Result<(), phrase::Phrase> {
        if body.contains("((") { Err("at character 2: a closing ) is missing".into()) } else { Ok(()) }
    }
}

fn id(text: &str) -> Id {
    Id::new(text).expect("a short id")
}

fn stream(kind: StreamKind, name: &str) -> Record {
    let device = (kind != StreamKind::Ordinary).then(|| "RedBall".to_owned());
    let (params, order) = (Params::new(), 0);
    Record::Stream(Stream {
        kind,
        name: name.into(),
        device,
        params,
        order,
        resources: None,
        priority: None,
        hold_ms: None,
    })
}

fn connector(operation: Operation, inputs: &[&str], output: &str) -> Record {
    Record::Connector(Connector {
        operation,
        inputs: inputs.iter().map(|i| id(i)).collect(),
        output: id(output),
        order: 1,
    })
}

fn map(body: &str) -> Operation {
    connectors::map::SPEC.with(Procedure::body(body))
}

/// Ball -> Distance -> Close, and an action.
fn start() -> Behaviour {
    let mut behaviour = Behaviour::default();
    let mut put = |kind, name: &str, record| behaviour.records.insert(RecordId::new(kind, &id(name)), record);
    put(Kind::Settings, "behaviour", Record::Settings(Settings::named("Test")));
    put(Kind::Stream, "ball", stream(StreamKind::Sensor, "Ball"));
    put(Kind::Stream, "distance", stream(StreamKind::Ordinary, "Distance"));
    put(Kind::Stream, "close", stream(StreamKind::Ordinary, "Close"));
    put(Kind::Stream, "tracker", stream(StreamKind::Actuator, "Tracker"));
    put(Kind::Connector, "c1", connector(map("ball.size"), &["ball"], "distance"));
    put(Kind::Connector, "c2", connector(map("distance"), &["distance"], "close"));
    behaviour
}

/// A record and what becomes of it.
type Touched<'a> = (Kind, &'a str, Option<Record>);

fn propose(edits: &[Touched]) -> Decision {
    let room = Room::open(start(), 7);
    let mut change = Change::of(id("op"), "Aiko", "Test");
    for (kind, name, after) in edits {
        let key = RecordId::new(*kind, &id(name));
        change = match after {
            Some(record) => change.put(room.behaviour(), key, record.clone()),
            None => change.take(room.behaviour(), key),
        };
    }
    let decision = room.propose(1, change, &Anything);
    assert_eq!(room.behaviour(), &start(), "proposing changes nothing");
    decision
}

#[test]
fn each_broken_rule_is_refused_with_its_sentence() {
    use StreamKind::{Actuator, Ordinary, Sensor};
    let sub = connectors::subscribe::SPEC.with(());
    let new = |operation: Operation, inputs: &[&str], output: &str| {
        (Kind::Connector, "c9", Some(connector(operation, inputs, output)))
    };
    let put = |name: &'static str, record| (Kind::Stream, name, Some(record));
    let sample = |period_ms| connectors::sample::SPEC.with(Parameters::period(period_ms));
    let cases: Vec<(Touched, &str)> = vec![
        (new(map(""), &["close"], "distance"), "already gets its values"),
        (new(map(""), &["ball"], "tracker"), "Only subscribe"),
        (new(sub.clone(), &["ball"], "close"), "must lead to an action"),
        (new(map(""), &["tracker"], "close"), "nothing can come out"),
        (new(map(""), &["close"], "ball"), "cannot take values"),
        (new(map("(("), &["close"], "tracker"), "closing ) is missing"),
        (new(connectors::merge::SPEC.with(()), &["ball", "ball"], "close"), "chosen twice"),
        (new(sample(0), &["close"], "tracker"), "from 1 millisecond to 1 hour"),
        (new(sample(3_600_001), &["close"], "tracker"), "from 1 millisecond to 1 hour"),
        (new(sub, &["ball", "close"], "tracker"), "exactly one stream"),
        (new(map(""), &["nobody"], "close"), "without a stream"),
        ((Kind::Stream, "close", None), "without a stream"),
        (put("x", stream(Ordinary, "Distance")), "already a “Distance”"),
        (put("x", stream(Ordinary, " ")), "cannot be a name"),
        (put("x", stream(Sensor, &"n".repeat(9_000))), "too long"),
        (put("x", stream(Ordinary, "tab\there")), "cannot be a name"),
        ((Kind::Settings, "behaviour", None), "damaged"),
        ((Kind::Stream, "x", Some(connector(map(""), &["ball"], "close"))), "damaged"),
    ];
    for (edit, words) in cases {
        let shown = format!("{edit:?}");
        let Decision::Refuse(refusal) = propose(&[edit]) else { panic!("accepted {shown}") };
        let sentence = refusal.to_string();
        assert!(sentence.contains(words), "{shown}\n{sentence}");
        assert!(sentence.ends_with('.') && sentence.starts_with(|c: char| c.is_uppercase() || c == '“'), "{sentence}");
    }
    let unknown = Record::Stream(Stream { device: Some("Nothing".into()), ..stream_of(stream(Actuator, "X")) });
    assert!(matches!(propose(&[put("x", unknown)]), Decision::Refuse(Refusal::Device(_))));
}

fn stream_of(record: Record) -> Stream {
    let Record::Stream(stream) = record else { panic!("a stream") };
    stream
}

#[test]
fn a_cycle_is_refused_in_one_change_or_two() {
    let back = (Kind::Connector, "c9", Some(connector(connectors::merge::SPEC.with(()), &["close"], "loop")));
    let stream = (Kind::Stream, "loop", Some(stream(StreamKind::Ordinary, "Loop")));
    let join =
        (Kind::Connector, "c1", Some(connector(connectors::merge::SPEC.with(()), &["ball", "loop"], "distance")));
    assert!(matches!(propose(&[stream.clone(), back.clone()]), Decision::Save(_)));
    assert!(matches!(propose(&[stream, back, join]), Decision::Refuse(Refusal::Cycle(_))));
}

#[test]
fn an_incomplete_graph_may_be_saved_and_is_shown_as_a_problem() {
    let edits = [
        (Kind::Stream, "sum", Some(stream(StreamKind::Ordinary, "Sum"))),
        (
            Kind::Connector,
            "c9",
            Some(connector(connectors::combine_latest::SPEC.with(Procedure::body("")), &[], "sum")),
        ),
        (
            Kind::Connector,
            "c2",
            Some(connector(connectors::map::SPEC.with(Procedure::Helper("gone".into())), &["distance"], "close")),
        ),
    ];
    let Decision::Save(saved) = propose(&edits) else { panic!("refused") };
    let mut room = Room::open(start(), 7);
    room.commit(&saved);
    let found = problems(room.behaviour(), &[], &Anything);
    let sentences: Vec<String> = found.iter().filter(|p| p.blocks).map(ToString::to_string).collect();
    assert_eq!(
        sentences,
        ["The helper “gone” does not exist. Choose another or add it.", "CombineLatest has no input streams. Add one."]
    );
}

#[test]
fn a_stale_edit_is_refused_and_names_the_thing() {
    let mut room = Room::open(start(), 7);
    let key = RecordId::new(Kind::Stream, &id("ball"));
    let rename = |room: &Room, op: &str, name: &str| {
        Change::of(id(op), "Aiko", "Rename").put(room.behaviour(), key.clone(), stream(StreamKind::Sensor, name))
    };
    let (mine, yours) = (rename(&room, "a", "Mine"), rename(&room, "b", "Yours"));
    let Decision::Save(saved) = room.propose(5, mine.clone(), &Anything) else { panic!("refused") };
    assert_eq!((saved.revision, saved.change.at_ms), (8, 5));
    room.commit(&saved);
    assert_eq!(room.propose(6, mine, &Anything), Decision::Duplicate(8));
    assert_eq!(room.propose(6, yours, &Anything), Decision::Refuse(Refusal::Stale("“Mine”".into())));
}

#[test]
fn a_file_round_trip_loses_nothing_and_keeps_the_order() {
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/gold")).unwrap() {
        let path = entry.unwrap().path().join("behaviour.json");
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let file: BehaviourFile = serde_json::from_str(&text).unwrap();
        let behaviour = file.records(|_| None).unwrap();
        let library = file.library();
        let mut again = BehaviourFile::of(&behaviour, &library.iter().collect::<Vec<_>>());
        assert_eq!(again.records(|_| None).unwrap(), behaviour, "{path:?}");
        again.helpers.sort_by_key(|helper| file.helpers.iter().position(|h| h.name == helper.name));
        let plain = |file: &BehaviourFile| {
            let mut file = file.clone();
            file.streams.iter_mut().for_each(|stream| drop(stream.params.take_if(|params| params.is_empty())));
            file
        };
        assert_eq!(plain(&again), plain(&file), "{path:?}");
    }
}

#[test]
fn a_file_with_faults_says_which() {
    let text = r#"{"format":"rrp-behaviour/1","name":"x","helpers":[],"streams":[{"id":"a","kind":"sensor","name":"A"},
        {"id":"a","kind":"ordinary","name":"B"}],"connectors":[{"id":"c","type":"fly","inputs":["a"],"output":"zz"}]}"#;
    let file: BehaviourFile = serde_json::from_str(text).unwrap();
    let faults = file.records(|_| None).unwrap_err();
    let faults: Vec<_> = faults.iter().map(ToString::to_string).collect();
    assert_eq!(faults, ["a: this id is used twice", "c: there is no connector \"fly\""]);
    assert!(
        serde_json::from_str::<BehaviourFile>(&text.replace("\"name\":\"x\"", "\"name\":\"x\",\"extra\":1")).is_err()
    );
}

/// A sense, and so many diamonds of two ways each in a row that lead to an action.
fn diamonds(many: usize, way: &Operation) -> Behaviour {
    let mut behaviour = Behaviour::default();
    let mut put = |kind, name: &str, record| behaviour.records.insert(RecordId::new(kind, &id(name)), record);
    put(Kind::Settings, "behaviour", Record::Settings(Settings::named("Test")));
    put(Kind::Stream, "m0", stream(StreamKind::Sensor, "Ball"));
    put(Kind::Stream, "tracker", stream(StreamKind::Actuator, "Tracker"));
    for at in 0..many {
        let [from, left, right, to] = [format!("m{at}"), format!("l{at}"), format!("r{at}"), format!("m{}", at + 1)];
        for name in [&left, &right, &to] {
            put(Kind::Stream, name, stream(StreamKind::Ordinary, &format!("Merged {name}")));
        }
        put(Kind::Connector, &format!("a{at}"), connector(way.clone(), &[&from], &left));
        put(Kind::Connector, &format!("b{at}"), connector(way.clone(), &[&from], &right));
        put(Kind::Connector, &format!("c{at}"), connector(connectors::merge::SPEC.with(()), &[&left, &right], &to));
    }
    put(Kind::Connector, "last", connector(connectors::subscribe::SPEC.with(()), &[&format!("m{many}")], "tracker"));
    behaviour
}

#[test]
fn values_that_multiply_are_a_problem_and_where_filters_choose_a_hint() {
    let said = |behaviour: &Behaviour| {
        let found = problems(behaviour, &[], &Anything);
        found
            .iter()
            .filter(|one| one.to_string().contains("multiply"))
            .map(|one| (one.to_string(), one.blocks))
            .next_back()
    };
    let rest = "Lead fewer ways of the same stream together there, or put a sample before it.";
    let sure = format!("Values multiply at “Merged m15”: one reading becomes more than 100,000 values. {rest}");
    assert_eq!(said(&diamonds(60, &map("ball"))), Some((sure, true)));
    let filter = connectors::filter::SPEC.with(Procedure::body("true"));
    let perhaps = format!("Values multiply at “Merged m15”: one reading can become more than 100,000 values. {rest}");
    assert_eq!(said(&diamonds(60, &filter)), Some((perhaps, false)));
    assert_eq!(said(&diamonds(60, &connectors::sample::SPEC.with(Parameters::period(10)))), None);
    assert_eq!(said(&diamonds(10, &map("ball"))), None);
    let mut frames = diamonds(60, &map("ball"));
    let settings = Settings { engine: behaviour::Engine::Frame { frame_ms: 50 }, ..Settings::named("Test") };
    frames.records.insert(RecordId::settings(), Record::Settings(settings));
    assert_eq!(said(&frames), None, "a frame carries one value a stream");
}

#[test]
fn tags_are_few_short_and_different() {
    let settled = |tags: &[&str]| {
        let tags = tags.iter().map(|tag| (*tag).to_owned()).collect();
        let settings = Settings { tags, ..Settings::named("Test") };
        match propose(&[(Kind::Settings, "behaviour", Some(Record::Settings(settings)))]) {
            Decision::Refuse(no) => no.to_string(),
            _ => String::new(),
        }
    };
    let longest = "あ".repeat(behaviour::TAG_MAX_CHARS);
    assert_eq!(settled(&["group b", "赤", longest.as_str(), "it's 100%"]), "");
    let nine: Vec<String> = (0..9).map(|at| format!("t{at}")).collect();
    let nine: Vec<&str> = nine.iter().map(String::as_str).collect();
    assert_eq!(settled(&nine[..8]), "");
    assert_eq!(settled(&nine), "A program holds at most 8 tags. Remove some first.");
    assert_eq!(settled(&[&format!("{longest}あ")]), "This tag is too long. It may have 24 characters.");
    assert_eq!(settled(&["Ball", "ball"]), "There is already a “ball”. Choose another name.");
    for bad in ["", " ", " a", "a ", "a\nb", "a\u{202e}b"] {
        assert_ne!(settled(&[bad]), "", "{bad:?}");
    }
}

#[test]
fn settings_of_before_tags_still_read() {
    let settings: Settings = serde_json::from_str(r#"{"name":"Old","robot":"nao"}"#).expect("settings");
    assert_eq!(settings, Settings::named("Old"));
    assert!(!serde_json::to_string(&settings).expect("a text").contains("tags"), "and are written as they were");
}

fn group(title: &str, streams: &[&str]) -> Option<Record> {
    let streams = streams.iter().map(|stream| id(stream)).collect();
    Some(Record::Group(Group { title: title.into(), streams, folded: false }))
}

#[test]
fn a_stream_is_in_one_group_at_most() {
    let one = (Kind::Group, "g", group("Near", &["ball", "gone"]));
    assert!(matches!(propose(&[one.clone(), (Kind::Group, "h", group("Near", &[]))]), Decision::Save(_)));
    let Decision::Refuse(refusal) = propose(&[one, (Kind::Group, "h", group("Far", &["ball"]))]) else { panic!() };
    assert_eq!(refusal, Refusal::InGroup { stream: "Ball".into(), group: "Near".into() });
    assert_eq!(refusal.to_string(), "“Ball” is in the group “Near” already. Take it out there first.");
    for title in ["", " ", "a\u{7}", "a\u{202e}b", &"x".repeat(201)] {
        assert!(matches!(propose(&[(Kind::Group, "g", group(title, &[]))]), Decision::Refuse(_)), "{title:?}");
    }
}

#[test]
fn a_stream_of_a_group_can_go_and_is_in_it_again_when_it_comes_back() {
    let mut room = Room::open(start(), 7);
    let mut make = |op: &str, edits: &[Touched]| {
        let change = edits.iter().fold(Change::of(id(op), "Aiko", "Test"), |change, (kind, name, after)| {
            let key = RecordId::new(*kind, &id(name));
            match after {
                Some(record) => change.put(room.behaviour(), key, record.clone()),
                None => change.take(room.behaviour(), key),
            }
        });
        let Decision::Save(made) = room.propose(1, change, &Anything) else { panic!("{op}") };
        room.commit(&made);
        (made.change, room.clone())
    };
    make("group", &[(Kind::Group, "g", group("Near", &["close", "tracker"]))]);
    let (removal, room) = make("remove", &[(Kind::Stream, "close", None), (Kind::Connector, "c2", None)]);
    assert_eq!(room.behaviour().groups().next().unwrap().1.streams.len(), 2);
    let back = room.bring_back(&removal, Change::of(id("back"), "Aiko", "Back"), &Anything).unwrap().unwrap();
    let mut whole = room.behaviour().clone();
    whole.apply(&back);
    assert_eq!(whole.group_of(&id("close")).map(|(id, _)| id.as_str()), Some("g"));
}

#[test]
fn who_wrote_a_note_and_when_is_bounded() {
    let note = |by: &str, at_ms| Some(Record::Note(Note { text: "Look".into(), by: by.into(), at_ms }));
    let proposed = |note| propose(&[(Kind::Note, "n", note)]);
    assert!(matches!(proposed(note("Aiko", 1_700_000_000_000)), Decision::Save(_)));
    assert!(matches!(proposed(note(&"x".repeat(201), 0)), Decision::Refuse(Refusal::TooLong(_, 200))));
    assert!(matches!(proposed(note("", u64::MAX)), Decision::Refuse(Refusal::Malformed(_))));
}

#[test]
fn two_names_that_look_the_same_are_one() {
    let (composed, decomposed) = ("B\u{e9}l", "Be\u{301}l");
    let put = |behaviour: &Behaviour, at: &str, name: &str| {
        let change = Change::of(id(at), "Aiko", "Add");
        change.put(behaviour, RecordId::new(Kind::Stream, &id(at)), stream(StreamKind::Sensor, name))
    };
    let mut room = Room::open(start(), 1);
    let first = put(room.behaviour(), "one", composed);
    let Decision::Save(made) = room.propose(0, first, &Anything) else { panic!("a first one") };
    room.commit(&made);
    let twin = put(room.behaviour(), "two", decomposed);
    let Decision::Refuse(no) = room.propose(0, twin, &Anything) else { panic!("a twin") };
    assert_eq!(no.to_string(), format!("There is already a “{composed}”. Choose another name."));
}

#[test]
fn twins_of_before_stay_until_one_is_changed() {
    let mut before = start();
    for (at, name) in [("one", "B\u{e9}l"), ("two", "Be\u{301}l")] {
        before.records.insert(RecordId::new(Kind::Stream, &id(at)), stream(StreamKind::Sensor, name));
    }
    let room = Room::open(before.clone(), 1);
    let other = Change::of(id("x"), "Aiko", "Rename");
    let other = other.put(&before, RecordId::new(Kind::Stream, &id("one")), stream(StreamKind::Sensor, "Bell"));
    assert!(matches!(room.propose(0, other, &Anything), Decision::Save(_)));
}

fn pad(key: u8, label: &str, does: TileAction) -> Option<Record> {
    Some(Record::Pad(Pad { tiles: [(key, Tile { label: label.to_owned(), does, asks: false })].into() }))
}

#[test]
fn a_behaviour_has_one_pad_of_nine_tiles_that_can_be_pressed() {
    let word = |word: &str| TileAction::Word { word: word.to_owned(), span: false };
    let hand = |device: &str, value: Value| {
        let (device, params) = (device.to_owned(), Params::new());
        TileAction::Hand { device, params, value }
    };
    let pretend = |stream: &str| TileAction::Pretend { stream: id(stream), value: Value::Int(1) };
    let answer = |name: &str, record| match propose(&[(Kind::Pad, name, record)]) {
        Decision::Refuse(refusal) => Err(refusal),
        _ => Ok(()),
    };
    for does in [word("smile"), hand("Walk", Value::Null), pretend("ball"), pretend("close"), pretend("gone")] {
        assert_eq!(answer("pad", pad(9, "Press", does.clone())), Ok(()), "{does:?}");
    }
    assert_eq!(answer("pad", Some(Record::Pad(Pad::default()))), Ok(()), "one without tiles");
    let refused = |name, record| answer(name, record).unwrap_err();
    assert!(matches!(refused("other", pad(1, "Press", word("smile"))), Refusal::Malformed(_)));
    for key in [0, 10] {
        assert!(matches!(refused("pad", pad(key, "Press", word("smile"))), Refusal::Malformed(_)));
    }
    for text in ["", " ", "a\u{7}"] {
        assert!(
            matches!(refused("pad", pad(1, text, word("smile"))), Refusal::Name(_) | Refusal::Unseen(_)),
            "{text:?}"
        );
        assert!(
            matches!(refused("pad", pad(1, "Press", word(text))), Refusal::Name(_) | Refusal::Unseen(_)),
            "{text:?}"
        );
    }
    let long = "x".repeat(TILE_MAX_CHARS + 1);
    assert_eq!(
        refused("pad", pad(1, &long, word("smile"))),
        Refusal::TooLong(phrase::phrase!("limited.tile_label", "this label"), 40)
    );
    assert_eq!(
        refused("pad", pad(1, "Press", word(&long))),
        Refusal::TooLong(phrase::phrase!("limited.tile_word", "this word"), 40)
    );
    let large = Value::text("x".repeat(TILE_MAX_BYTES));
    assert_eq!(refused("pad", pad(1, "Press", hand("Walk", large))), Refusal::TooLarge("this tile".into()));
    assert_eq!(refused("pad", pad(1, "Press", hand("Walk", f64::NAN.into()))), Refusal::Infinite);
    let asks = |does| {
        let tile = Tile { label: "Press".to_owned(), does, asks: true };
        Some(Record::Pad(Pad { tiles: [(1, tile)].into() }))
    };
    assert_eq!(answer("pad", asks(hand("Walk", Value::Null))), Ok(()), "an action may ask first");
    assert!(matches!(refused("pad", asks(word("smile"))), Refusal::Malformed(_)), "a moment is marked at once");
}

#[test]
fn a_pad_reads_as_it_is_written_also_within_a_message_that_is_looked_into() {
    #[derive(serde::Deserialize)]
    #[serde(tag = "is")]
    enum Asked {
        Put { record: Record },
    }
    let record = pad(7, "Press", TileAction::Word { word: "smile".into(), span: true }).unwrap();
    let text = serde_json::to_string(&record).unwrap();
    assert_eq!(text, r#"{"pad":{"7":{"label":"Press","does":{"word":{"word":"smile","span":true}}}}}"#);
    let Asked::Put { record: read } = serde_json::from_str(&format!(r#"{{"is":"Put","record":{text}}}"#)).unwrap();
    assert_eq!(read, record);
}
