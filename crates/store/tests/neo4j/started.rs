//! A Neo4j that has just started: what a command does with it goes well the first time.

use crate::samples::{id, now, save};
use crate::server::{self, Neo4j};
use behaviour::{Record, RecordId, Settings};
use store::open_url_to_work;
use tokio::task::spawn_blocking;

#[tokio::test(flavor = "multi_thread")]
async fn the_first_change_after_a_start_is_waited_for() {
    let Some(folder) = server::folder("the first change of a Neo4j that has just started") else { return };
    let neo4j = spawn_blocking(|| Neo4j::start(folder)).await.expect("a start");
    let store = open_url_to_work(&neo4j.url()).await.expect("it is waited for");
    let named = Record::Settings(Settings::named("First"));
    save(&*store, "b", "op", vec![(RecordId::settings(), named)]).await;
    assert_eq!(now(&*store, "b").await.name(), "First");
    assert!(store.load(&id("b")).await.expect("an answer").is_some());
}
