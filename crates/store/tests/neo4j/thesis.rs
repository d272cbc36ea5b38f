//! A database as the thesis's own environment wrote it is read as behaviours that keep the rules.

use crate::shared;
use behaviour::BehaviourFile;
use store::{Query, Store};

/// The walkthrough of chapter 6 with a merge beside it, in the labels and relationships that the thesis names.
const WRITTEN: &str = "
CREATE (p:Program {name: 'Track close balls'})
CREATE (ball:Stream:Sensor {name: 'Red ball', device: 'RedBall', x: 10, y: 20})-[:program]->(p)
CREATE (distance:Stream {name: 'Distance to ball'})-[:program]->(p)
CREATE (close:Stream {name: 'Close balls'})-[:program]->(p)
CREATE (slow:Stream {name: 'Close balls'})-[:program]->(p)
CREATE (both:Stream {name: 'Both'})-[:program]->(p)
CREATE (look:Stream {name: 'Tracker', type: 'actuator'})-[:program]->(p)
CREATE (helper:Helper {name: 'distance', parameters: 'ball', body: 'ball.size * 100.0'})
CREATE (ball)-[:input]->(map:Map)-[:output]->(distance), (map)-[:helper]->(helper)
CREATE (distance)-[:filter {body: 'distancetoball < 20'}]->(close)
CREATE (close)-[:sample {rate: 500}]->(slow)
CREATE (slow)-[:input {index: 1}]->(m:Merge)-[:output]->(both)
CREATE (close)-[:input {index: 0}]->(m)
CREATE (both)-[:subscribe]->(look)
CREATE (:Program {name: 'Empty'})";

#[tokio::test(flavor = "multi_thread")]
async fn a_database_of_the_thesis_is_read() {
    let Some(neo4j) = shared::alone("a database of the thesis").await else { return };
    let store = neo4j.empty_store().await;
    neo4j.rows(WRITTEN).await;
    let ours = store.list(&Query::default()).await.expect("a list");
    assert_eq!((ours.lines.len(), ours.total), (0, 0), "what the thesis's environment wrote is not ours");
    let mut files = store::read_thesis(&neo4j.url()).await.expect("programs");
    // They come in the order of numbers that Neo4j uses again.
    files.sort_by_key(|file| std::cmp::Reverse(file.connectors.len()));
    assert_eq!(files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), ["Track close balls", "Empty"]);
    let lines: Vec<_> = files[0].connectors.iter().map(|connector| line(&files[0], connector)).collect();
    let wanted = [
        "filter(distanceToBall < 20) Distance to ball -> Close balls",
        "sample(500) Close balls -> Close balls 2",
        "subscribe() Both -> Tracker",
        "map(distance) Red ball -> Distance to ball",
        "merge() Close balls, Close balls 2 -> Both",
    ];
    for line in wanted {
        assert!(lines.iter().any(|found| found == line), "{line} is not in {lines:?}");
    }
    assert_eq!(lines.len(), wanted.len());
    assert_eq!(files[0].layout.len(), 1);
    for file in &files {
        file.records(|_| None).expect("records");
    }
    neo4j.empty().await;
}

fn line(file: &BehaviourFile, connector: &behaviour::FileConnector) -> String {
    let name = |id: &String| file.streams.iter().find(|stream| stream.id == *id).expect("a stream").name.clone();
    let inputs: Vec<_> = connector.inputs.iter().map(name).collect();
    let period = connector.period_ms.map(|period| period.to_string());
    let what = connector.body.clone().or(connector.helper.clone()).or(period).unwrap_or_default();
    format!("{}({what}) {} -> {}", connector.operation, inputs.join(", "), name(&connector.output))
}
