//! Tests that everything is read as it was written: every kind of record, every number, every text.

use crate::samples::{id, now, save};
use crate::shared;
use behaviour::{
    Connector, Declared, Engine, Group, Helper, Kind, Note, Operation, Pad, Parameters, Place, Procedure, Record,
    RecordId, Settings, Stream, StreamKind, Tile, TileAction, Unit, Value, connectors,
};
use std::collections::BTreeSet;
use store::LIBRARY;

const HOSTILE: &str = "\u{0} \"'`\\ ${x} $id \n\r\t مرحبا 赤いボール 👩‍🔬 \u{10FFFF} \u{FEFF}";

fn texts() -> Option<Vec<String>> {
    Some(vec![String::new(), HOSTILE.to_owned()])
}

fn streams() -> Vec<(RecordId, Record)> {
    let params = [
        ("floats", Value::list([0.1, -0.0, 5e-324, f64::MAX, f64::MIN_POSITIVE, 1.0].map(Value::Float))),
        ("whole", Value::list([i64::MIN, -1, 0, i64::MAX].map(Value::Int))),
        (HOSTILE, Value::object([("", Value::Null), ("x", Value::Bool(true)), ("text", Value::text(HOSTILE))])),
    ];
    let plain = Stream {
        kind: StreamKind::Sensor,
        name: HOSTILE.to_owned(),
        device: Some(String::new()),
        params: params.map(|(name, value)| (name.to_owned(), value)).into(),
        order: i64::MIN,
        resources: texts(),
        priority: Some(i64::MAX),
        hold_ms: Some(u64::MAX),
    };
    let empty =
        Stream { resources: Some(Vec::new()), hold_ms: Some(i64::MAX as u64), order: i64::MAX, ..plain.clone() };
    let least = Stream {
        kind: StreamKind::Ordinary,
        name: String::new(),
        device: None,
        params: Default::default(),
        order: 0,
        resources: None,
        priority: None,
        hold_ms: None,
    };
    [("s0", plain), ("s1", empty), ("s2", least)]
        .map(|(key, stream)| (RecordId::new(Kind::Stream, &id(key)), Record::Stream(stream)))
        .into()
}

/// A value in which every kind and hard numbers and texts occur.
fn start() -> Value {
    let numbers = Value::list([Value::Float(-0.0), Value::Float(5e-324), Value::Int(i64::MIN), Value::Null]);
    Value::object([(HOSTILE, numbers), ("text", Value::text(HOSTILE)), ("truth", Value::Bool(true))])
}

fn started(procedure: Procedure, start: Value) -> Operation {
    connectors::scan::SPEC.with(Parameters { start: Some(start), ..procedure.into() })
}

fn connectors() -> Vec<(RecordId, Record)> {
    let body = |args| Procedure::Body { body: HOSTILE.to_owned(), args };
    let operations = [
        connectors::map::SPEC.with(body(None)),
        connectors::map::SPEC.with(body(Some(Vec::new()))),
        connectors::filter::SPEC.with(body(texts())),
        connectors::filter::SPEC.with(Procedure::Helper(HOSTILE.to_owned())),
        connectors::map::SPEC.with(Procedure::Helper(String::new())),
        connectors::timestamp::SPEC.with(()),
        connectors::sample::SPEC.with(Parameters::period(u64::MAX)),
        connectors::sample::SPEC.with(Parameters::period(0)),
        connectors::combine_latest::SPEC.with(body(texts())),
        connectors::combine_latest::SPEC.with(Procedure::Helper("near".to_owned())),
        connectors::merge::SPEC.with(()),
        connectors::subscribe::SPEC.with(()),
        connectors::distinct::SPEC.with(()),
        connectors::distinct::SPEC.with(body(texts())),
        connectors::distinct::SPEC.with(Procedure::Helper(HOSTILE.to_owned())),
        started(body(None), Value::Null),
        started(Procedure::Helper("near".to_owned()), start()),
        connectors::debounce::SPEC.with(Parameters::period(u64::MAX)),
        connectors::delay::SPEC.with(Parameters::period(1)),
        connectors::with_latest::SPEC.with(body(Some(Vec::new()))),
        connectors::with_latest::SPEC.with(Procedure::Helper("near".to_owned())),
    ];
    assert!(connectors::ALL.iter().all(|spec| operations.iter().any(|operation| operation.spec() == *spec)));
    let inputs: [&[&str]; 3] = [&["s0"], &["s1", "s0", "s1"], &[]];
    let all = operations.iter().flat_map(|operation| inputs.map(|inputs| (operation.clone(), inputs)));
    let connector = |(number, (operation, inputs)): (usize, (Operation, &[&str]))| {
        let inputs = inputs.iter().map(|input| id(input)).collect();
        let connector = Connector { operation, inputs, output: id("s2"), order: -(number as i64) };
        (RecordId::new(Kind::Connector, &id(&format!("c{number}"))), Record::Connector(connector))
    };
    all.enumerate().map(connector).collect()
}

