//! Helpers are nodes linked from what uses them, whichever comes first.

use crate::samples::{connector, follow, helper, named, save, stream, take};
use crate::shared::{self, Alone};
use behaviour::{Kind, connectors};
use serde_json::json;
use std::sync::Arc;
use store::{Append, LIBRARY};
use tokio::task::JoinSet;

const ROUNDS: usize = 6;
const USERS: usize = 6;

async fn linked(neo4j: &Alone) -> Vec<(String, String)> {
    let rows =
        neo4j.rows("MATCH (c:Connector)-[:helper]->(h:Helper) RETURN c.id AS a, h.name AS b ORDER BY a, b").await;
    pairs(&rows)
}

async fn calls(neo4j: &Alone) -> Vec<(String, String)> {
    pairs(&neo4j.rows("MATCH (h:Helper)-[:calls]->(o:Helper) RETURN h.name AS a, o.name AS b ORDER BY a, b").await)
}

fn pairs(rows: &[serde_json::Value]) -> Vec<(String, String)> {
    let text = |value: &serde_json::Value| value.as_str().expect("a text").to_owned();
    rows.iter().map(|row| (text(&row["a"]), text(&row["b"]))).collect()
}

fn pair(a: &str, b: &str) -> (String, String) {
    (a.to_owned(), b.to_owned())
}

#[tokio::test(flavor = "multi_thread")]
async fn links_follow_helpers_that_appear_are_renamed_and_go() {
    let Some(neo4j) = shared::alone("links to helpers").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, "a", "op1", follow("Follow")).await;
    assert_eq!(linked(&neo4j).await, [], "a helper may be missing");
    save(&store, LIBRARY, "op1", vec![helper("h1", "distance", "x"), helper("h2", "other", "distance(x)")]).await;
    assert_eq!(linked(&neo4j).await, [pair("c1", "distance")]);
    assert_eq!(calls(&neo4j).await, [pair("other", "distance")]);
    let more = vec![stream("s", "S", ""), connector("c5", connectors::map::SPEC.with(named("other")), &["ball"], "s")];
    save(&store, "a", "op2", more).await;
    assert_eq!(linked(&neo4j).await, [pair("c1", "distance"), pair("c5", "other")]);
    // They swap their names in one change.
    save(&store, LIBRARY, "op2", vec![helper("h1", "other", "x"), helper("h2", "distance", "other(x)")]).await;
    assert_eq!(linked(&neo4j).await, [pair("c1", "distance"), pair("c5", "other")]);
    assert_eq!(calls(&neo4j).await, [pair("distance", "other")]);
    assert_eq!(take(&store, LIBRARY, "op3", &[(Kind::Helper, "h1")]).await, Ok(Append::Applied));
    assert_eq!(linked(&neo4j).await, [pair("c1", "distance")]);
    assert_eq!(calls(&neo4j).await, []);
    let kept = neo4j.rows("MATCH (c:Connector {id: 'c5'}) RETURN c.helper AS helper").await;
    assert_eq!(kept, [json!({ "helper": "other" })], "the name stays where the helper went");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_helper_and_those_who_name_it_at_once_do_not_miss_each_other() {
    let Some(neo4j) = shared::alone("helpers and their users at once").await else { return };
    let store = Arc::new(neo4j.empty_store().await);
    for round in 0..ROUNDS {
        let (name, mut tasks) = (format!("h{round}"), JoinSet::new());
        for user in 0..USERS {
            let (store, name) = (Arc::clone(&store), name.clone());
            tasks.spawn(async move {
                let streams = vec![stream("a", "A", ""), stream("b", "B", "")];
                let user_of = connector("c", connectors::map::SPEC.with(named(&name)), &["a"], "b");
                save(store.as_ref(), &format!("{name}-{user}"), "op1", [streams, vec![user_of]].concat()).await;
            });
        }
        save(store.as_ref(), LIBRARY, &format!("op{round}"), vec![helper(&name, &name, "x")]).await;
        while let Some(ended) = tasks.join_next().await {
            ended.expect("saved");
        }
    }
    let linked = linked(&neo4j).await;
    assert_eq!(linked.len(), ROUNDS * USERS, "{linked:?}");
}
