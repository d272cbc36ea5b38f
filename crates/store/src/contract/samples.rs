//! Things to put into a store, and chance that a seed repeats.

use crate::{Append, Query, SearchPlace, Store, StoreError};
use behaviour::{
    Behaviour, Change, Committed, Connector, Group, Helper, Id, Kind, Note, Operation, Pad, Parameters, Procedure,
    Record, RecordId, Settings, Stream, StreamKind, Tile, TileAction, Value, connectors,
};

pub(super) fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

pub(super) fn key(kind: Kind, text: &str) -> RecordId {
    RecordId::new(kind, &id(text))
}

pub(super) fn settings(name: &str) -> Record {
    Record::Settings(Settings::named(name))
}

pub(super) fn note(text: &str) -> Record {
    Record::Note(Note::new(text.to_owned()))
}

/// A folded group of these streams.
pub(super) fn group(title: &str, streams: &[&str]) -> Record {
    let streams = streams.iter().map(|stream| id(stream)).collect();
    Record::Group(Group { title: title.to_owned(), streams, folded: true })
}

/// A pad with a tile of each kind; one stream is gone.
pub(super) fn pad(label: &str) -> Record {
    let tile =
        |label: &str, does| Tile { label: label.to_owned(), asks: matches!(does, TileAction::Hand { .. }), does };
    let params = [("text".to_owned(), "赤 \"x\"".into())].into();
    let tiles = [
        (1, tile(label, TileAction::Hand { device: "SayParameter".to_owned(), params, value: Value::Null })),
        (2, tile(label, TileAction::Pretend { stream: id("gone"), value: 42.699_999_999_999_996.into() })),
        (9, tile(label, TileAction::Word { word: "smile".to_owned(), span: true })),
    ];
    Record::Pad(Pad { tiles: tiles.into() })
}

pub(super) fn stream(name: &str, order: i64) -> Record {
    Record::Stream(Stream {
        kind: StreamKind::Ordinary,
        name: name.to_owned(),
        device: None,
        params: [("gain".to_owned(), 42.699_999_999_999_996.into())].into(),
        order,
        resources: None,
        priority: Some(-3),
        hold_ms: None,
    })
}

pub(super) fn filter(procedure: Procedure) -> Record {
    let operation = connectors::filter::SPEC.with(procedure);
    Record::Connector(Connector { operation, inputs: vec![id("s0")], output: id("s1"), order: 7 })
}

/// Every connector in every form: with what it needs, and with all that it takes, written in place or by a helper.
pub(super) fn every_connector() -> Vec<(RecordId, Record)> {
    let start = Value::object([("x", Value::Float(-0.0)), ("list", Value::list([Value::Null, Value::text("赤")]))]);
    let args = Some(vec!["a".to_owned(), "b".to_owned()]);
    let procedures = [
        None,
        Some(Procedure::body("a > 1 // \"near\"")),
        Some(Procedure::Body { body: String::new(), args }),
        Some(Procedure::Helper("near".to_owned())),
    ];
    let form = |spec: &'static connectors::Spec, procedure: &Option<Procedure>| {
        let (procedure, is_whole) = (procedure.clone(), procedure.is_some());
        let (period_ms, start) = (is_whole.then_some(3_600_000), is_whole.then(|| start.clone()));
        spec.with(Parameters { procedure, period_ms, start })
    };
    let all = connectors::ALL.iter().copied();
    let forms = all.flat_map(|spec| procedures.each_ref().map(|procedure| form(spec, procedure)));
    let connector = |(order, operation): (i64, Operation)| {
        let inputs = if operation.spec().inputs.are_many() { vec![id("s1"), id("s0")] } else { vec![id("s0")] };
        let record = Record::Connector(Connector { operation, inputs, output: id("s1"), order });
        (key(Kind::Connector, &format!("c{order}")), record)
    };
    (0..).zip(forms).map(connector).collect()
}

pub(super) fn helper(name: &str, body: &str) -> Record {
    Record::Helper(Helper {
        name: name.to_owned(),
        params: vec!["x".into()],
        body: body.to_owned(),
        ..Helper::default()
    })
}

/// A change that makes each record what is said, from nothing.
pub(super) fn change(op: &str, at_ms: u64, edits: Vec<(RecordId, Record)>) -> Change {
    let start = Change { at_ms, ..Change::of(id(op), "Aiko", "Edit") };
    edits.into_iter().fold(start, |made, (key, record)| made.put(&Behaviour::default(), key, record))
}

/// Hands over a change under a revision.
pub(super) async fn append(store: &dyn Store, to: &str, revision: u64, change: Change) -> Append {
    try_append(store, to, revision, change).await.expect("the store answers")
}

/// Hands over a change under a revision, or says why the store fails.
pub(super) async fn try_append(
    store: &dyn Store,
    to: &str,
    revision: u64,
    change: Change,
) -> Result<Append, StoreError> {
    let mut after = now(store, to).await;
    after.apply(&change);
    store.append(&id(to), &Committed { revision, change }, &after).await
}

/// A behaviour as it is; empty if there is none.
pub(super) async fn now(store: &dyn Store, of: &str) -> Behaviour {
    store.load(&id(of)).await.expect("the store answers").map(|loaded| loaded.behaviour).unwrap_or_default()
}

/// The names of a page's behaviours.
pub(super) async fn names(store: &dyn Store, query: Query) -> Vec<String> {
    store.list(&query).await.expect("a page").lines.into_iter().map(|line| line.name).collect()
}

/// Asks for the behaviours in the bin.
pub(super) fn in_bin() -> Query {
    Query { place: SearchPlace::Bin, ..Query::default() }
}

/// The two streams that [`filter`] connects.
pub(super) fn two_streams() -> Vec<(RecordId, Record)> {
    ["s0", "s1"].map(|name| (key(Kind::Stream, name), stream(name, 0))).into()
}

/// A sensor, an ordinary and an actuator stream, each leading to the next.
pub(super) fn driving(actuator: &str) -> Vec<(RecordId, Record)> {
    let stream = |kind, name: &str, device: Option<&str>| {
        let Record::Stream(stream) = stream(name, 0) else { unreachable!("a stream is a stream") };
        Record::Stream(Stream { kind, device: device.map(str::to_owned), ..stream })
    };
    let connector = |operation, from: &str, to: &str| {
        Record::Connector(Connector { operation, inputs: vec![id(from)], output: id(to), order: 0 })
    };
    vec![
        (key(Kind::Stream, "in"), stream(StreamKind::Sensor, "Ball", Some("RedBall"))),
        (key(Kind::Stream, "mid"), stream(StreamKind::Ordinary, "Near", None)),
        (key(Kind::Stream, "out"), stream(StreamKind::Actuator, "Look", Some(actuator))),
        (key(Kind::Connector, "c1"), connector(connectors::merge::SPEC.with(()), "in", "mid")),
        (key(Kind::Connector, "c2"), connector(connectors::subscribe::SPEC.with(()), "mid", "out")),
    ]
}

/// Saves what is said as the next revision.
pub(super) async fn save(store: &dyn Store, to: &str, op: &str, edits: Vec<(RecordId, Record)>) {
    let head = store.load(&id(to)).await.expect("the store answers").map_or(0, |loaded| loaded.revision);
    assert_eq!(append(store, to, head + 1, change(op, head + 1, edits)).await, Append::Applied, "{to} {op}");
}

/// Numbers that look like chance and repeat with the seed (SplitMix64).
pub(super) struct Chance(pub(super) u64);

impl Chance {
    /// A number below `end`.
    pub(super) fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (mixed ^ (mixed >> 31)) % end
    }
}