fn others() -> Vec<(RecordId, Record)> {
    let settings = Settings {
        name: HOSTILE.to_owned(),
        robot: String::new(),
        engine: Engine::Frame { frame_ms: u64::MAX },
        tags: vec![HOSTILE.to_owned(), String::new()],
        exercise: Some(HOSTILE.to_owned()),
    };
    let streams = BTreeSet::from([id("s0"), id("gone")]);
    let group = |streams, folded| Record::Group(Group { title: HOSTILE.to_owned(), streams, folded });
    let signed = Note { text: HOSTILE.to_owned(), by: HOSTILE.to_owned(), at_ms: u64::MAX };
    let does = TileAction::Word { word: HOSTILE.to_owned(), span: true };
    let pad = Pad { tiles: [(1, Tile { label: HOSTILE.to_owned(), does, asks: false })].into() };
    let place = |x, y| Record::Place(Place { x, y });
    vec![
        (RecordId::settings(), Record::Settings(settings)),
        (RecordId::pad(), Record::Pad(pad)),
        (RecordId::new(Kind::Place, &id("s0")), place(-0.0, 5e-324)),
        (RecordId::new(Kind::Place, &id("nothing")), place(f64::MAX, 42.699_999_999_999_996)),
        (RecordId::new(Kind::Note, &id("s0")), Record::Note(Note::new(HOSTILE.to_owned()))),
        (RecordId::new(Kind::Note, &id("signed")), Record::Note(signed)),
        (RecordId::new(Kind::Group, &id("s0")), group(streams, true)),
        (RecordId::new(Kind::Group, &id("empty")), group(BTreeSet::new(), false)),
        (RecordId::new(Kind::Note, &id("empty")), Record::Note(Note::new(String::new()))),
    ]
}

#[tokio::test(flavor = "multi_thread")]
async fn every_record_reads_back_as_it_was() {
    let Some(neo4j) = shared::alone("exact records").await else { return };
    let store = neo4j.empty_store().await;
    let records = [streams(), connectors(), others()].concat();
    save(&store, "a", "op1", records.clone()).await;
    let loaded = now(&store, "a").await.records;
    for (key, record) in &records {
        assert_eq!(loaded.get(key), Some(record), "{key}");
    }
    assert_eq!(loaded.len(), records.len());
    let bits = |place: Option<Place>| place.map(|place| (place.x.to_bits(), place.y.to_bits()));
    let placed = now(&store, "a").await.place(&id("s0"));
    assert_eq!(bits(placed), Some(((-0.0_f64).to_bits(), 5e-324_f64.to_bits())));
    save(&store, "a", "op2", records).await;
    assert_eq!(now(&store, "a").await.records, loaded, "writing the same again changes nothing");
}

#[tokio::test(flavor = "multi_thread")]
async fn helpers_read_back_as_they_were() {
    let Some(neo4j) = shared::alone("exact helpers").await else { return };
    let store = neo4j.empty_store().await;
    let helper = |params: Vec<String>, says: &str| {
        let (name, body, says) = ("near".to_owned(), HOSTILE.to_owned(), says.to_owned());
        let takes = vec![Declared::In(Unit::MetresPerSecond); usize::from(params.len() > 1)];
        let gives = if takes.is_empty() { Declared::Auto } else { Declared::Face };
        Record::Helper(Helper { name, params, body, says, takes, gives })
    };
    let records = vec![
        (RecordId::new(Kind::Helper, &id("h1")), helper(Vec::new(), "")),
        (RecordId::new(Kind::Helper, &id("h2")), helper(vec![HOSTILE.to_owned(), String::new()], HOSTILE)),
    ];
    save(&store, LIBRARY, "op1", records.clone()).await;
    assert_eq!(now(&store, LIBRARY).await.records, records.into_iter().collect());
}
