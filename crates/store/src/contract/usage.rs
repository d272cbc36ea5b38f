//! The uses of a helper: by name, in bodies, in other helpers; nowhere else.

use super::samples::{append, filter, helper, id, key, note, save, settings, two_streams};
use crate::{LIBRARY, Store};
use behaviour::{Change, Connector, Kind, Procedure, Record, RecordId, connectors};
use std::future::Future;
use std::sync::Arc;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    every_use_is_found(make().await.as_ref()).await;
    the_answer_follows_the_changes(make().await.as_ref()).await;
    uses_through_other_helpers_are_found(make().await.as_ref()).await;
}

async fn used(store: &dyn Store, name: &str) -> Vec<(String, String, String)> {
    let uses = store.users(name).await.expect("uses");
    uses.into_iter().map(|found| (found.behaviour.to_string(), found.name, found.record.to_string())).collect()
}

fn line(behaviour: &str, name: &str, record: &str) -> (String, String, String) {
    (behaviour.to_owned(), name.to_owned(), record.to_owned())
}

async fn every_use_is_found(store: &dyn Store) {
    let of = |operation| Record::Connector(Connector { operation, inputs: vec![id("s0")], output: id("s1"), order: 0 });
    let connectors = [
        ("c0", filter(Procedure::Helper("near".into()))),
        ("c1", filter(Procedure::body("x > 1 && near(x)"))),
        ("c2", filter(Procedure::body("x.near > 1 // near"))),
        ("c3", filter(Procedure::body(r#"x == "near" || nearly(x)"#))),
        ("c4", filter(Procedure::body(""))),
        ("c5", of(connectors::scan::SPEC.with(Procedure::body("soFar + near(x)")))),
        ("c6", of(connectors::distinct::SPEC.with(Procedure::Helper("near".into())))),
        ("c7", of(connectors::distinct::SPEC.with(()))),
        ("c8", filter(Procedure::body("!近い(距離)"))),
    ];
    let connectors = connectors.map(|(name, record)| (key(Kind::Connector, name), record));
    save(store, "b", "op1", vec![(RecordId::settings(), settings("Track")), (key(Kind::Note, "n"), note("near"))])
        .await;
    save(store, "b", "op2", [two_streams(), connectors.into()].concat()).await;
    let helpers =
        [("h0", helper("near", "x < 1 || near(x)")), ("h1", helper("far", "!near(x)")), ("h2", helper("one", "1"))];
    let helpers = helpers.map(|(name, record)| (key(Kind::Helper, name), record));
    save(store, LIBRARY, "op1", helpers.into()).await;
    let in_program = ["c0", "c1", "c5", "c6"].map(|name| line("b", "Track", &format!("connector/{name}")));
    let wanted = [in_program.as_slice(), &[line(LIBRARY, "far", "helper/h1")]].concat();
    assert_eq!(used(store, "near").await, wanted);
    assert_eq!(used(store, "far").await, []);
    assert_eq!(used(store, "近い").await, [line("b", "Track", "connector/c8")]);
    assert_eq!(used(store, "距離").await, [], "an argument is no use");
    assert_eq!(used(store, "").await, []);
    assert_eq!(used(store, "near' OR 1=1 --").await, []);
}

async fn the_answer_follows_the_changes(store: &dyn Store) {
    let connector = key(Kind::Connector, "c");
    let first = [two_streams(), vec![(connector.clone(), filter(Procedure::Helper("near".into())))]];
    save(store, "b", "op1", first.concat()).await;
    save(store, "b", "op2", vec![(connector.clone(), filter(Procedure::body("far(x)")))]).await;
    assert_eq!(used(store, "near").await, []);
    assert_eq!(used(store, "far").await, [line("b", "", "connector/c")]);
    assert_eq!(store.remove(&id("b"), 1, "Ben").await, Ok(true));
    assert_eq!(used(store, "far").await, [], "what is in the bin uses nothing");
    assert_eq!(store.restore(&id("b")).await, Ok(true));
    let now = store.load(&id("b")).await.expect("an answer").expect("a behaviour").behaviour;
    append(store, "b", 3, Change::of(id("op3"), "Ben", "Remove").take(&now, connector)).await;
    assert_eq!(used(store, "far").await, []);
}

async fn uses_through_other_helpers_are_found(store: &dyn Store) {
    let user = (key(Kind::Connector, "c"), filter(Procedure::Helper("far".into())));
    let edits = [two_streams(), vec![(RecordId::settings(), settings("Track")), user]].concat();
    save(store, "b", "op1", edits).await;
    let bodies = [("h0", "near", "x < 1"), ("h1", "far", "!near(x)"), ("h2", "farther", "far(x) && far(2 * x)")];
    let helpers = bodies.map(|(name, helper_name, body)| (key(Kind::Helper, name), helper(helper_name, body)));
    save(store, LIBRARY, "op1", helpers.into()).await;
    let found = store.where_used("near").await.expect("uses");
    let lines: Vec<_> = found.iter().map(|u| (u.name.as_str(), u.record.id.as_str(), u.through.as_deref())).collect();
    assert_eq!(lines, [("far", "h1", None), ("Track", "c", Some("far")), ("farther", "h2", Some("far"))]);
}
