//! Reading a behaviour and its history.

use super::fault::Neo4jFault;
use super::link::{Broken, Neo4jConnections, StatementParams};
use super::nodes::{
    ConnectorNode, GroupNode, HelperNode, NoteNode, PlaceNode, SettingsNode, StreamNode, pad, whole, with_relationships,
};
use crate::{Damage, Loaded, StoreError, json};
use behaviour::{Behaviour, Committed, Id};
use serde::Deserialize;
use serde_json::json;
use std::sync::LazyLock;

/// One behaviour whole, in one row. It waits for a change that is being saved: Neo4j would show half of one.
pub(super) static LOAD: LazyLock<String> = LazyLock::new(|| with_relationships(STATE));

const STATE: &str = "
MATCH (p:Behaviour {id: $id})
SET p.lock = true REMOVE p.lock
WITH p
CALL (p) {
  MATCH (s:Stream)-[:program]->(p)
  RETURN collect(s {.*, kind: CASE WHEN s:Sensor THEN 'sensor' WHEN s:Actuator THEN 'actuator' ELSE 'ordinary' END})
    AS streams
}
CALL (p) {
  MATCH (a:Stream)-[:program]->(p) MATCH (a)-[r:$TYPES]->(b:Stream)
  RETURN collect(r {.*, kind: type(r), inputs: [a.id], output: b.id}) AS simple
}
CALL (p) {
  MATCH (c:Connector)-[:program]->(p) MATCH (c)-[:output]->(b:Stream)
  RETURN collect(c {.*, kind: [x IN labels(c) WHERE x <> 'Connector'][0], output: b.id,
    inputs: COLLECT { MATCH (a:Stream)-[e:input]->(c) RETURN a.id ORDER BY e.slot }}) AS nodes
}
CALL (p) { MATCH (n:Place)-[:program]->(p) RETURN collect(n {.*}) AS places }
CALL (p) { MATCH (n:Note)-[:program]->(p) RETURN collect(n {.*}) AS notes }
CALL (p) { MATCH (n:Group)-[:program]->(p) RETURN collect(n {.*}) AS groups }
CALL (p) { MATCH (n:Helper)-[:program]->(p) RETURN collect(n {.*}) AS helpers }
RETURN p.revision AS revision, p.removed_ms AS removed_ms, p {.name, .robot, .engine_json, .tags, .exercise} AS settings,
  p.pad_json AS pad_json,
  streams, simple, nodes, places, notes, groups, helpers";

const HISTORY: &str = "
MATCH (o:Op) WHERE o.program_id = $id AND o.revision > $since
RETURN o.revision AS revision, o.change AS change ORDER BY o.program_id, o.revision LIMIT $most";

#[derive(Deserialize)]
struct LoadedRow {
    revision: u64,
    removed_ms: Option<u64>,
    settings: SettingsNode,
    pad_json: Option<String>,
    streams: Vec<StreamNode>,
    simple: Vec<ConnectorNode>,
    nodes: Vec<ConnectorNode>,
    places: Vec<PlaceNode>,
    notes: Vec<NoteNode>,
    groups: Vec<GroupNode>,
    helpers: Vec<HelperNode>,
}

#[derive(Deserialize)]
struct MadeRecords {
    revision: u64,
    change: String,
}

/// The parameters of [`LOAD`].
pub(super) fn params(id: &str) -> StatementParams {
    StatementParams::from_iter([("id".to_owned(), json!(id))])
}

/// A behaviour as it is now.
pub(super) async fn load(link: &Neo4jConnections, id: &Id) -> Result<Option<Loaded>, StoreError> {
    let found = link.ask::<LoadedRow>(&LOAD, params(id.as_str()), Broken::Again).await?;
    let Some(row) = found.rows.into_iter().next() else { return Ok(None) };
    let (revision, removed_ms) = (row.revision, row.removed_ms);
    let behaviour = behaviour(row).map_err(|fault| link.told(fault))?;
    Ok(Some(Loaded { behaviour, revision, removed_ms }))
}

fn behaviour(row: LoadedRow) -> Result<Behaviour, Neo4jFault> {
    let mut behaviour = Behaviour::default();
    let records = &mut behaviour.records;
    records.extend(row.settings.record()?);
    records.extend(pad(row.pad_json.as_deref())?);
    for stream in row.streams {
        records.extend([stream.record()?]);
    }
    for connector in row.simple.into_iter().chain(row.nodes) {
        records.extend([connector.record()?]);
    }
    records.extend(row.places.into_iter().map(PlaceNode::record));
    records.extend(row.notes.into_iter().map(NoteNode::record));
    records.extend(row.groups.into_iter().map(GroupNode::record));
    records.extend(row.helpers.into_iter().map(HelperNode::record));
    Ok(behaviour)
}

/// Changes after a revision, oldest first.
pub(super) async fn history(
    link: &Neo4jConnections,
    id: &Id,
    since: u64,
    most: u32,
) -> Result<Vec<Committed>, StoreError> {
    // No revision is larger than the largest i64.
    let since = i64::try_from(since).unwrap_or(i64::MAX);
    let params = [("id", json!(id)), ("since", json!(since)), ("most", whole(u64::from(most)))];
    let params = params.map(|(name, value)| (name.to_owned(), value)).into_iter().collect();
    let rows = link.read::<MadeRecords>(HISTORY, params).await?;
    rows.into_iter().map(committed).collect()
}

fn committed(made: MadeRecords) -> Result<Committed, StoreError> {
    let damaged = |reason: serde_json::Error| {
        StoreError::Damaged(Damage::Neo4jChange { revision: made.revision, why: reason.to_string().into() })
    };
    Ok(Committed { revision: made.revision, change: json::decode(&made.change).map_err(damaged)? })
}
