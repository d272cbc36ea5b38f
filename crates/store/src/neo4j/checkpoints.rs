//! Revisions with a name: nodes of their own beside the behaviour.

use super::link::{Broken, Neo4jConnections, StatementParams};
use super::nodes::whole;
use crate::StoreError;
use crate::checkpoints::in_order;
use behaviour::{Checkpoint, Id};
use serde::Deserialize;
use serde_json::{Value, json};

const ALL: &str = "
MATCH (n:Checkpoint {program_id: $id})
RETURN n.revision AS revision, n.name AS name, n.by AS by, n.at_ms AS at_ms";

/// Twice does the same as once.
const KEEP: &str = "
MATCH (p:Behaviour {id: $id})
SET p.lock = true REMOVE p.lock
WITH p WHERE $revision > 0 AND p.revision >= $revision
MERGE (n:Checkpoint {program_id: $id, name: $name})
ON CREATE SET n.revision = $revision, n.by = $by, n.at_ms = $at_ms
MERGE (n)-[:program]->(p)
RETURN n.revision = $revision AND n.by = $by AND n.at_ms = $at_ms AS kept";

const DROP: &str = "
MATCH (p:Behaviour {id: $id})
SET p.lock = true REMOVE p.lock
WITH p MATCH (n:Checkpoint {program_id: $id, name: $name})
DETACH DELETE n
RETURN count(*) AS many";

#[derive(Deserialize)]
struct CheckpointText {
    kept: bool,
}

fn params<const N: usize>(all: [(&str, Value); N]) -> StatementParams {
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// All of a behaviour.
pub(super) async fn all(link: &Neo4jConnections, id: &Id) -> Result<Vec<Checkpoint>, StoreError> {
    Ok(in_order(link.read(ALL, params([("id", json!(id))])).await?))
}

/// Keeps one, unless another one has its name or its revision is not there.
pub(super) async fn keep(link: &Neo4jConnections, id: &Id, wanted: &Checkpoint) -> Result<bool, StoreError> {
    let Checkpoint { revision, name, by, at_ms } = wanted;
    // No revision is larger than the largest i64.
    let revision = whole((*revision).min(i64::MAX as u64));
    let all =
        [("id", json!(id)), ("revision", revision), ("name", json!(name)), ("by", json!(by)), ("at_ms", whole(*at_ms))];
    let found = link.ask::<CheckpointText>(KEEP, params(all), Broken::Again).await?;
    Ok(found.rows.first().is_some_and(|row| row.kept))
}

/// Lets one go.
pub(super) async fn drop(link: &Neo4jConnections, id: &Id, name: &str) -> Result<(), StoreError> {
    let all = params([("id", json!(id)), ("name", json!(name))]);
    link.ask::<Value>(DROP, all, Broken::Again).await.map(|_| ())
}
