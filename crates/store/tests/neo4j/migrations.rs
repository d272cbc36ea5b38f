//! Schema steps are applied once, recorded, and refused when they are edited or unknown.

use crate::samples::{follow, id, save};
use crate::shared;
use serde_json::json;
use store::{Query, Store, StoreError, open_neo4j};

const RECORDED: &str = "MATCH (n:Migration) RETURN n.version AS version, n.name AS name ORDER BY version";

#[tokio::test(flavor = "multi_thread")]
async fn a_step_is_recorded_and_refused_when_edited_or_unknown() {
    let Some(neo4j) = shared::alone("schema steps").await else { return };
    neo4j.store().await;
    let steps = [(1, "0001_schema"), (2, "0002_listed"), (3, "0003_checkpoints"), (4, "0004_groups")];
    assert_eq!(neo4j.rows(RECORDED).await, steps.map(|(version, name)| json!({ "version": version, "name": name })));
    neo4j.rows("MATCH (n:Migration {version: 1}) SET n.kept = n.checksum, n.checksum = 'edited'").await;
    let edited = open_neo4j(&neo4j.url()).await.err().expect("a refusal");
    neo4j.rows("MATCH (n:Migration {version: 1}) SET n.checksum = n.kept REMOVE n.kept").await;
    assert!(edited.to_string().contains("0001_schema") && edited.to_string().contains("undo the edit"), "{edited}");
    neo4j.rows("CREATE (:Migration {version: 7, name: 'later', checksum: ''})").await;
    let newer = open_neo4j(&neo4j.url()).await.err().expect("a refusal");
    neo4j.rows("MATCH (n:Migration {version: 7}) DELETE n").await;
    assert_eq!(newer, StoreError::Newer { found: 7, known: 4 });
    neo4j.store().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_library_from_before_a_step_is_listed_and_counted_as_ever() {
    let Some(neo4j) = shared::alone("a library from before a step").await else { return };
    let store = neo4j.empty_store().await;
    for name in ["a", "b", "c"] {
        save(&store, name, "op1", follow(name)).await;
    }
    assert!(store.remove(&id("c"), 1, "Ben").await.expect("an answer"));
    neo4j.rows("MATCH (p:Listed) REMOVE p:Listed").await;
    neo4j.rows("MATCH (n:Migration {version: 2}) DELETE n").await;
    let listing = neo4j.store().await.list(&Query::default()).await.expect("a list");
    assert_eq!((listing.lines.len(), listing.total), (2, 2));
    neo4j.empty().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn servers_that_start_together_make_one_schema() {
    let Some(neo4j) = shared::alone("servers that start together").await else { return };
    neo4j.rows("MATCH (n) WHERE n:Migration OR n:Shared DELETE n").await;
    for index in neo4j.rows("SHOW CONSTRAINTS YIELD name RETURN name").await {
        neo4j.rows(&format!("DROP CONSTRAINT {}", index["name"].as_str().expect("a name"))).await;
    }
    for index in neo4j.rows("SHOW INDEXES YIELD name, type WHERE type <> 'LOOKUP' RETURN name").await {
        neo4j.rows(&format!("DROP INDEX {}", index["name"].as_str().expect("a name"))).await;
    }
    let starts: Vec<_> = (0..4)
        .map(|_| {
            let url = neo4j.url();
            tokio::spawn(async move { open_neo4j(&url).await.map(|_| ()) })
        })
        .collect();
    for start in starts {
        assert_eq!(start.await.expect("an end"), Ok(()));
    }
    assert_eq!(neo4j.rows(RECORDED).await.len(), 4, "every step once");
    let constraints = neo4j.rows("SHOW CONSTRAINTS YIELD name RETURN count(*) AS many").await;
    assert_eq!(constraints, [json!({ "many": 18 })]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_wrong_password_is_told_without_showing_it() {
    let Some(neo4j) = shared::alone("a wrong password").await else { return };
    let url = neo4j.url().replace("only", "secret");
    let refused = open_neo4j(&url).await.err().expect("a refusal").to_string();
    assert!(refused.contains("refuses this user and password") && !refused.contains("secret"), "{refused}");
}
