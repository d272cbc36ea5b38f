//! The bin, and what servers share: small writes, each one statement.

use super::link::{Broken, Neo4jConnections, StatementParams};
use super::nodes::whole;
use crate::{Damage, StoreError};
use behaviour::Id;
use serde::Deserialize;
use serde_json::{Value, json};

const REMOVE: &str = "
MATCH (p:Behaviour {id: $id})
SET p.lock = true REMOVE p.lock
WITH p WHERE p:Program
SET p:Binned, p.removed_ms = $now_ms, p.removed_by = $by
REMOVE p:Program:Listed
RETURN count(*) AS many";

const RESTORE: &str = "
MATCH (p:Behaviour {id: $id})
SET p.lock = true REMOVE p.lock
WITH p WHERE p:Binned
SET p:Program
REMOVE p:Binned, p.removed_ms, p.removed_by
FOREACH (_ IN CASE WHEN p.name_key IS NULL THEN [] ELSE [1] END | SET p:Listed)
RETURN count(*) AS many";

const OLD: &str = "MATCH (p:Binned) WHERE p.removed_ms < $before RETURN p.id AS id ORDER BY p.removed_ms";

/// One behaviour whole. It looks again: somebody may have restored it meanwhile.
const PURGE: &str = "
MATCH (p:Behaviour {id: $id})
SET p.lock = true REMOVE p.lock
WITH p WHERE p:Binned AND p.removed_ms < $before
CALL (p) { MATCH (x)-[:program]->(p) DETACH DELETE x }
CALL () { MATCH (o:Op) WHERE o.program_id = $id AND o.revision > 0 DELETE o }
DETACH DELETE p
RETURN count(*) AS many";

const EPOCH: &str = "
MATCH (n:Shared {name: 'epoch'})
SET n.lock = true REMOVE n.lock
WITH n SET n.value = n.value + 1
RETURN n.value AS many";

const RAISE: &str = "
MATCH (n:Shared {name: 'epoch'})
SET n.lock = true REMOVE n.lock
WITH n SET n.value = CASE WHEN n.value < $least THEN $least ELSE n.value END
RETURN n.value AS many";

const PROBE: &str = "MATCH (n:Shared {name: 'epoch'}) SET n.probed_ms = timestamp() RETURN n.value AS many";

#[derive(Deserialize)]
struct CountRow {
    many: u64,
}

#[derive(Deserialize)]
struct Old {
    id: Id,
}

async fn count(link: &Neo4jConnections, text: &str, params: &[(&str, Value)]) -> Result<u64, StoreError> {
    let params: StatementParams = params.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    let found = link.ask::<CountRow>(text, params, Broken::GiveUp).await?;
    Ok(found.rows.first().map_or(0, |row| row.many))
}

/// A time as it is kept; what is later is as good as the latest.
fn kept(time_ms: u64) -> Value {
    whole(time_ms.min(i64::MAX as u64))
}

/// Moves a behaviour to the bin.
pub(super) async fn remove(link: &Neo4jConnections, id: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
    Ok(count(link, REMOVE, &[("id", json!(id)), ("now_ms", kept(now_ms)), ("by", json!(by))]).await? > 0)
}

/// Takes a behaviour out of the bin.
pub(super) async fn restore(link: &Neo4jConnections, id: &Id) -> Result<bool, StoreError> {
    Ok(count(link, RESTORE, &[("id", json!(id))]).await? > 0)
}

/// Deletes what was removed before that time, one behaviour after the other.
pub(super) async fn purge(link: &Neo4jConnections, removed_before_ms: u64) -> Result<u32, StoreError> {
    let before = kept(removed_before_ms);
    let old = link.read::<Old>(OLD, StatementParams::from_iter([("before".to_owned(), before.clone())])).await?;
    let mut gone = 0;
    for Old { id } in old {
        gone += count(link, PURGE, &[("id", json!(id)), ("before", before.clone())]).await?;
    }
    Ok(u32::try_from(gone).unwrap_or(u32::MAX))
}

/// The next number of a server start.
pub(super) async fn next_epoch(link: &Neo4jConnections) -> Result<u64, StoreError> {
    match count(link, EPOCH, &[]).await? {
        0 => Err(StoreError::Damaged(Damage::LostStarts)),
        epoch => Ok(epoch),
    }
}

/// The number of the last server start is at least this.
pub(super) async fn raise_epoch(link: &Neo4jConnections, least: u64) -> Result<(), StoreError> {
    count(link, RAISE, &[("least", kept(least))]).await.map(|_| ())
}

/// Writes something that nobody reads, to see whether that works.
pub(super) async fn probe(link: &Neo4jConnections) -> Result<(), StoreError> {
    count(link, PROBE, &[]).await.map(|_| ())
}
