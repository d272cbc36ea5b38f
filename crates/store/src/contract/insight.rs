//! Insight: the same answers from every store.

use super::samples::{append, driving, id, key, now, save, settings};
use crate::{ActionDriver, Contested, Similar, Store};
use behaviour::{Change, Kind, RecordId};
use std::future::Future;
use std::sync::Arc;

pub(super) async fn check<F: Future<Output = Arc<dyn Store>>>(make: &impl Fn() -> F) {
    let store = make().await;
    fill(store.as_ref()).await;
    drivers_are_found_with_their_sensors(store.as_ref()).await;
    shared_actions_are_found(store.as_ref()).await;
    similar_behaviours_are_found(store.as_ref()).await;
    the_answers_follow_the_changes(store.as_ref()).await;
}

async fn fill(store: &dyn Store) {
    for (behaviour, name, actuator) in [("a", "Look", "Tracker"), ("b", "Talk", "SayInput"), ("c", "Point", "Tracker")]
    {
        let edits = [vec![(RecordId::settings(), settings(name))], driving(actuator)].concat();
        save(store, behaviour, "op1", edits).await;
    }
    save(store, "d", "op1", vec![(RecordId::settings(), settings("Empty"))]).await;
}

fn driver(behaviour: &str, name: &str) -> ActionDriver {
    ActionDriver { behaviour: id(behaviour), name: name.to_owned(), sensors: vec!["Ball".to_owned()] }
}

async fn drivers_are_found_with_their_sensors(store: &dyn Store) {
    assert_eq!(store.drivers("Tracker").await, Ok(vec![driver("a", "Look"), driver("c", "Point")]));
    assert_eq!(store.drivers("RedBall").await, Ok(vec![]), "a sense is no action");
    assert_eq!(store.drivers("' OR 1=1 --").await, Ok(vec![]));
}

async fn shared_actions_are_found(store: &dyn Store) {
    let behaviours = vec![(id("a"), "Look".to_owned()), (id("c"), "Point".to_owned())];
    let tracker = Contested { actuator: "Tracker".to_owned(), behaviours, count: 2 };
    assert_eq!(store.contested().await, Ok(vec![tracker]));
}

async fn similar_behaviours_are_found(store: &dyn Store) {
    let similar =
        |behaviour: &str, name: &str, shared| Similar { behaviour: id(behaviour), name: name.to_owned(), shared };
    assert_eq!(store.similar(&id("a"), 9).await, Ok(vec![similar("c", "Point", 2), similar("b", "Talk", 1)]));
    assert_eq!(store.similar(&id("a"), 1).await, Ok(vec![similar("c", "Point", 2)]));
    assert_eq!(store.similar(&id("d"), 9).await, Ok(vec![]));
    assert_eq!(store.similar(&id("nobody"), 9).await, Ok(vec![]));
}

async fn the_answers_follow_the_changes(store: &dyn Store) {
    let cut = Change::of(id("cut"), "Ben", "Cut").take(&now(store, "a").await, key(Kind::Connector, "c1"));
    append(store, "a", 2, cut).await;
    let blind = ActionDriver { sensors: Vec::new(), ..driver("a", "Look") };
    assert_eq!(store.drivers("Tracker").await, Ok(vec![blind.clone(), driver("c", "Point")]));
    assert_eq!(store.remove(&id("c"), 5, "Ben").await, Ok(true));
    assert_eq!(store.drivers("Tracker").await, Ok(vec![blind]), "what is in the bin drives nothing");
    assert_eq!(store.contested().await, Ok(vec![]));
    assert_eq!(store.similar(&id("a"), 9).await.expect("an answer").len(), 1);
    assert_eq!(store.restore(&id("c")).await, Ok(true));
    assert_eq!(store.contested().await.expect("an answer").len(), 1);
}
