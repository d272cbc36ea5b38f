//! The graph is the one of the thesis (5.2.4), and stays whole whatever is asked of it.

use crate::samples::{change, connector, follow, id, named, next, now, save, stream, take};
use crate::shared;
use behaviour::{Kind, Procedure, connectors};
use serde_json::{Value, json};
use store::{Append, LIBRARY, Store, StoreError, Unkept};

#[tokio::test(flavor = "multi_thread")]
async fn the_printed_query_of_the_thesis_returns_a_program_with_its_streams() {
    let Some(neo4j) = shared::alone("the thesis's query").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, "a", "op1", follow("Follow")).await;
    save(&store, "b", "op1", follow("Another")).await;
    let found = neo4j.rows("MATCH (p:Program {id: 'a'}) RETURN id(p) AS id").await;
    // As printed, but for the number.
    let query = format!("MATCH (p:Program) < -[:program] -(s:Stream)\nWHERE id(p) = {}\nRETURN p, s", found[0]["id"]);
    let rows = neo4j.rows(&query).await;
    let mut names: Vec<_> = rows.iter().map(|row| row["s"]["name"].as_str().expect("a name")).collect();
    names.sort_unstable();
    assert_eq!(names, ["Both", "Distance", "Head", "Near", "Red ball"]);
    assert!(rows.iter().all(|row| row["p"]["name"] == "Follow"), "{rows:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn simple_connectors_are_relationships_and_the_others_nodes() {
    let Some(neo4j) = shared::alone("the thesis's graph").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, "a", "op1", follow("Follow")).await;
    let simple = neo4j
        .rows("MATCH (a:Stream)-[r]->(b:Stream) RETURN a.id AS a, type(r) AS kind, r.id AS id, b.id AS b ORDER BY id")
        .await;
    let wanted = [("distance", "filter", "c2", "near"), ("both", "subscribe", "c4", "head")];
    assert_eq!(simple, wanted.map(|(a, kind, id, b)| json!({ "a": a, "kind": kind, "id": id, "b": b })));
    let nodes = "MATCH (c:Connector)-[:output]->(b:Stream) MATCH (a:Stream)-[e:input]->(c) \
        RETURN c.id AS id, c:Map AS map, c:CombineLatest AS combine, a.id AS a, e.slot AS slot, b.id AS b \
        ORDER BY id, slot";
    let line =
        |id, map: bool, a, slot, b| json!({ "id": id, "map": map, "combine": !map, "a": a, "slot": slot, "b": b });
    let wanted = [
        line("c1", true, "ball", 0, "distance"),
        line("c3", false, "near", 0, "both"),
        line("c3", false, "ball", 1, "both"),
    ];
    assert_eq!(neo4j.rows(nodes).await, wanted);
    let devices =
        "MATCH (d:Device)<-[:device]-(s:Stream) RETURN d.kind AS kind, d.name AS name, s.id AS id ORDER BY id";
    let wanted = [("sensor", "RedBall", "ball"), ("actuator", "Tracker", "head")];
    assert_eq!(
        neo4j.rows(devices).await,
        wanted.map(|(kind, name, id)| json!({ "kind": kind, "name": name, "id": id }))
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn from_body_to_helper_and_back_a_connector_keeps_its_id() {
    let Some(neo4j) = shared::alone("a connector that changes its form").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, "a", "op1", follow("Follow")).await;
    let forms = "OPTIONAL MATCH (c:Connector {id: 'c2'}) OPTIONAL MATCH ()-[r {id: 'c2'}]->() \
        RETURN count(DISTINCT c) AS nodes, count(DISTINCT r) AS relationships";
    for (op, procedure, wanted) in
        [("op2", named("near"), (1, 0)), ("op3", Procedure::body("x > 1"), (0, 1)), ("op4", named("far"), (1, 0))]
    {
        let edit = connector("c2", connectors::filter::SPEC.with(procedure), &["distance"], "near");
        save(&store, "a", op, vec![edit.clone()]).await;
        assert_eq!(now(&store, "a").await.records.get(&edit.0), Some(&edit.1));
        let (nodes, relationships) = wanted;
        assert_eq!(neo4j.rows(forms).await, [json!({ "nodes": nodes, "relationships": relationships })]);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn two_streams_may_swap_names_and_kinds() {
    let Some(neo4j) = shared::alone("swapped names").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, "a", "op1", vec![stream("s0", "One", "sensor:RedBall"), stream("s1", "Two", "")]).await;
    save(&store, "a", "op2", vec![stream("s0", "Two", ""), stream("s1", "One", "actuator:Tracker")]).await;
    let rows = neo4j.rows("MATCH (s:Stream) RETURN s.name AS name, labels(s) AS labels ORDER BY s.id").await;
    let wanted = [
        json!({ "name": "Two", "labels": ["Stream", "Ordinary"] }),
        json!({ "name": "One", "labels": ["Stream", "Actuator"] }),
    ];
    assert_eq!(rows, wanted);
    let linked = neo4j.rows("MATCH (:Device)<-[:device]-(s) RETURN s.id AS id").await;
    assert_eq!(linked, [json!({ "id": "s1" })]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_connector_without_inputs_is_kept() {
    let Some(neo4j) = shared::alone("a connector without inputs").await else { return };
    let store = neo4j.empty_store().await;
    let edits = vec![
        stream("s", "S", ""),
        connector("c1", connectors::merge::SPEC.with(()), &[], "s"),
        connector("c2", connectors::combine_latest::SPEC.with(Procedure::body("")), &[], "s"),
    ];
    save(&store, "a", "op1", edits.clone()).await;
    let loaded = now(&store, "a").await;
    assert_eq!(loaded.records, edits.into_iter().collect());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_change_that_would_break_the_graph_is_refused_whole() {
    let Some(neo4j) = shared::alone("changes that would break the graph").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, "a", "op1", follow("Follow")).await;
    save(&store, "b", "op1", vec![stream("elsewhere", "E", "")]).await;
    let before = neo4j.rows(EVERYTHING).await;
    let bodied = connectors::filter::SPEC.with(Procedure::body("x"));
    let dangling = [
        connector("new", bodied.clone(), &["missing"], "near"),
        connector("new", bodied, &["ball"], "missing"),
        connector("new", connectors::merge::SPEC.with(()), &["ball", "missing"], "near"),
        connector("c2", connectors::merge::SPEC.with(()), &["ball"], "missing"),
        connector("new", connectors::subscribe::SPEC.with(()), &["elsewhere"], "head"),
    ];
    for edit in dangling {
        let made = change("op2", &now(&store, "a").await, vec![stream("extra", "Extra", ""), edit]);
        let refused = next(&store, "a", made).await.expect_err("a refusal");
        assert_eq!(refused, StoreError::Refused(Unkept::NoStream));
        assert!(!refused.is_open());
    }
    let cut = take(&store, "a", "op2", &[(Kind::Stream, "near")]).await;
    assert_eq!(cut, Err(StoreError::Refused(Unkept::StreamUsed)));
    assert_eq!(neo4j.rows(EVERYTHING).await, before, "nothing of it was done");
    let whole = [(Kind::Connector, "c2"), (Kind::Connector, "c3"), (Kind::Stream, "near")];
    assert_eq!(take(&store, "a", "op2", &whole).await, Ok(Append::Applied));
}

const EVERYTHING: &str = "MATCH (n) WITH n, elementId(n) AS id OPTIONAL MATCH (n)-[r]->(m) \
    RETURN id, labels(n) AS labels, properties(n) AS is, type(r) AS leads, elementId(m) AS to ORDER BY id, leads, to";

#[tokio::test(flavor = "multi_thread")]
async fn purging_leaves_nothing_of_a_behaviour() {
    let Some(neo4j) = shared::alone("purging").await else { return };
    let store = neo4j.empty_store().await;
    save(&store, LIBRARY, "op1", vec![crate::samples::helper("h", "distance", "x")]).await;
    let all = "MATCH (n) WHERE NOT n:Device AND NOT n:Shared AND NOT n:Migration RETURN count(n) AS many";
    let before = neo4j.rows(all).await;
    save(&store, "a", "op1", follow("Follow")).await;
    assert_eq!(store.remove(&id("a"), 5, "Ben").await, Ok(true));
    assert_eq!(neo4j.rows("MATCH (p:Program) RETURN p").await, [Value::Null; 0], "the bin is no program");
    assert_eq!(store.purge(6).await, Ok(1));
    assert_eq!(neo4j.rows(all).await, before);
    save(&store, "a", "op1", follow("Follow")).await;
}
