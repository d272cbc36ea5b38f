//! The knowledge in a library of graphs, asked of the graph.

use super::link::{Neo4jConnections, StatementParams};
use super::nodes::with_relationships;
use crate::usage::in_order;
use crate::{ActionDriver, Contested, HelperUse, Similar, StoreError};
use behaviour::{Id, Kind, RecordId, calls_helper};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Finds who names a helper, or has its name among the words of a body; the bodies decide.
const USERS: &str = "
CALL () {
  MATCH (c:Connector {helper: $helper})
  RETURN c.program_id AS behaviour, c.id AS id, null AS name, null AS body, c.helper AS helper
  UNION ALL
  CALL db.index.fulltext.queryNodes('words_of_nodes', $quoted) YIELD node
  RETURN node.program_id AS behaviour, node.id AS id, CASE WHEN node:Helper THEN node.name END AS name,
    node.body AS body, null AS helper
  UNION ALL
  CALL db.index.fulltext.queryRelationships('words_of_relationships', $quoted) YIELD relationship AS r
  RETURN r.program_id AS behaviour, r.id AS id, null AS name, r.body AS body, null AS helper
}
MATCH (p:Behaviour {id: behaviour}) WHERE NOT p:Binned
RETURN behaviour, id, name, body, helper, coalesce(p.name, '') AS program";

const DRIVERS: &str = "
MATCH (:Device {kind: 'actuator', name: $actuator})<-[:device]-(a:Stream)-[:program]->(p:Program)
CALL (a) {
  MATCH (a)<-[:$TYPES|input|output*1..]-(s:Sensor)
  WITH DISTINCT s
  RETURN collect(s.name) AS sensors
}
RETURN p.id AS behaviour, coalesce(p.name, '') AS name, sensors";

const CONTESTED: &str = "
MATCH (d:Device {kind: 'actuator'})<-[:device]-(:Stream)-[:program]->(p:Program)
WITH DISTINCT d, p ORDER BY p.id
WITH d, count(p) AS count, collect([p.id, coalesce(p.name, '')])[..$shown] AS behaviours WHERE count > 1
RETURN d.name AS actuator, behaviours, count ORDER BY actuator";

const SIMILAR: &str = "
MATCH (:Behaviour {id: $id})<-[:program]-(:Stream)-[:device]->(d:Device)
WITH DISTINCT d
MATCH (d)<-[:device]-(:Stream)-[:program]->(p:Program) WHERE p.id <> $id
RETURN p.id AS behaviour, coalesce(p.name, '') AS name, count(DISTINCT d) AS shared
ORDER BY shared DESC, behaviour LIMIT $most";

#[derive(Deserialize)]
struct InsightUser {
    behaviour: Id,
    program: String,
    id: Id,
    name: Option<String>,
    body: Option<String>,
    helper: Option<String>,
}

impl InsightUser {
    fn uses(&self, helper: &str) -> bool {
        let itself = self.name.as_deref() == Some(helper);
        self.helper.is_some() || (!itself && self.body.as_deref().is_some_and(|body| calls_helper(body, helper)))
    }

    fn usage(self) -> HelperUse {
        let kind = if self.name.is_some() { Kind::Helper } else { Kind::Connector };
        let (name, record) = (self.name.unwrap_or(self.program), RecordId::new(kind, &self.id));
        HelperUse { behaviour: self.behaviour, name, record, through: None }
    }
}

#[derive(Deserialize)]
struct Driving {
    behaviour: Id,
    name: String,
    sensors: Vec<String>,
}

#[derive(Deserialize)]
struct InsightShared {
    actuator: String,
    behaviours: Vec<(Id, String)>,
    count: u64,
}

#[derive(Deserialize)]
struct Alike {
    behaviour: Id,
    name: String,
    shared: u32,
}

fn params<const N: usize>(params: [(&str, Value); N]) -> StatementParams {
    params.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// True if the text can be a word of a body.
fn is_word(text: &str) -> bool {
    !text.is_empty() && text.chars().all(behaviour::is_name_letter)
}

/// Returns the direct users of a helper.
pub(super) async fn users(link: &Neo4jConnections, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
    // What is no word is in no index; neither is a blank, but the index must be asked for something.
    let quoted = if is_word(helper) { format!("\"{helper}\"") } else { "\"-\"".to_owned() };
    let found = link.read::<InsightUser>(USERS, params([("helper", json!(helper)), ("quoted", json!(quoted))])).await?;
    Ok(in_order(found.into_iter().filter(|user| user.uses(helper)).map(InsightUser::usage).collect()))
}

/// Returns the behaviours that drive an action, and from which sensors.
pub(super) async fn drivers(link: &Neo4jConnections, actuator: &str) -> Result<Vec<ActionDriver>, StoreError> {
    let rows = link.read::<Driving>(&with_relationships(DRIVERS), params([("actuator", json!(actuator))])).await?;
    let mut drivers: BTreeMap<Id, (String, BTreeSet<String>)> = BTreeMap::new();
    for row in rows {
        let entry = drivers.entry(row.behaviour).or_insert_with(|| (row.name, BTreeSet::new()));
        entry.1.extend(row.sensors);
    }
    let driver = |(behaviour, (name, sensors)): (Id, (String, BTreeSet<String>))| ActionDriver {
        behaviour,
        name,
        sensors: sensors.into_iter().collect(),
    };
    Ok(drivers.into_iter().map(driver).collect())
}

/// Actions that several behaviours drive.
pub(super) async fn contested(link: &Neo4jConnections) -> Result<Vec<Contested>, StoreError> {
    let rows = link.read::<InsightShared>(CONTESTED, params([("shown", json!(Contested::SHOWN_MAX))])).await?;
    let one = |InsightShared { actuator, behaviours, count }| Contested { actuator, behaviours, count };
    Ok(rows.into_iter().map(one).collect())
}

/// Other behaviours with the same devices.
pub(super) async fn similar(link: &Neo4jConnections, id: &Id, most: u32) -> Result<Vec<Similar>, StoreError> {
    let rows = link.read::<Alike>(SIMILAR, params([("id", json!(id)), ("most", json!(most))])).await?;
    Ok(rows.into_iter().map(|Alike { behaviour, name, shared }| Similar { behaviour, name, shared }).collect())
}
