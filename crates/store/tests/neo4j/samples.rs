//! Things to put into the store.

use behaviour::{
    Behaviour, Change, Committed, Connector, Helper, Id, Kind, Operation, Place, Procedure, Record, RecordId, Settings,
    Stream, StreamKind, connectors,
};
use store::{Append, Store, StoreError};

pub(crate) fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

pub(crate) fn settings(name: &str) -> (RecordId, Record) {
    (RecordId::settings(), Record::Settings(Settings::named(name)))
}

/// A stream; its kind is that of its device's word, `sensor:RedBall` or `actuator:Tracker`.
pub(crate) fn stream(key: &str, name: &str, device: &str) -> (RecordId, Record) {
    let (kind, device) = match device.split_once(':') {
        Some(("sensor", device)) => (StreamKind::Sensor, Some(device.to_owned())),
        Some((_, device)) => (StreamKind::Actuator, Some(device.to_owned())),
        None => (StreamKind::Ordinary, None),
    };
    let (params, name) = (Default::default(), name.to_owned());
    let stream = Stream { kind, name, device, params, order: 0, resources: None, priority: None, hold_ms: None };
    (RecordId::new(Kind::Stream, &id(key)), Record::Stream(stream))
}

pub(crate) fn connector(key: &str, operation: Operation, inputs: &[&str], output: &str) -> (RecordId, Record) {
    let inputs = inputs.iter().map(|input| id(input)).collect();
    let connector = Connector { operation, inputs, output: id(output), order: 0 };
    (RecordId::new(Kind::Connector, &id(key)), Record::Connector(connector))
}

pub(crate) fn place(key: &str, x: f64, y: f64) -> (RecordId, Record) {
    (RecordId::new(Kind::Place, &id(key)), Record::Place(Place { x, y }))
}

pub(crate) fn helper(key: &str, name: &str, body: &str) -> (RecordId, Record) {
    let (name, params, body) = (name.to_owned(), vec!["x".to_owned()], body.to_owned());
    (RecordId::new(Kind::Helper, &id(key)), Record::Helper(Helper { name, params, body, ..Helper::default() }))
}

pub(crate) fn named(helper: &str) -> Procedure {
    Procedure::Helper(helper.to_owned())
}

/// A ball is seen, mapped by a helper, filtered by a body, combined with itself, and followed.
pub(crate) fn follow(name: &str) -> Vec<(RecordId, Record)> {
    vec![
        settings(name),
        stream("ball", "Red ball", "sensor:RedBall"),
        stream("distance", "Distance", ""),
        stream("near", "Near", ""),
        stream("both", "Both", ""),
        stream("head", "Head", "actuator:Tracker"),
        connector("c1", connectors::map::SPEC.with(named("distance")), &["ball"], "distance"),
        connector("c2", connectors::filter::SPEC.with(Procedure::body("distance < 20")), &["distance"], "near"),
        connector(
            "c3",
            connectors::combine_latest::SPEC.with(Procedure::body("[near, redBall]")),
            &["near", "ball"],
            "both",
        ),
        connector("c4", connectors::subscribe::SPEC.with(()), &["both"], "head"),
        place("ball", 1.0, 2.0),
    ]
}

/// A change that makes each record what is said.
pub(crate) fn change(op: &str, now: &Behaviour, edits: Vec<(RecordId, Record)>) -> Change {
    edits.into_iter().fold(Change::of(id(op), "Aiko", "Edit"), |made, (key, record)| made.put(now, key, record))
}

/// Hands over a change as the next one; says what became of it.
pub(crate) async fn next(store: &(impl Store + ?Sized), to: &str, change: Change) -> Result<Append, StoreError> {
    let loaded = store.load(&id(to)).await?;
    let revision = loaded.as_ref().map_or(0, |loaded| loaded.revision) + 1;
    let mut after = loaded.map(|loaded| loaded.behaviour).unwrap_or_default();
    after.apply(&change);
    store.append(&id(to), &Committed { revision, change }, &after).await
}

/// Saves records as the next change.
pub(crate) async fn save(store: &(impl Store + ?Sized), to: &str, op: &str, edits: Vec<(RecordId, Record)>) {
    let made = change(op, &now(store, to).await, edits);
    assert_eq!(next(store, to, made).await, Ok(Append::Applied), "{to} {op}");
}

/// Takes records away as the next change.
pub(crate) async fn take(
    store: &(impl Store + ?Sized),
    from: &str,
    op: &str,
    keys: &[(Kind, &str)],
) -> Result<Append, StoreError> {
    let now = now(store, from).await;
    let start = Change::of(id(op), "Aiko", "Remove");
    let made = keys.iter().fold(start, |made, (kind, key)| made.take(&now, RecordId::new(*kind, &id(key))));
    next(store, from, made).await
}

/// A behaviour as it is.
pub(crate) async fn now(store: &(impl Store + ?Sized), of: &str) -> Behaviour {
    store.load(&id(of)).await.expect("an answer").map(|loaded| loaded.behaviour).unwrap_or_default()
}
